#include "milling/envelope.h"

#include <catch2/catch.hpp>

#include "milling/milling_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::milling;

TEST_CASE(
    "the chart of two structures has the larger radius and the lower limit of both, and says whose it is") {
  const Cutter cutter = fixtures::benchmark_cutter(true, 0.3);
  const std::vector<double> speeds = {80, 105, 130, 160, 200, 250, 310}, depths = {0, 1e-3, 2e-3, 4e-3};
  std::vector<StabilityChart> charts;
  for (const unsigned seed : {2U, 4U})
    charts.push_back(stability_chart(tip_structure(fixtures::coupled_modes(5, seed)), cutter, speeds, depths,
                                     {}, true, 1));
  const StabilityChart both = envelope_of(charts);
  int of_table[] = {0, 0};
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    for (Eigen::Index d = 0; d < 4; ++d)
      CHECK(both.spectral_radius(d, s) ==
            std::max(charts[0].spectral_radius(d, s), charts[1].spectral_radius(d, s)));
    const StabilityCrossing *first = limit_of(charts[0].crossings[s]),
                            *second = limit_of(charts[1].crossings[s]);
    const StabilityCrossing* limit = limit_of(both.crossings[s]);
    REQUIRE((limit != nullptr) == (first != nullptr || second != nullptr));
    if (limit == nullptr) continue;
    const double lowest =
        std::min(first != nullptr ? first->depth_m : 1, second != nullptr ? second->depth_m : 1);
    CHECK(limit->depth_m == lowest);
    CHECK((limit->table == 0) == (first != nullptr && first->depth_m == lowest));
    ++of_table[limit->table];
  }
  CHECK(of_table[0] >= 1);
  CHECK(of_table[1] >= 1);
}

TEST_CASE("a speed that one structure does not resolve is unknown for all") {
  StabilityChart good, bad;
  for (StabilityChart* chart : {&good, &bad}) {
    chart->spectral_radius = Eigen::MatrixXd::Constant(1, 1, 0.5);
    chart->crossings.resize(1);
    chart->error = {1e-9};
    chart->resolution = {7};
    chart->failure = {""};
  }
  bad.failure = {"too slow"};
  const StabilityChart both = envelope_of({good, bad});
  CHECK(both.failure[0] == "too slow");
  CHECK(std::isnan(both.spectral_radius(0, 0)));
  CHECK(both.resolution[0] == 0);
}
