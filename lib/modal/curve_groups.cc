#include "modal/curve_groups.h"

#include <algorithm>
#include <complex>
#include <utility>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "dynamics/noise.h"
#include "modal/start_modes.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

FitData group_data(const dynamics::FrequencyResponse& measured, const DirectionGroup& group,
                   const std::vector<std::string>& dofs) {
  FitData data;
  data.s = Complex(0, kTwoPi) * measured.frequency_hz.cast<Complex>();
  data.dofs = static_cast<Eigen::Index>(dofs.size());
  data.independent_lines = measured.window_decay_per_s == 0;
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

// Known variances of the group's curves, those of few averages pooled over lines; empty when any is unknown.
CurveVariances known_variances(const dynamics::FrequencyResponse& measured, const DirectionGroup& group) {
  CurveVariances result;
  for (const std::size_t e : group.entries) {
    const auto& entry = measured.entries[e];
    Eigen::VectorXd variance = dynamics::weighing_variance(entry, measured.frequency_hz);
    if (variance.size() == 0) return {};
    result.push_back(std::move(variance));
  }
  return result;
}

// A group's share of the number of modes that was asked for; the first groups take the rest.
std::optional<int> share_of_modes(const FitOptions& options, std::size_t groups, std::size_t group) {
  if (!options.modes) return std::nullopt;
  const auto count = static_cast<int>(groups);
  return std::max(1, *options.modes / count + (static_cast<int>(group) < *options.modes % count ? 1 : 0));
}

// The given poles that move the group's directions, seen through the window.
Eigen::VectorXcd poles_of(const FitOptions& options, const CurveGroup& group, double window_decay_per_s) {
  std::vector<Complex> poles;
  for (const GivenPole& given : options.poles) {
    const bool moves =
        given.directions.empty() ||
        std::any_of(given.directions.begin(), given.directions.end(), [&](const auto& name) {
          return std::find(group.directions.begin(), group.directions.end(), name) != group.directions.end();
        });
    if (!moves) continue;
    if (std::find(poles.begin(), poles.end(), given.pole - window_decay_per_s) != poles.end())
      throw InvalidArgument("poles: " + number_text(std::abs(given.pole) / kTwoPi) +
                            " Hz: expected each pole once in a direction");
    poles.push_back(given.pole - window_decay_per_s);
  }
  if (poles.empty())
    throw InvalidArgument("poles: expected one that moves " + group.directions[0] + " at least");
  if (2 * static_cast<Eigen::Index>(poles.size()) > group.data.lines())
    throw InvalidArgument("poles: " + std::to_string(poles.size()) +
                          ": expected at most half as many as lines, " + std::to_string(group.data.lines()));
  return Eigen::Map<Eigen::VectorXcd>(poles.data(), static_cast<Eigen::Index>(poles.size()));
}

}  // namespace

std::vector<CurveGroup> curve_groups(const dynamics::FrequencyResponse& measured, const FitOptions& options) {
  const std::vector<DirectionGroup> parts = independent_groups(measured);
  if (parts.empty()) throw NoAnswer("all entries are zero: there is no mode to find");
  std::vector<CurveGroup> groups;
  for (std::size_t g = 0; g < parts.size(); ++g) {
    CurveGroup group;
    group.directions = group_directions(measured, parts[g], direction_names(measured));
    group.variance = known_variances(measured, parts[g]);
    group.data = group_data(measured, parts[g], group.directions);
    group.wanted_modes = share_of_modes(options, parts.size(), g);
    group.data.residual_terms = options.residual_terms;
    if (!options.poles.empty()) {
      group.poles = poles_of(options, group, measured.window_decay_per_s);
      group.data.poles_fixed = options.poles_fixed;
      if (options.residual_terms) group.poles = with_residual_terms(group.data, group.poles);
      group.wanted_modes =
          static_cast<int>(std::count_if(group.poles.begin(), group.poles.end(),
                                         [&](Complex pole) { return !group.data.is_residual(pole); }));
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

bool alike(const CurveGroup& a, const CurveGroup& b) {
  return a.wanted_modes == b.wanted_modes && a.poles.size() == b.poles.size() && a.poles == b.poles &&
         a.variance == b.variance &&
         std::equal(a.data.curves.begin(), a.data.curves.end(), b.data.curves.begin(), b.data.curves.end(),
                    [](const Curve& p, const Curve& q) {
                      return p.response == q.response && p.reference == q.reference && p.h == q.h;
                    });
}

}  // namespace stablecut::modal
