#include "milling/sampled_stability.h"

#include <catch2/catch.hpp>

#include "base/range.h"
#include "milling/lobes.h"
#include "milling/milling_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

double limit_with(const dynamics::ModalModel& model, const Cutter& cutter) {
  const TipStructure structure = tip_structure(model);
  const auto chart = stability_chart(structure, cutter, {8000.0 / 60}, {2e-3}, {}, false, 1);
  const StabilityCrossing* limit = limit_of(chart.crossings[0]);
  REQUIRE(limit != nullptr);
  return limit->depth_m;
}

}  // namespace

TEST_CASE("without deviations every sample is the cut itself") {
  const dynamics::ModalModel model = fixtures::coupled_modes(3, 5);
  const Cutter cutter = fixtures::benchmark_cutter(true, 0.3);
  const double limit = limit_with(model, cutter);
  const auto sampled = sampled_stability(sampled_cuts(model, cutter, {}, 4, 1), {8000.0 / 60},
                                         {0.5 * limit, 0.9 * limit, 1.05 * limit}, {16}, true, 1);
  CHECK(*sampled.limit_95_m[0][0] == Approx(limit).epsilon(1e-4));
  CHECK(*sampled.limit_95_m[0][1] == Approx(limit).epsilon(1e-4));
  CHECK(sampled.stable_share(0, 0) == 1);
  CHECK(sampled.stable_share(1, 0) == 1);
  CHECK(sampled.stable_share(2, 0) == 0);
}

TEST_CASE("an interval of the limit is where the parameters' intervals put it", "[campaign]") {
  dynamics::ModalModel model = fixtures::oscillator({"x"});
  const Cutter cutter = fixtures::benchmark_cutter(false, 1);
  const double limit = limit_with(model, cutter);
  // At this speed the limit grows with Kt, which turns the force: its quantiles are the limits at Kt's.
  Cutter hard = cutter, soft = cutter;
  hard.kt_n_per_m2 *= 1 + 1.96 * 0.05;
  soft.kt_n_per_m2 *= 1 - 1.96 * 0.05;
  const std::vector<double> depths = {0.7 * limit, limit, 1.4 * limit};
  const auto by_kt = [&](int threads) {
    return sampled_stability(sampled_cuts(model, cutter, {0.05 * cutter.kt_n_per_m2, 0}, 200, 3),
                             {8000.0 / 60}, depths, {24}, true, threads);
  };
  const auto sampled = by_kt(1);
  CHECK(*sampled.limit_95_m[0][0] - limit == Approx(limit_with(model, soft) - limit).epsilon(0.2));
  CHECK(*sampled.limit_95_m[0][1] - limit == Approx(limit_with(model, hard) - limit).epsilon(0.2));
  CHECK(sampled.stable_share(0, 0) == Approx(1));
  CHECK(sampled.stable_share(1, 0) == Approx(0.5).margin(0.05));
  CHECK(sampled.stable_share(2, 0) == Approx(0).margin(1e-12));
  CHECK(by_kt(2).stable_share == sampled.stable_share);

  // The same of a damping ratio in the table's covariance.
  model.covariance = Eigen::MatrixXd::Zero(6, 6);
  model.covariance(1, 1) = std::pow(0.05 * 0.011, 2);
  dynamics::ModalModel more = model;
  more.modes[0].damping_ratio *= 1 + 1.96 * 0.05;
  const auto of_table =
      sampled_stability(sampled_cuts(model, cutter, {}, 200, 3), {8000.0 / 60}, {4e-3}, {24}, false, 1);
  CHECK(*of_table.limit_95_m[0][1] - limit == Approx(limit_with(more, cutter) - limit).epsilon(0.2));
  CHECK(of_table.stable_share.size() == 0);
}

TEST_CASE("a quantile above the largest depth is unknown") {
  const dynamics::ModalModel model = fixtures::oscillator({"x"});
  const Cutter cutter = fixtures::benchmark_cutter(false, 1);
  const double limit = limit_with(model, cutter);
  const auto sampled = sampled_stability(sampled_cuts(model, cutter, {0.05 * cutter.kt_n_per_m2, 0}, 100, 3),
                                         {8000.0 / 60}, {limit}, {24}, true, 1);
  CHECK(sampled.limit_95_m[0][0]);
  CHECK(!sampled.limit_95_m[0][1]);
}
