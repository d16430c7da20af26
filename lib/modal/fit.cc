#include "modal/fit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>

#include "base/error.h"
#include "base/units.h"
#include "modal/fit_data.h"
#include "modal/maximum_likelihood.h"
#include "modal/mode_search.h"

namespace stablecut {
namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index kLeastLines = 8;
constexpr double kNoFit = 0.5;  // relative error from which on modes explain nothing

FitData group_data(const FrequencyResponse& measured, const DirectionGroup& group,
                   const std::vector<std::string>& dofs) {
  FitData data;
  data.s = Complex(0, kTwoPi) * measured.frequency_hz.cast<Complex>();
  data.dofs = static_cast<Eigen::Index>(dofs.size());
  const auto index = [&](const std::string& name) {
    return std::find(dofs.begin(), dofs.end(), name) - dofs.begin();
  };
  for (const std::size_t e : group.entries) {
    const auto& entry = measured.entries[e];
    data.curves.push_back({index(entry.response), index(entry.reference), entry.h, {}});
  }
  return data;
}

std::vector<std::string> group_directions(const FrequencyResponse& measured, const DirectionGroup& group,
                                          const std::vector<std::string>& all) {
  std::vector<std::string> names;
  for (const std::string& name : all) {
    const bool used = std::any_of(group.entries.begin(), group.entries.end(), [&](std::size_t e) {
      return measured.entries[e].response == name || measured.entries[e].reference == name;
    });
    if (used) names.push_back(name);
  }
  return names;
}

// Known variances of the group's curves; empty when any is unknown.
std::vector<Eigen::VectorXd> known_variances(const FrequencyResponse& measured, const DirectionGroup& group) {
  std::vector<Eigen::VectorXd> result;
  for (const std::size_t e : group.entries) {
    result.push_back(known_variance(measured.entries[e]));
    if (result.back().size() == 0) return {};
  }
  return result;
}

// Vector components that no curve of the group shows, because nothing was measured or nothing pushed in that
// direction: set by reciprocity from a direction in which both was done, else zero. True when there was any.
bool complete_by_reciprocity(const FitData& data, Mode& mode) {
  std::vector<bool> seen_r(static_cast<std::size_t>(data.dofs)), seen_l(seen_r.size());
  for (const Curve& curve : data.curves) {
    seen_r[static_cast<std::size_t>(curve.response)] = true;
    seen_l[static_cast<std::size_t>(curve.reference)] = true;
  }
  Complex ratio = 0;  // psi_l / psi_r where both are known and largest
  double best = 0;
  for (std::size_t i = 0; i < seen_r.size(); ++i) {
    const Complex r = mode.psi_r[static_cast<Eigen::Index>(i)], l = mode.psi_l[static_cast<Eigen::Index>(i)];
    if (seen_r[i] && seen_l[i] && std::abs(r * l) > best) {
      best = std::abs(r * l);
      ratio = l / r;
    }
  }
  bool any = false;
  for (std::size_t i = 0; i < seen_r.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (!seen_l[i]) mode.psi_l[at] = mode.psi_r[at] * ratio;
    if (!seen_r[i]) mode.psi_r[at] = best > 0 ? mode.psi_l[at] / ratio : 0.0;
    any = any || !seen_l[i] || !seen_r[i];
  }
  return any;
}

// Entries that the document does not have although it has both of their directions.
std::string missing_entries(const FrequencyResponse& measured, const std::vector<std::string>& dofs) {
  std::string list;
  for (const std::string& response : dofs) {
    for (const std::string& reference : dofs) {
      if (measured.find(response, reference) == nullptr)
        list += (list.empty() ? "" : ", ") + response + reference;
    }
  }
  return list;
}

// A group's share of the number of modes that was asked for; the first groups take the rest.
std::optional<int> wanted_modes(const FitOptions& options, std::size_t groups, std::size_t group) {
  if (!options.modes) return std::nullopt;
  const auto count = static_cast<int>(groups);
  return std::max(1, *options.modes / count + (static_cast<int>(group) < *options.modes % count ? 1 : 0));
}

// A group that has been fitted, and what it was fitted to.
struct FittedGroup {
  std::optional<int> wanted;
  std::vector<Eigen::VectorXd> variance;
  std::shared_ptr<ModeSearch> search;
};

// The same curves between the same directions of a group.
bool alike(const FitData& a, const FitData& b) {
  return std::equal(a.curves.begin(), a.curves.end(), b.curves.begin(), b.curves.end(),
                    [](const Curve& p, const Curve& q) {
                      return p.response == q.response && p.reference == q.reference && p.h == q.h;
                    });
}

}  // namespace

