// The maximum of a smooth function of few variables under smooth inequalities.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace stablecut::numerics {

/// Up to three variables.
using Variables = Eigen::VectorXd;

/// A function and its constraints at a point.
struct ConstrainedValue {
  double value = 0;
  Eigen::VectorXd constraints;  ///< each not below 0 where the point is allowed
};

/// Nothing where the function is not defined.
using ConstrainedFunction = std::function<std::optional<ConstrainedValue>(const Variables&)>;

struct ConstrainedMaximum {
  Variables point;
  double value = 0;
};

/// Sequential quadratic programming from `start` inside lower..upper (variables of order 1): derivatives by
/// central differences of step `difference`, a quadratic model of the Lagrangian in a trust region of first
/// size `radius`, steps drawn back on to the constraints. The point returned is allowed and not worse than an
/// allowed start; from a start that is not allowed it first looks for an allowed point, and returns nothing
/// when it finds none.
std::optional<ConstrainedMaximum> constrained_maximum(const ConstrainedFunction& function,
                                                      const Variables& start, const Variables& lower,
                                                      const Variables& upper, double radius,
                                                      double difference);

}  // namespace stablecut::numerics
