#include "receptance/joint_starts.h"

#include <algorithm>
#include <cmath>

namespace stablecut::receptance {
namespace {

using Complex = std::complex<double>;

// Lines that the scan looks at, values of a stiffness in a decade, loss tangents at the middle of the band;
// steps of a linear solution; pairs that are solved for in turns, and turns; how many starts are left.
constexpr Eigen::Index kScanLines = 200;
constexpr double kPerDecade = 8;
constexpr std::array<double, 4> kLossTangents = {0, 0.01, 0.1, 1};
constexpr int kLinearSteps = 2;
constexpr std::size_t kInTurns = 40;
constexpr int kTurns = 6;
constexpr std::size_t kStarts = 10;
constexpr double kSameStart = 0.2;  // distance in log stiffness

// With y = H - rigid and K2 known, eq. 6 is linear in K1 = k1 + i w c1:
//   K1 (y S2 - l2 r2) = S2 l1 r1 - l1 z12 r2 - l2 z21 r1 + z11 l2 r2 - y (z11 S2 - z12 z21),   S2 = K2 + z22.
// Its error over the determinant is the error of the tip: the determinant of the joint before (at first the
// one given) weighs it, and the tip of the joint before takes the place of the noisy y among the instruments.
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
      // The column i w a is square to a.
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

}  // namespace

ToolJoint within(const ToolJoint& joint, const JointBounds& bounds) {
  JointValues values = values_of(joint);
  for (std::size_t i = 0; i < 4; ++i) values[i] = std::clamp(values[i], bounds.least[i], bounds.most[i]);
  return joint_of(values);
}

std::vector<JointStart> best_of(std::vector<JointStart> all, std::size_t most) {
  std::stable_sort(all.begin(), all.end(),
                   [](const JointStart& a, const JointStart& b) { return a.cost < b.cost; });
  std::vector<JointStart> best;
  for (const JointStart& start : all) {
    if (best.size() == most) break;
    if (std::none_of(best.begin(), best.end(),
                     [&](const JointStart& b) { return alike(b.joint, start.joint); }))
      best.push_back(start);
  }
  return best;
}

std::vector<JointStart> joint_starts(const TipLines& all, const JointBounds& bounds,
                                     JointObjective objective) {
  const TipLines lines = thinned(all, kScanLines);
  TipLines of_slope;
  for (const TipLine& line : lines) of_slope.push_back(line.exchanged());
  const double omega = middle_of(lines);
  const auto first_solved = [&](const ToolJoint& joint) { return solve_first(lines, joint, bounds.most[0]); };
  const auto second_solved = [&](const ToolJoint& joint) {
    return exchanged(solve_first(of_slope, exchanged(joint), bounds.most[2]));
  };
  const auto judged = [&](const ToolJoint& joint) {
    const ToolJoint inside = within(joint, bounds);
    return JointStart{inside, cost_of(lines, inside, objective)};
  };
  std::vector<JointStart> found;
  for (const std::size_t scanned : {0, 2}) {
    const double decades = std::log10(bounds.most[scanned] / bounds.least[scanned]);
    const int count = 2 + static_cast<int>(kPerDecade * decades);
    for (int i = 0; i < count; ++i) {
      const double k = bounds.least[scanned] * std::pow(10, decades * i / (count - 1));
      for (const double tangent : kLossTangents) {
        const double c = std::clamp(tangent * k / omega, bounds.least[scanned + 1], bounds.most[scanned + 1]);
        for (const bool stiff : {false, true}) {
          const double other = stiff ? bounds.most[2 - scanned] : 0;
          found.push_back(
              judged(scanned == 0 ? second_solved({k, c, other, 0}) : first_solved({other, 0, k, c})));
        }
      }
    }
  }
  found = best_of(std::move(found), kInTurns);
  for (JointStart& start : found) {
    ToolJoint joint = start.joint;
    for (int turn = 0; turn < kTurns; ++turn) joint = first_solved(second_solved(joint));
    if (const JointStart solved = judged(joint); solved.cost < start.cost) start = solved;
  }
  return best_of(std::move(found), kStarts);
}

}  // namespace stablecut::receptance
