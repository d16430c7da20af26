#include "receptance/joint_starts.h"

#include <algorithm>
#include <cmath>

namespace stablecut::receptance {
namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index kScanLines = 200;  // lines that the scan looks at
constexpr double kPerDecade = 8;          // values of the scanned stiffness in a decade
// Loss tangents c w / k of the scanned stiffness, at the middle of the band.
constexpr std::array<double, 4> kLossTangents = {0, 0.01, 0.1, 1};
constexpr int kLinearSteps = 2;       // least-squares solutions, each weighted by the one before
constexpr std::size_t kInTurns = 40;  // candidates that are improved by solving in turns
constexpr int kTurns = 6;             // turns
constexpr std::size_t kStarts = 10;   // candidates that are returned
constexpr double kSameStart = 0.2;    // in log stiffness: candidates nearer to each other are one

// K1 = k1 + i w c1 for a given K2: [Liu2014, eq. 6] solved for K1 is linear (README.md, section 12),
//   K1 (y S2 - l2 r2) = S2 l1 r1 - l1 z12 r2 - l2 z21 r1 + z11 l2 r2 - y (z11 S2 - z12 z21),
// where y = measured - rigid and S2 = K2 + z22. The error of this equation is the error of the tip times the
// determinant S1 S2 - z12 z21, by which the previous solution divides it. In the second step the tip of the
// previous solution takes the place of the noisy y in the instrument, so that noise does not bias the result.
ToolJoint solve_first(const TipLines& lines, ToolJoint joint, double most_k1) {
  for (int step = 0; step < kLinearSteps; ++step) {
    double k_top = 0, k_bottom = 0, c_top = 0, c_bottom = 0;
    for (const TipLine& n : lines) {
      const Complex s2 = n.stiffness(joint.k2, joint.c2) + n.z22, y = n.measured - n.rigid;
      const Complex a = y * s2 - n.l2 * n.r2;
      const Complex b = s2 * n.l1 * n.r1 - n.l1 * n.z12 * n.r2 - n.l2 * n.z21 * n.r1 + n.z11 * n.l2 * n.r2 -
                        y * (n.z11 * s2 - n.z12 * n.z21);
      const Complex determinant = (n.stiffness(joint.k1, joint.c1) + n.z11) * s2 - n.z12 * n.z21;
      const Complex instrument = step == 0 ? a : (tip_of(n, joint).h - n.rigid) * s2 - n.l2 * n.r2;
      const Complex weighted = std::conj(instrument) * (n.weight * n.weight / std::norm(determinant));
      k_top += (weighted * b).real();
      k_bottom += (weighted * a).real();
      // The column of c1, i w a, is orthogonal to that of k1, a: the two are solved for apart.
      c_top += (weighted * b).imag() * n.omega;
      c_bottom += (weighted * a).real() * n.omega * n.omega;
    }
    joint.k1 = k_top / k_bottom;
    joint.c1 = c_top / c_bottom;
    if (!std::isfinite(joint.k1) || joint.k1 <= 0) joint.k1 = most_k1;
    if (!std::isfinite(joint.c1) || joint.c1 < 0) joint.c1 = 0;
  }
  return joint;
}

ToolJoint exchanged(const ToolJoint& joint) { return {joint.k2, joint.c2, joint.k1, joint.c1}; }

bool alike(const ToolJoint& a, const ToolJoint& b) {
  return std::abs(std::log(a.k1 / b.k1)) < kSameStart && std::abs(std::log(a.k2 / b.k2)) < kSameStart;
}

// Solves for one stiffness with the other given, and says what a joint costs.
class StartFinder {
 public:
  StartFinder(const TipLines& all, const JointBounds& bounds, JointObjective objective)
      : lines_(thinned(all, kScanLines)), bounds_(bounds), objective_(objective) {
    for (const TipLine& line : lines_) exchanged_lines_.push_back(line.exchanged());
  }

  // One stiffness on a grid over its bounds with several dampings, the other one solved for; the solution is
  // begun once from a soft and once from a stiff value of it.
  std::vector<JointCandidate> scan() const {
    const double omega = middle_omega(lines_);
    std::vector<JointCandidate> found;
    for (const std::size_t scanned : {0, 2}) {
      const double least = bounds_.least[scanned];
      const double decades = std::log10(bounds_.most[scanned] / least);
      const int count = 2 + static_cast<int>(kPerDecade * decades);
      for (int i = 0; i < count; ++i) {
        const double k = least * std::pow(10, decades * i / (count - 1));
        for (const double tangent : kLossTangents) {
          const double c =
              std::clamp(tangent * k / omega, bounds_.least[scanned + 1], bounds_.most[scanned + 1]);
          for (const double other : {0.0, bounds_.most[2 - scanned]}) {
            found.push_back(
                judged(scanned == 0 ? second_solved({k, c, other, 0}) : first_solved({other, 0, k, c})));
          }
        }
      }
    }
    return found;
  }

  // Both stiffnesses solved for in turns.
  JointCandidate improved(const JointCandidate& start) const {
    ToolJoint joint = start.joint;
    for (int turn = 0; turn < kTurns; ++turn) joint = first_solved(second_solved(joint));
    const JointCandidate solved = judged(joint);
    return solved.cost < start.cost ? solved : start;
  }

 private:
  ToolJoint first_solved(const ToolJoint& joint) const { return solve_first(lines_, joint, bounds_.most[0]); }
  ToolJoint second_solved(const ToolJoint& joint) const {
    return exchanged(solve_first(exchanged_lines_, exchanged(joint), bounds_.most[2]));
  }
  JointCandidate judged(const ToolJoint& joint) const {
    const ToolJoint inside = clamped(joint, bounds_);
    return {inside, cost_of(lines_, inside, objective_)};
  }

  TipLines lines_, exchanged_lines_;
  const JointBounds& bounds_;
  JointObjective objective_;
};

}  // namespace

ToolJoint clamped(const ToolJoint& joint, const JointBounds& bounds) {
  JointValues values = values_of(joint);
  for (std::size_t i = 0; i < 4; ++i) values[i] = std::clamp(values[i], bounds.least[i], bounds.most[i]);
  return joint_of(values);
}

std::vector<JointCandidate> best_distinct(std::vector<JointCandidate> all, std::size_t most) {
  std::stable_sort(all.begin(), all.end(),
                   [](const JointCandidate& a, const JointCandidate& b) { return a.cost < b.cost; });
  std::vector<JointCandidate> best;
  for (const JointCandidate& candidate : all) {
    if (best.size() == most) break;
    if (std::none_of(best.begin(), best.end(),
                     [&](const JointCandidate& b) { return alike(b.joint, candidate.joint); }))
      best.push_back(candidate);
  }
  return best;
}

std::vector<JointCandidate> joint_starts(const TipLines& lines, const JointBounds& bounds,
                                         JointObjective objective) {
  const StartFinder finder(lines, bounds, objective);
  std::vector<JointCandidate> found = best_distinct(finder.scan(), kInTurns);
  for (JointCandidate& start : found) start = finder.improved(start);
  return best_distinct(std::move(found), kStarts);
}

}  // namespace stablecut::receptance
