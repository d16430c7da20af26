// The maximum of a function of few variables under inequalities, without derivatives.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace stablecut::numerics {

using Variables = Eigen::VectorXd;

/// A function and its constraints at a point.
struct ConstrainedValue {
  double value = 0;
  Eigen::VectorXd constraints;  ///< each not below 0 where the point is allowed
};

/// Nothing where the function is not defined. Must not throw; the number of constraints never changes.
using ConstrainedFunction = std::function<std::optional<ConstrainedValue>(const Variables&)>;

struct ConstrainedMaximum {
  Variables point;
  double value = 0;
};

/// Powell's COBYLA [Powell1994], as NLopt has it [Johnson2007], from `start` inside lower..upper (variables
/// of order 1): linear models on a simplex of first size `radius`, which shrinks to 1e-10. The point returned
/// is the best allowed one that was seen, so it is not worse than an allowed start; nothing when none was
/// seen, or the function is not defined at the start. README.md, "Constrained maximum".
std::optional<ConstrainedMaximum> constrained_maximum(const ConstrainedFunction& function,
                                                      const Variables& start, const Variables& lower,
                                                      const Variables& upper, double radius);

}  // namespace stablecut::numerics
