#include "modal/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <numeric>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "modal/fit_data.h"
#include "modal/fitted_table.h"
#include "modal/maximum_likelihood.h"
#include "modal/mode_search.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index kLeastLines = 8;
constexpr double kLeastReceptance = 1e-40,
                 kLargestReceptance = 1e40;  // m/N; outside are errors of units or of a line
constexpr double kNoFit = 0.5;               // relative error from which on modes explain nothing

FitData group_data(const dynamics::FrequencyResponse& measured, const DirectionGroup& group,
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

std::vector<std::string> group_directions(const dynamics::FrequencyResponse& measured,
                                          const DirectionGroup& group, const std::vector<std::string>& all) {
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
std::vector<Eigen::VectorXd> known_variances(const dynamics::FrequencyResponse& measured,
                                             const DirectionGroup& group) {
  std::vector<Eigen::VectorXd> result;
  for (const std::size_t e : group.entries) {
    result.push_back(dynamics::known_variance(measured.entries[e]));
    if (result.back().size() == 0) return {};
  }
  return result;
}

// Entries that the document does not have although it has both of their directions.
std::string missing_entries(const dynamics::FrequencyResponse& measured,
                            const std::vector<std::string>& dofs) {
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

constexpr std::array kModels = {ModeModel::kNonsymmetric, ModeModel::kSymmetric, ModeModel::kProportional};

// An independent group of directions.
struct Group {
  std::vector<std::string> directions;
  std::optional<int> wanted;
  std::vector<Eigen::VectorXd> variance;  // given; empty when any is unknown
  FitData data;
};

std::vector<Group> groups_of(const dynamics::FrequencyResponse& measured, const FitOptions& options) {
  const std::vector<DirectionGroup> parts = independent_groups(measured);
  if (parts.empty()) throw NoAnswer("all entries are zero: there is no mode to find");
  std::vector<Group> groups;
  for (std::size_t g = 0; g < parts.size(); ++g) {
    Group group;
    group.directions = group_directions(measured, parts[g], direction_names(measured));
    group.wanted = wanted_modes(options, parts.size(), g);
    group.variance = known_variances(measured, parts[g]);
    group.data = group_data(measured, parts[g], group.directions);
    groups.push_back(std::move(group));
  }
  return groups;
}

// The same curves between the same directions of a group, known as well.
bool alike(const Group& a, const Group& b) {
  return a.wanted == b.wanted && a.variance == b.variance &&
         std::equal(a.data.curves.begin(), a.data.curves.end(), b.data.curves.begin(), b.data.curves.end(),
                    [](const Curve& p, const Curve& q) {
                      return p.response == q.response && p.reference == q.reference && p.h == q.h;
                    });
}

// Each group's modes in one model.
using Searches = std::vector<std::shared_ptr<ModeSearch>>;

Searches search_groups(const std::vector<Group>& groups, const Progress& progress) {
  Searches searches;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    // A round tool in a round spindle: the same numbers in y as in x need no second fit.
    const auto same = std::find_if(groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(g),
                                   [&](const Group& other) { return alike(other, groups[g]); });
    const std::size_t at = same - groups.begin();
    if (at < g) {
      searches.push_back(searches[at]);
      continue;
    }
    searches.push_back(std::make_shared<ModeSearch>(groups[g].data, groups[g].variance, groups[g].wanted));
    searches.back()->run(progress);
  }
  return searches;
}

ModelCriterion criterion_of(const Searches& searches, const std::vector<double>& inflation) {
  ModelCriterion criterion;
  criterion.model = searches[0]->model();
  for (std::size_t g = 0; g < searches.size(); ++g) {
    const ModeSearch& search = *searches[g];
    const auto modes = static_cast<double>(search.result().modes.size());
    criterion.modes += search.result().modes.size();
    criterion.parameters += modes * search.parameters_per_mode();
    criterion.chi_square += 2 * search.result().chi_square;
    criterion.bic += 2 * search.result().chi_square / inflation[g] +
                     modes * search.parameters_per_mode() * std::log(search.data().values());
  }
  return criterion;
}

// The modes in the model that the options want, or in the best. They are found in the least restricted one,
// whose noise and model error judge all.
Searches chosen_searches(const std::vector<Group>& groups, const FitOptions& options,
                         std::vector<ModelCriterion>& criteria) {
  const Searches found = search_groups(groups, options.progress);
  std::vector<double> inflation;
  for (const auto& search : found) inflation.push_back(search->inflation());
  Searches best;
  for (const ModeModel model : kModels) {
    if (options.model && model != *options.model) continue;
    Searches searches;
    for (const auto& search : found) {
      searches.push_back(std::make_shared<ModeSearch>(*search));
      if (model != search->model()) searches.back()->change_model(model);
    }
    criteria.push_back(criterion_of(searches, inflation));
    if (best.empty() || criteria.back().bic < criterion_of(best, inflation).bic) best = std::move(searches);
  }
  return best;
}

std::optional<Reciprocity> reciprocity_of(const Searches& searches) {
  double difference = 0, sizes = 0, noise = 0;
  for (const auto& search : searches) {
    const std::vector<Curve>& curves = search->data().curves;
    for (const Curve& a : curves) {
      for (const Curve& b : curves) {
        if (a.response >= a.reference || b.response != a.reference || b.reference != a.response) continue;
        difference += (a.h - b.h).squaredNorm();
        sizes += std::pow(a.h.norm() + b.h.norm(), 2);
        noise += (a.weight.cwiseInverse() + b.weight.cwiseInverse()).sum();
      }
    }
  }
  if (sizes == 0) return std::nullopt;
  return Reciprocity{std::sqrt(difference / sizes), std::sqrt(noise / sizes)};
}

// Adds a group's modes to the whole table: exact zeros where the group does not reach.
void add_table(const FittedTable& table, const std::vector<std::string>& directions, double inflation,
               dynamics::ModalModel& model) {
  const Eigen::Index before = model.covariance.rows(), whole = model.parameters_per_mode();
  const auto own = 2 + 4 * static_cast<Eigen::Index>(directions.size());
  std::vector<Eigen::Index> at;  // of the group's parameters in the whole covariance
  for (std::size_t k = 0; k < table.modes.size(); ++k) {
    const dynamics::Mode& mode = table.modes[k];
    dynamics::Mode added = mode;
    added.psi_r = added.psi_l = Eigen::VectorXcd::Zero(model.dofs.size());
    const Eigen::Index first = before + static_cast<Eigen::Index>(k) * whole;
    for (Eigen::Index p = 0; p < own; ++p) at.push_back(first + p);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const Eigen::Index from = i;
      const Eigen::Index to = model.dof(directions[i]);
      added.psi_r[to] = mode.psi_r[from];
      added.psi_l[to] = mode.psi_l[from];
      for (Eigen::Index part = 0; part < 2; ++part) {
        const std::size_t block = k * static_cast<std::size_t>(own);
        at[block + static_cast<std::size_t>(2 + 2 * from + part)] = first + 2 + 2 * to + part;
        at[block + static_cast<std::size_t>(own / 2 + 1 + 2 * from + part)] =
            first + whole / 2 + 1 + 2 * to + part;
      }
    }
    model.modes.push_back(std::move(added));
  }
  const Eigen::Index size = before + static_cast<Eigen::Index>(table.modes.size()) * whole;
  model.covariance.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = 0; j < at.size(); ++j) {
      model.covariance(at[i], at[j]) = inflation * table.covariance(i, j);
    }
  }
}

