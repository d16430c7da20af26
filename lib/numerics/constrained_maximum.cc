#include "numerics/constrained_maximum.h"

#include <nlopt.h>

#include <memory>

namespace stablecut::numerics {
namespace {

constexpr int kMostEvaluations = 3000;
constexpr double kLeastSimplex = 1e-10;  // size at which the search ends
constexpr double kUndefinedCost = 1e10;  // of a point at which the function is not defined
constexpr double kUndefinedExcess = 1;   // and by how much it breaks each constraint

// Evaluates once for value and constraints, which NLopt asks for one after the other, and keeps the best.
class Search {
 public:
  explicit Search(const ConstrainedFunction& function) : function_(function) {}

  const std::optional<ConstrainedValue>& at(const double* x, unsigned n) {
    const Eigen::Map<const Variables> point(x, n);
    if (point_ && *point_ == point) return here_;
    point_ = point;
    here_ = function_(*point_);
    const bool allowed = here_ && (here_->constraints.size() == 0 || here_->constraints.minCoeff() >= 0);
    if (allowed && (!best_ || here_->value > best_->value)) best_ = ConstrainedMaximum{*point_, here_->value};
    return here_;
  }
  const std::optional<ConstrainedMaximum>& best() const { return best_; }

 private:
  const ConstrainedFunction& function_;
  std::optional<Variables> point_;
  std::optional<ConstrainedValue> here_;
  std::optional<ConstrainedMaximum> best_;
};

// What NLopt makes least, and keeps below 0.
double cost(unsigned n, const double* x, double*, void* search) {
  const auto& here = static_cast<Search*>(search)->at(x, n);
  return here ? -here->value : kUndefinedCost;
}
void excesses(unsigned m, double* result, unsigned n, const double* x, double*, void* search) {
  const auto& here = static_cast<Search*>(search)->at(x, n);
  for (unsigned k = 0; k < m; ++k) result[k] = here ? -here->constraints[k] : kUndefinedExcess;
}

}  // namespace

std::optional<ConstrainedMaximum> constrained_maximum(const ConstrainedFunction& function,
                                                      const Variables& start, const Variables& lower,
                                                      const Variables& upper, double radius) {
  Variables x = start.cwiseMax(lower).cwiseMin(upper);
  const auto n = static_cast<unsigned>(x.size());
  Search search(function);
  const std::optional<ConstrainedValue> first = search.at(x.data(), n);
  if (!first) return std::nullopt;
  if (n == 0) return search.best();
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> solver(nlopt_create(NLOPT_LN_COBYLA, n),
                                                                 nlopt_destroy);
  nlopt_set_lower_bounds(solver.get(), lower.data());
  nlopt_set_upper_bounds(solver.get(), upper.data());
  nlopt_set_min_objective(solver.get(), cost, &search);
  if (const auto m = static_cast<unsigned>(first->constraints.size()); m > 0)
    nlopt_add_inequality_mconstraint(solver.get(), m, excesses, &search, nullptr);
  nlopt_set_initial_step1(solver.get(), radius);
  nlopt_set_xtol_abs1(solver.get(), kLeastSimplex);
  nlopt_set_maxeval(solver.get(), kMostEvaluations);
  double least_cost = 0;
  nlopt_optimize(solver.get(), x.data(), &least_cost);  // however it ends, the best point seen counts
  return search.best();
}

}  // namespace stablecut::numerics
