#include "modal/stabilization.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>

#include "base/parallel.h"
#include "dynamics/modal_model.h"
#include "modal/vector_fitting.h"

namespace stablecut::modal {
namespace {

constexpr int kLeastPairs = 3;
constexpr int kDiagramRelocations = 10;
constexpr double kFrequencyChange = 0.01;
constexpr double kDampingChange = 0.1;

// Poles in the band of one order.
std::vector<StabilizationPole> poles_of(const FitData& data, int order) {
  Eigen::VectorXcd poles = starting_poles(data, order);
  // The start adds one on either side of the band.
  poles = poles.segment(1, poles.size() - 2).eval();
  for (int i = 0; i < kDiagramRelocations; ++i) poles = relocate_poles(data, poles);
  std::vector<StabilizationPole> result;
  for (const auto& pole : poles) {
    if (!data.in_band(pole)) continue;
    dynamics::Mode mode;
    dynamics::set_pole(mode, pole);
    result.push_back({mode.frequency_hz, mode.damping_ratio, Stability::kNew});
  }
  return result;
}

// Says of each pole what it has in common with those of the order before.
void compare(const std::vector<StabilizationPole>& before, std::vector<StabilizationPole>& now) {
  for (StabilizationPole& pole : now) {
    for (const StabilizationPole& other : before) {
      if (std::abs(pole.frequency_hz - other.frequency_hz) > kFrequencyChange * pole.frequency_hz) continue;
      const bool damping =
          std::abs(pole.damping_ratio - other.damping_ratio) <= kDampingChange * pole.damping_ratio;
      pole.stability = std::max(pole.stability, damping ? Stability::kPole : Stability::kFrequency);
    }
  }
}

}  // namespace

std::vector<StabilizationOrder> stabilization(const std::vector<FitData>& groups, int highest, int threads,
                                              const Progress& progress) {
  for (const FitData& data : groups)
    highest = std::min(highest, static_cast<int>(data.lines() / kLinesPerPair));
  const int count = std::max(0, highest - kLeastPairs + 1);
  const std::size_t orders = count;
  std::vector<StabilizationOrder> result(orders);
  std::vector<std::vector<StabilizationPole>> found(orders * groups.size());
  // The highest orders, which cost most, first.
  parallel_for(
      found.size(), threads,
      [&](std::size_t i) {
        const std::size_t at = found.size() - 1 - i;
        found[at] = poles_of(groups[at % groups.size()], kLeastPairs + static_cast<int>(at / groups.size()));
      },
      progress);
  for (std::size_t o = 0; o < orders; ++o) {
    result[o].order = kLeastPairs + static_cast<int>(o);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      std::vector<StabilizationPole>& now = found[o * groups.size() + g];
      if (o > 0) compare(found[(o - 1) * groups.size() + g], now);
      result[o].poles.insert(result[o].poles.end(), now.begin(), now.end());
    }
    std::sort(result[o].poles.begin(), result[o].poles.end(),
              [](const StabilizationPole& a, const StabilizationPole& b) {
                return a.frequency_hz < b.frequency_hz;
              });
  }
  return result;
}

Eigen::MatrixXd mode_indicator(const dynamics::FrequencyResponse& frf) {
  const std::vector<std::string> names = direction_names(frf);
  const auto index = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) - names.begin();
  };
  const Eigen::Index count = names.size();
  Eigen::MatrixXd values(frf.frequency_hz.size(), count);
  for (Eigen::Index line = 0; line < values.rows(); ++line) {
    Eigen::MatrixXcd h = Eigen::MatrixXcd::Zero(count, count);
    for (const auto& entry : frf.entries) h(index(entry.response), index(entry.reference)) = entry.h[line];
    values.row(line) = Eigen::JacobiSVD<Eigen::MatrixXcd>(h).singularValues().transpose();
  }
  return values;
}

}  // namespace stablecut::modal
