// What is most often wrong with loads and deflections: each change of the robot or of the samples that would
// mend it, and whether the samples fit far better with it. README.md, "Hypotheses".
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "robot/load_sample.h"

namespace stablecut::robot {

/// A change of the robot or of the samples. It is the correction, not the mistake.
struct Hypothesis {
  enum class Kind {
    kNone,            ///< as it stands
    kSign,            ///< theta_sign of `joint` is turned
    kCoupling,        ///< `joint` follows the joint `follows` with `ratio`; 0: it follows none
    kTurned,          ///< deflections and rotations turn by `vector`, rad, which is a right angle or two
    kRotated,         ///< the same by any small `vector`, fitted
    kRadians,         ///< the angles are radians that were read as degrees
    kLoadPoint,       ///< the load acts `vector` beside its point, flange frame, m, fitted
    kOwnWeight,       ///< the deflections are from where the robot would be without weight
    kLength,          ///< the link before `joint` is longer by the first number of `vector`, m, fitted
    kDeflectionUnit,  ///< deflections and their deviations times `factor`
    kForceUnit,       ///< forces and moments times `factor`
  };
  Kind kind = Kind::kNone;
  int joint = 0;
  int follows = 0;
  double ratio = 0;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  double factor = 1;

  /// Numbers of `vector` that are fitted.
  int unknowns() const {
    return kind == Kind::kRotated || kind == Kind::kLoadPoint ? 3 : kind == Kind::kLength ? 1 : 0;
  }
  bool of_unit() const { return kind == Kind::kDeflectionUnit || kind == Kind::kForceUnit; }
  bool operator==(const Hypothesis& other) const = default;
};

/// The rotation matrix of a rotation vector, rad.
Eigen::Matrix3d turn_by(const Eigen::Vector3d& vector);

/// Makes the change.
void apply(const Hypothesis& hypothesis, Robot& robot, std::vector<LoadSample>& samples);

/// A hypothesis with which the samples fit far better.
struct BetterFit {
  Hypothesis hypothesis;            ///< with its fitted vector
  double residual_before_m = 0;     ///< root mean square of the deflections' residuals, as it stands
  double residual_after_m = 0;      ///< and with the change
  int poses_better = 0, poses = 0;  ///< that the other poses predict better with the change
};

struct HypothesisOptions {
  std::array<bool, 3> components = {true, true, true};  ///< of the deflection
  /// Factors that turn the deflections, or the forces and moments, into another unit.
  std::vector<double> deflection_factors, force_factors;
};

/// The hypotheses that can be tested on these samples: those of shape first, then those of units. Fitted
/// vectors are 0.
std::vector<Hypothesis> hypotheses(const Robot& robot, const std::vector<LoadSample>& samples,
                                   const HypothesisOptions& options);

/// With its vector fitted to the samples; as it stands where it has none.
Hypothesis fitted(const Hypothesis& hypothesis, const Robot& robot, const std::vector<LoadSample>& samples,
                  const HypothesisOptions& options);

/// The shape hypotheses with which the samples fit far better than without, the best first; what fits
/// significantly worse than the best is left out. Empty where the samples fit as they are, or cannot tell.
std::vector<BetterFit> better_fits(const Robot& robot, const std::vector<LoadSample>& samples,
                                   const HypothesisOptions& options);

/// How stiff the arm is against others of its reach.
struct StiffnessOfReach {
  double reach_m = 0;              ///< of the wrist from axis 1, stretched
  std::optional<double> ratio;     ///< stiffness over the usual one; nothing where no joint is loaded
  bool usual = true;               ///< within what robots have
  std::optional<Hypothesis> unit;  ///< the unit with which it is nearest to the usual, where it is not usual
};

StiffnessOfReach stiffness_of_reach(const Robot& robot, const std::vector<LoadSample>& samples,
                                    const HypothesisOptions& options);

/// The residual is so large beside the deflection, both root mean squares, that the model hardly predicts it.
bool misfit(double residual_m, double deflection_m);

}  // namespace stablecut::robot
