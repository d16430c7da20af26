#include "receptance/held_tool.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/number_text.h"

namespace stablecut::receptance {
namespace {

// Outer and inner part of a chain cut at a distance from its tip; cut at an end, one of them is empty.
std::pair<BeamChain, BeamChain> cut_at(const BeamChain& chain, double distance_m) {
  std::pair<BeamChain, BeamChain> parts;
  double start = 0;
  for (const BeamSegment& segment : chain) {
    // A piece as short as the rounding of its end is no segment.
    const double into = distance_m - start, rounding = kPlaceRounding * segment.length_m;
    if (into >= segment.length_m - rounding) {
      parts.first.push_back(segment);
    } else if (into <= rounding) {
      parts.second.push_back(segment);
    } else {
      parts.first.push_back(segment);
      parts.first.back().length_m = into;
      parts.second.push_back(segment);
      parts.second.back().length_m = segment.length_m - into;
    }
    start += segment.length_m;
  }
  return parts;
}

void check_on(const BeamChain& chain, double distance_m) {
  const double length = length_of(chain);
  if (!(distance_m >= 0 && distance_m <= length * (1 + kPlaceRounding))) {
    throw InvalidArgument("position " + number_text(1e3 * distance_m) + " mm: expected 0 to " +
                          number_text(1e3 * length) + " mm, a place on the tool");
  }
}

// The point at which two parts meet, of receptances `a` and `b` there: (a^-1 + b^-1)^-1, written so that
// either may be zero (fixed).
template <int N>
Receptance<N> meeting_point(const Receptance<N>& a, const Receptance<N>& b) {
  return a * (a + b).inverse() * b;
}

// Movement at one place of a chain per load at another. `inner_of(part)` is the receptance of the face of
// what lies inwards of a cut: `part`, the chain's inner segments, and whatever holds them.
template <int N, typename InnerOf>
Receptance<N> between_places(const BeamChain& chain, BeamTheory theory, double omega, double response_m,
                             double reference_m, const InnerOf& inner_of) {
  check_on(chain, response_m);
  check_on(chain, reference_m);
  const double farther = std::max(response_m, reference_m), nearer = std::min(response_m, reference_m);
  const auto [outer, inner] = cut_at(chain, farther);
  if (outer.empty()) return inner_of(inner);
  const BeamReceptances free = free_chain(outer, theory, omega);
  const Receptance<N> farther_free = in_all_directions<N>(free.r22);
  const Receptance<N> at_farther = meeting_point<N>(farther_free, inner_of(inner));
  if (nearer == farther) return at_farther;
  // All that a load on the inner part does to the outer one goes through the cut: the nearer place moves as
  // it would under the load at the outer part's end that moves this end by at_farther.
  const Receptance<2> nearer_free = free_response_to_end(outer, theory, omega, nearer);
  if (response_m < reference_m) {
    return in_all_directions<N>(nearer_free) * farther_free.inverse() * at_farther;
  }
  return at_farther * farther_free.inverse() * in_all_directions<N>(nearer_free.transpose());
}

std::vector<SegmentMotion> motions_of(const BeamChain& chain, BeamTheory theory, double omega) {
  std::vector<SegmentMotion> motions;
  motions.reserve(chain.size());
  for (const BeamSegment& segment : chain) motions.emplace_back(segment, theory, omega);
  return motions;
}

// The index of the longest segment.
std::size_t longest_of(const BeamChain& chain) {
  if (chain.empty()) throw InvalidArgument("no segment: expected at least one");
  return std::max_element(chain.begin(), chain.end(),
                          [](const auto& a, const auto& b) { return a.length_m < b.length_m; }) -
         chain.begin();
}

// The chain free at both ends, built from its longest segment inwards, then outwards: beside it the
// receptance of a free short segment, nearly without mass, would be so large that nothing else were left.
BeamReceptances free_part(const std::vector<SegmentMotion>& motions, std::size_t longest) {
  BeamReceptances part = turned_round(motions[longest].free());
  for (std::size_t i = longest + 1; i < motions.size(); ++i) part = motions[i].before(part);
  part = turned_round(part);
  for (std::size_t i = longest; i-- > 0;) part = motions[i].before(part);
  return part;
}

template <int N>
Receptance<N> mass_matrix(double mass_kg, double omega) {
  const Eigen::Matrix2cd one{{mass_kg * omega * omega, 0}, {0, 0}};
  return in_all_directions<N>(one);
}

}  // namespace

double length_of(const BeamChain& chain) {
  double length = 0;
  for (const BeamSegment& segment : chain) length += segment.length_m;
  return length;
}

template <int N>
Receptance<N> held_chain(const BeamChain& chain, BeamTheory theory, double omega,
                         const Receptance<N>& inner) {
  Receptance<N> held = inner;
  for (std::size_t i = chain.size(); i-- > 0;) held = SegmentMotion(chain[i], theory, omega).held<N>(held);
  return held;
}

BeamReceptances free_chain(const BeamChain& chain, BeamTheory theory, double omega) {
  return free_part(motions_of(chain, theory, omega), longest_of(chain));
}

template <int N>
JointPlane<N> joint_plane(const BeamChain& tool, BeamTheory theory, double omega,
                          const Receptance<N>& holder) {
  const std::vector<SegmentMotion> motions = motions_of(tool, theory, omega);
  const BeamReceptances free = free_part(motions, longest_of(tool));
  JointPlane<N> plane;
  plane.rigid_tip = holder;
  for (std::size_t i = motions.size(); i-- > 0;) plane.rigid_tip = motions[i].held<N>(plane.rigid_tip);
  plane.stiffness = (in_all_directions<N>(free.r22) + holder).inverse();
  plane.of_opening = in_all_directions<N>(free.r12) * plane.stiffness;
  plane.transmitted = plane.stiffness * in_all_directions<N>(free.r21);
  return plane;
}

template <int N>
JointPlane<N> with_tip_mass(const JointPlane<N>& plane, double mass_kg, double omega) {
  if (mass_kg == 0) return plane;
  // The tip feels the load F + M w^2 times its own movement.
  const Receptance<N> mass = mass_matrix<N>(mass_kg, omega);
  const Receptance<N> factor = (Receptance<N>::Identity() - plane.rigid_tip * mass).inverse();
  JointPlane<N> result;
  result.rigid_tip = factor * plane.rigid_tip;
  result.of_opening = factor * plane.of_opening;
  result.transmitted = plane.transmitted * (Receptance<N>::Identity() + mass * result.rigid_tip);
  result.stiffness = plane.stiffness - plane.transmitted * mass * result.of_opening;
  return result;
}

template <int N>
Receptance<N> with_mass(const Receptance<N>& at, double mass_kg, double omega) {
  if (mass_kg == 0) return at;
  return (Receptance<N>::Identity() - at * mass_matrix<N>(mass_kg, omega)).inverse() * at;
}

template <int N>
Receptance<N> receptance_along(const BeamChain& tool, BeamTheory theory, double omega,
                               const Receptance<N>& holder, double response_m, double reference_m) {
  return between_places<N>(tool, theory, omega, response_m, reference_m, [&](const BeamChain& inner) {
    return held_chain<N>(inner, theory, omega, holder);
  });
}

Receptance<2> free_response_to_end(const BeamChain& tool, BeamTheory theory, double omega,
                                   double response_m) {
  check_on(tool, response_m);
  const auto [outer, inner] = cut_at(tool, response_m);
  if (inner.empty()) return free_chain(outer, theory, omega).r22;
  const BeamReceptances near_end = free_chain(inner, theory, omega);
  if (outer.empty()) return near_end.r12;
  const Receptance<2> at_cut = free_chain(outer, theory, omega).r22;
  return at_cut * (at_cut + near_end.r11).inverse() * near_end.r12;
}

Receptance<2> free_receptance_along(const BeamChain& tool, BeamTheory theory, double omega, double response_m,
                                    double reference_m) {
  // At end 2 nothing lies inwards of the cut.
  const auto at_end = [&](double distance_m) { return cut_at(tool, distance_m).second.empty(); };
  if (at_end(reference_m)) return free_response_to_end(tool, theory, omega, response_m);
  if (at_end(response_m)) return free_response_to_end(tool, theory, omega, reference_m).transpose();
  return between_places<2>(
      tool, theory, omega, response_m, reference_m,
      [&](const BeamChain& inner) -> Receptance<2> { return free_chain(inner, theory, omega).r11; });
}

#define STABLECUT_FOR_DIRECTIONS(N)                                                                      \
  template Receptance<N> held_chain<N>(const BeamChain&, BeamTheory, double, const Receptance<N>&);      \
  template JointPlane<N> joint_plane<N>(const BeamChain&, BeamTheory, double, const Receptance<N>&);     \
  template JointPlane<N> with_tip_mass<N>(const JointPlane<N>&, double, double);                         \
  template Receptance<N> with_mass<N>(const Receptance<N>&, double, double);                             \
  template Receptance<N> receptance_along<N>(const BeamChain&, BeamTheory, double, const Receptance<N>&, \
                                             double, double);
STABLECUT_FOR_DIRECTIONS(2)
STABLECUT_FOR_DIRECTIONS(4)
#undef STABLECUT_FOR_DIRECTIONS

}  // namespace stablecut::receptance