ModalFit fit_modes(const FrequencyResponse& measured, const FitOptions& options) {
  if (measured.quantity != Quantity::kReceptance) throw InvalidArgument("expected a receptance");
  if (measured.frequency_hz.size() < kLeastLines || measured.frequency_hz[0] < 0) {
    throw InvalidArgument("expected at least " + std::to_string(kLeastLines) +
                          " lines to fit modes to, not " + std::to_string(measured.frequency_hz.size()));
  }
  const std::vector<DirectionGroup> groups = independent_groups(measured);
  if (groups.empty()) throw NoAnswer("all entries are zero: there is no mode to find");

  ModalFit fit;
  fit.model.dofs = direction_names(measured);
  fit.variance_given = true;
  fit.converged = true;
  bool by_reciprocity = false;
  double chi_square = 0, values = 0, error_square = 0, square = 0;
  std::vector<FittedGroup> fitted;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const DirectionGroup& group = groups[g];
    const std::vector<std::string> directions = group_directions(measured, group, fit.model.dofs);
    const std::vector<Eigen::VectorXd> variance = known_variances(measured, group);
    const bool given = !variance.empty();
    FitData data = group_data(measured, group, directions);
    const std::optional<int> wanted = wanted_modes(options, groups.size(), g);
    // A round tool in a round spindle: the same numbers in y as in x need no second fit.
    const auto same = std::find_if(fitted.begin(), fitted.end(), [&](const FittedGroup& other) {
      return other.wanted == wanted && other.variance == variance && alike(other.search->data(), data);
    });
    if (same == fitted.end()) {
      fitted.push_back({wanted, variance, std::make_shared<ModeSearch>(std::move(data), variance, wanted)});
      fitted.back().search->run(options.progress);
    } else {
      fitted.push_back(*same);
    }
    const ModeSearch& part = *fitted.back().search;
    fit.variance_given = fit.variance_given && !part.noise_estimated();
    if (given && part.noise_estimated()) {
      fit.warnings.push_back(
          "the residual is much larger than the given variance: the noise was estimated instead");
    }
    fit.converged = fit.converged && part.result().converged;
    fit.limited_by_model = fit.limited_by_model || part.limited_by_model();
    chi_square += part.result().chi_square;
    values += part.complex_values();
    for (const Curve& curve : part.data().curves) {
      const Eigen::VectorXcd error = curve_of(part.result().modes, curve, part.data().s) - curve.h;
      error_square += error.squaredNorm();
      square += curve.h.squaredNorm();
      fit.curves.push_back({directions[static_cast<std::size_t>(curve.response)],
                            directions[static_cast<std::size_t>(curve.reference)],
                            curve.h.isZero(0) ? 0.0 : error.norm() / curve.h.norm(),
                            error.cwiseAbs2().dot(curve.weight) / static_cast<double>(error.size())});
    }
    for (Mode mode : part.result().modes) {
      by_reciprocity = complete_by_reciprocity(part.data(), mode) || by_reciprocity;
      // Into all directions: exact zeros where the group does not reach.
      Mode whole = mode;
      whole.psi_r = whole.psi_l = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(fit.model.dofs.size()));
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const Eigen::Index row = fit.model.dof(directions[i]);
        whole.psi_r[row] = mode.psi_r[static_cast<Eigen::Index>(i)];
        whole.psi_l[row] = mode.psi_l[static_cast<Eigen::Index>(i)];
      }
      whole.out_of_band = mode.frequency_hz < measured.frequency_hz[0] ||
                          mode.frequency_hz > measured.frequency_hz[measured.frequency_hz.size() - 1];
      // Where the model error limits the fit, the weights are not the noise: no standard deviation is known.
      if (part.limited_by_model()) whole.deviation.reset();
      fit.model.modes.push_back(normalised(whole));
    }
  }
  std::stable_sort(fit.model.modes.begin(), fit.model.modes.end(),
                   [](const Mode& a, const Mode& b) { return a.frequency_hz < b.frequency_hz; });
  fit.relative_error = std::sqrt(error_square / square);
  fit.reduced_chi_square = chi_square / values;
  if (options.modes && static_cast<int>(fit.model.modes.size()) < *options.modes) {
    fit.warnings.push_back("only " + std::to_string(fit.model.modes.size()) + " modes could be told apart");
  }
  const std::string missing = missing_entries(measured, fit.model.dofs);
  if (by_reciprocity) {
    fit.warnings.push_back("missing entries " + missing +
                           ": what they would tell is set by reciprocity, or to zero");
  } else if (!missing.empty() && groups.size() > 1) {
    fit.warnings.push_back("missing entries " + missing + ": these directions are taken as uncoupled");
  }
  if (fit.limited_by_model && !options.modes && fit.relative_error > kNoFit) {
    throw NoAnswer("the modes found leave " + std::to_string(std::lround(100 * fit.relative_error)) +
                   " % of the curves unexplained: is the low end of the band unusable (--band)?");
  }
  if (fit.limited_by_model) {
    fit.warnings.push_back(
        "the residual is larger than the noise and not made of modes: fitted by the strongest modes to " +
        std::to_string(std::lround(100 * fit.relative_error)) + " %");
  }
  if (fit.model.modes.empty()) throw NoAnswer("no mode stands out of the noise");
  return fit;
}

}  // namespace stablecut