dynamics::ModalModel sorted_by_frequency(const dynamics::ModalModel& model) {
  std::vector<std::size_t> order(model.modes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return model.modes[a].frequency_hz < model.modes[b].frequency_hz;
  });
  return dynamics::chosen_modes(model, order);
}

}  // namespace

ModalFit fit_modes(const dynamics::FrequencyResponse& measured, const FitOptions& options) {
  if (measured.quantity != dynamics::Quantity::kReceptance) throw InvalidArgument("expected a receptance");
  if (measured.frequency_hz.size() < kLeastLines || measured.frequency_hz[0] < 0) {
    throw InvalidArgument("expected at least " + std::to_string(kLeastLines) +
                          " lines to fit modes to, not " + std::to_string(measured.frequency_hz.size()));
  }
  for (const auto& entry : measured.entries) {
    const double largest = entry.h.cwiseAbs().maxCoeff();
    if (largest == 0 || (largest > kLeastReceptance && largest < kLargestReceptance)) continue;
    throw InvalidArgument(entry.response + entry.reference +
                          ": expected receptances of a usual size in m/N, not up to " + number_text(largest));
  }
  const std::vector<Group> groups = groups_of(measured, options);
  ModalFit fit;
  fit.model.dofs = direction_names(measured);
  fit.variance_given = true;
  fit.converged = true;
  const Searches searches = chosen_searches(groups, options, fit.criteria);
  fit.mode_model = searches[0]->model();
  fit.reciprocity = reciprocity_of(searches);
  bool by_reciprocity = false;
  double chi_square = 0, values = 0, error_square = 0, square = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const ModeSearch& part = *searches[g];
    fit.variance_given = fit.variance_given && !part.noise_estimated();
    if (!groups[g].variance.empty() && part.noise_estimated()) {
      fit.warnings.push_back(
          "the residual is much larger than the given variance: the noise was estimated instead");
    }
    fit.converged = fit.converged && part.result().converged;
    fit.limited_by_model = fit.limited_by_model || part.limited_by_model();
    chi_square += part.result().chi_square;
    values += part.result().chi_square / part.reduced_chi_square();
    fit.inflation = std::max(fit.inflation, part.inflation());
    for (const Curve& curve : part.data().curves) {
      const Eigen::VectorXcd error = curve_of(part.result().modes, curve, part.data().s) - curve.h;
      error_square += error.squaredNorm();
      square += curve.h.squaredNorm();
      fit.curves.push_back({groups[g].directions[curve.response], groups[g].directions[curve.reference],
                            curve.h.isZero(0) ? 0.0 : error.norm() / curve.h.norm(),
                            error.cwiseAbs2().dot(curve.weight) / static_cast<double>(error.size())});
    }
    fit.data.push_back(part.data());
    const FittedTable table = fitted_table(part.data(), part.result().modes, part.model());
    by_reciprocity = by_reciprocity || table.by_reciprocity;
    add_table(table, groups[g].directions, part.inflation(), fit.model);
  }
  for (dynamics::Mode& mode : fit.model.modes) {
    mode.out_of_band = mode.frequency_hz < measured.frequency_hz[0] ||
                       mode.frequency_hz > measured.frequency_hz[measured.frequency_hz.size() - 1];
  }
  fit.model = sorted_by_frequency(fit.model);
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
  if (fit.limited_by_model) {
    const std::string left = percent_text(fit.relative_error) + " of the curves";
    const bool restricted = fit.mode_model != ModeModel::kNonsymmetric;
    if (!options.modes && fit.relative_error > kNoFit) {
      throw NoAnswer(restricted
                         ? "modes of this model leave " + left + ": the structure is not like that"
                         : "the modes found leave " + left + ": is a part of the band unusable (--band)?");
    }
    fit.warnings.push_back("the residual is larger than the noise, or not white: " +
                           std::string(restricted ? "modes of this model" : "the strongest modes") +
                           " leave " + left);
  }
  if (fit.model.modes.empty()) throw NoAnswer("no mode stands out of the noise");
  return fit;
}

}  // namespace stablecut::modal
