#include "modal/pole_shift.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "dynamics/synthesis.h"
#include "modal/fit.h"
#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;
using Complex = std::complex<double>;

namespace {

// The curves of force y, or of response y, have natural frequencies that are factors [modes] times those of
// the others.
dynamics::FrequencyResponse shifted(const std::vector<double>& factors, bool of_force, std::uint64_t seed,
                                    double db = 55) {
  const dynamics::ModalModel model = fixtures::skew_modes();
  dynamics::ModalModel moved = model;
  for (std::size_t k = 0; k < moved.modes.size(); ++k) moved.modes[k].frequency_hz *= factors[k];
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(1500, 1, 1000);
  dynamics::FrequencyResponse frf = dynamics::synthesize(model, hz);
  const dynamics::FrequencyResponse other = dynamics::synthesize(moved, hz);
  for (auto& entry : frf.entries)
    if ((of_force ? entry.reference : entry.response) == "y")
      entry.h = other.find(entry.response, entry.reference)->h;
  return fixtures::with_noise(std::move(frf), db, seed);
}

// A round tool with a pair of modes 1.5 % apart, each in a direction of its own, turned by an angle against
// the axes; or with hits beside the sensor.
dynamics::FrequencyResponse round_tool(double angle, double beside, std::uint64_t seed) {
  dynamics::ModalModel model;
  model.dofs = {"x", "y"};
  const Eigen::Vector2cd one(std::cos(angle), std::sin(angle)), two(-std::sin(angle), std::cos(angle));
  const Eigen::Vector2cd hit(1 + beside, 1 - beside);
  model.modes = {fixtures::mode(120, 0.01, one, Complex(0, -1e-4) * one.cwiseProduct(hit)),
                 fixtures::mode(121.8, 0.01, two, Complex(0, -1e-4) * two.cwiseProduct(hit)),
                 fixtures::mode(640, 0.02, {1, 0.4}, {Complex(0, -1e-4), Complex(0, -4e-5)})};
  return fixtures::with_noise(dynamics::synthesize(model, Eigen::VectorXd::LinSpaced(1000, 1, 1000)), 45,
                              seed);
}

std::vector<FitFinding> shifts(const dynamics::FrequencyResponse& frf) {
  std::vector<FitFinding> found = fit_modes(frf).findings;
  std::erase_if(found, [](const FitFinding& finding) { return finding.kind != FitFindingKind::kShifted; });
  return found;
}

}  // namespace

TEST_CASE("natural frequencies of one force or response that differ from the other's are named") {
  for (const bool of_force : {true, false}) {
    for (const double factor : {0.998, 1.008}) {
      const auto found = shifts(shifted({factor, factor, factor, factor}, of_force, 1));
      REQUIRE(found.size() == 1);
      const PoleShift& shift = found[0].shift;
      CHECK(found[0].directions == std::vector<std::string>{"y", "x"});
      CHECK(shift.of_force == of_force);
      CHECK(shift.doubled >= 1);
      CHECK(shift.least == shift.most);
      CHECK(std::abs(shift.most - factor) < 4 * shift.deviation);
      CHECK(shift.deviation < 1e-4);
    }
  }
}

TEST_CASE("a shift that doubles no mode is found by all of them, and each mode may have its own") {
  const auto small = shifts(shifted({1.002, 1.002, 1.002, 1.002}, true, 2, 18));
  REQUIRE(small.size() == 1);
  CHECK(small[0].shift.doubled == 0);
  CHECK(std::abs(small[0].shift.most - 1.002) < 4 * small[0].shift.deviation);
  // As a mass that was added moves the modes of a tool more than those of a robot.
  const auto each = shifts(shifted({1, 1, 0.998, 0.992}, true, 3));
  REQUIRE(each.size() == 1);
  CHECK(each[0].shift.doubled == 2);
  CHECK(each[0].shift.least == Approx(0.992).margin(4 * each[0].shift.deviation));
  CHECK(each[0].shift.most == Approx(0.998).margin(4 * each[0].shift.deviation));
}

TEST_CASE("sound curves have no shift, whatever their modes are") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CHECK(shifts(shifted({1, 1, 1, 1}, true, seed)).empty());
    CHECK(shifts(fixtures::with_noise(
                     dynamics::synthesize(fixtures::close_pair(), Eigen::VectorXd::LinSpaced(1000, 1, 1000)),
                     40, seed))
              .empty());
    for (const double angle : {0.0, 0.02, 0.3, 0.8})
      for (const double beside : {0.0, 0.05}) CHECK(shifts(round_tool(angle, beside, seed)).empty());
  }
}
