#include "modal/reciprocity_factor.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "dynamics/synthesis.h"
#include "modal/fit.h"
#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;

namespace {

// Hits whose place makes each mode's force these factors [modes x 2] times what it would be at the sensor.
std::vector<FitFinding> factors(const Eigen::MatrixX2d& hits, double of_response, std::uint64_t seed) {
  dynamics::ModalModel model = fixtures::skew_modes();
  for (std::size_t k = 0; k < model.modes.size(); ++k)
    model.modes[k].psi_l.array() *= hits.row(static_cast<Eigen::Index>(k)).transpose().array();
  dynamics::FrequencyResponse frf = dynamics::synthesize(model, Eigen::VectorXd::LinSpaced(1500, 1, 1000));
  for (auto& entry : frf.entries)
    if (entry.response == "x") entry.h *= of_response;
  std::vector<FitFinding> found = fit_modes(fixtures::with_noise(std::move(frf), 50, seed)).findings;
  std::erase_if(found, [](const FitFinding& finding) { return finding.kind != FitFindingKind::kOneFactor; });
  return found;
}

const Eigen::MatrixX2d kAtSensor = Eigen::MatrixX2d::Ones(4, 2);

}  // namespace

TEST_CASE("a sensitivity that is off in one direction is one factor between mirror images") {
  for (const double factor : {0.85, 1.06}) {
    const auto found = factors(kAtSensor, factor, 1);
    REQUIRE(found.size() == 1);
    CHECK(found[0].missing == std::vector<EntryName>{{"x", "y"}, {"y", "x"}});
    CHECK(found[0].reciprocity.modes == 4);
    CHECK(std::abs(found[0].reciprocity.factor - factor) < 4 * found[0].reciprocity.deviation);
    CHECK(found[0].reciprocity.deviation < 0.01 * factor);
  }
}

TEST_CASE("reciprocal modes, and such as hits beside the sensor make, have no common factor") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) CHECK(factors(kAtSensor, 1, seed).empty());
  Eigen::MatrixX2d beside = kAtSensor;
  beside.col(0) << 1.08, 0.95, 1.02, 0.97;
  CHECK(factors(beside, 1, 5).empty());
  // All to one side: 6 % with a scatter of 5 % over four modes may be chance.
  beside.col(0) << 1.12, 1.01, 1.07, 1.04;
  CHECK(factors(beside, 1, 6).empty());
}
