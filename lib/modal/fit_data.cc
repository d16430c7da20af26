#include "modal/fit_data.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stablecut::modal {
namespace {

// Of residual terms: place in band ends below or above the band, how much farther each next direction's is,
// and -Re lambda / Im lambda.
constexpr double kResidualPlace = 1.5, kResidualSpread = 0.1, kResidualDamping = 0.05;

}  // namespace

std::vector<std::size_t> FitData::vector_parts() const {
  constexpr std::size_t kNoPart = -1;
  std::vector<std::size_t> part(curves.size(), kNoPart);
  std::size_t parts = 0;
  for (std::size_t first = 0; first < curves.size(); ++first) {
    if (part[first] != kNoPart) continue;
    part[first] = parts;
    for (bool grew = true; grew;) {
      grew = false;
      for (std::size_t a = 0; a < curves.size(); ++a) {
        for (std::size_t b = 0; b < curves.size(); ++b) {
          if (part[a] != parts || part[b] != kNoPart) continue;
          if (curves[a].response != curves[b].response && curves[a].reference != curves[b].reference)
            continue;
          part[b] = parts;
          grew = true;
        }
      }
    }
    ++parts;
  }
  return part;
}

bool FitData::in_band(std::complex<double> pole) const {
  return pole.imag() >= lowest() && pole.imag() <= highest();
}

Eigen::ArrayXd local_rms(const FitData& data, const Curve& curve, double reach) {
  const Eigen::VectorXcd& h = curve.h;
  Eigen::ArrayXd sums(h.size() + 1), result(h.size());
  sums[0] = 0;
  for (Eigen::Index i = 0; i < h.size(); ++i) sums[i + 1] = sums[i] + std::norm(h[i]);
  Eigen::Index first = 0, end = 0;
  for (Eigen::Index i = 0; i < h.size(); ++i) {
    const double omega = data.s[i].imag();
    while (data.s[first].imag() * reach < omega) ++first;
    while (end < h.size() && data.s[end].imag() <= omega * reach) ++end;
    result[i] = std::sqrt((sums[end] - sums[first]) / static_cast<double>(end - first));
  }
  return result;
}

Eigen::VectorXcd residual_poles(const FitData& data) {
  Eigen::VectorXcd poles(2 * data.dofs);
  for (Eigen::Index d = 0; d < data.dofs; ++d) {
    const double place = kResidualPlace * (1 + kResidualSpread * static_cast<double>(d));
    const std::complex<double> unit(-kResidualDamping, 1);
    poles[2 * d] = data.lowest() / place * unit;
    poles[2 * d + 1] = data.highest() * place * unit;
  }
  return poles;
}

std::vector<DirectionGroup> independent_groups(const dynamics::FrequencyResponse& frf) {
  const std::vector<std::string> names = direction_names(frf);
  const auto index = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) - names.begin();
  };
  // Directions that an entry connects get one label.
  std::vector<std::size_t> label(names.size());
  std::iota(label.begin(), label.end(), std::size_t{0});
  for (const auto& entry : frf.entries) {
    if (entry.h.isZero(0)) continue;
    const std::size_t from = label[index(entry.response)], to = label[index(entry.reference)];
    std::replace(label.begin(), label.end(), from, to);
  }
  std::vector<DirectionGroup> groups;
  std::vector<std::size_t> group_label;
  for (std::size_t e = 0; e < frf.entries.size(); ++e) {
    if (frf.entries[e].h.isZero(0)) continue;
    const std::size_t wanted = label[index(frf.entries[e].response)];
    const auto found = std::find(group_label.begin(), group_label.end(), wanted);
    if (found == group_label.end()) {
      group_label.push_back(wanted);
      groups.push_back({{e}});
    } else {
      groups[found - group_label.begin()].entries.push_back(e);
    }
  }
  // An entry of zeros between directions of one group is data like any other.
  for (std::size_t e = 0; e < frf.entries.size(); ++e) {
    const std::size_t from = label[index(frf.entries[e].response)],
                      to = label[index(frf.entries[e].reference)];
    const auto found = std::find(group_label.begin(), group_label.end(), from);
    if (!frf.entries[e].h.isZero(0) || from != to || found == group_label.end()) continue;
    groups[found - group_label.begin()].entries.push_back(e);
  }
  return groups;
}

std::vector<std::string> direction_names(const dynamics::FrequencyResponse& frf) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const char* usual : {"x", "y", "z"}) {
    for (const auto& entry : frf.entries) {
      if (entry.response == usual || entry.reference == usual) add(usual);
    }
  }
  for (const auto& entry : frf.entries) {
    add(entry.response);
    add(entry.reference);
  }
  return names;
}

}  // namespace stablecut::modal
