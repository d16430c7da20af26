#include "modal/stabilization.h"

#include <catch2/catch.hpp>

#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;

TEST_CASE("the modes are stable poles once there are enough") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  const auto orders = stabilization({fixtures::data_of(truth, 1e-3)}, 9, 2, {});
  REQUIRE(orders.size() == 7);
  CHECK(orders.front().order == 3);
  CHECK(orders.back().order == 9);
  for (std::size_t o = 3; o < orders.size(); ++o) {
    for (const dynamics::Mode& mode : truth.modes) {
      INFO("order " << orders[o].order << ", " << mode.frequency_hz << " Hz");
      CHECK(std::any_of(orders[o].poles.begin(), orders[o].poles.end(), [&](const StabilizationPole& pole) {
        return pole.stability == Stability::kPole &&
               std::abs(pole.frequency_hz - mode.frequency_hz) < 1e-3 * mode.frequency_hz &&
               std::abs(pole.damping_ratio - mode.damping_ratio) < 0.05 * mode.damping_ratio;
      }));
    }
  }
  for (const auto& pole : orders.front().poles) CHECK(pole.stability == Stability::kNew);
}

TEST_CASE("few lines allow few orders") {
  FitData data = fixtures::data_of(fixtures::close_pair(), 1e-3);
  data.s = data.s.head(15).eval();
  for (Curve& curve : data.curves) {
    curve.h = curve.h.head(15).eval();
    curve.weight = curve.weight.head(15).eval();
  }
  CHECK(stabilization({data}, 40, 1, {}).size() == 3);
}

TEST_CASE("the mode indicator is the singular values, largest first") {
  const dynamics::FrequencyResponse frf =
      dynamics::synthesize(fixtures::close_pair(), Eigen::VectorXd::LinSpaced(5, 100, 140));
  const Eigen::MatrixXd values = mode_indicator(frf);
  REQUIRE(values.rows() == 5);
  REQUIRE(values.cols() == 2);
  for (Eigen::Index i = 0; i < 5; ++i) {
    double square = 0;
    for (const auto& entry : frf.entries) square += std::norm(entry.h[i]);
    CHECK(values.row(i).squaredNorm() == Approx(square));
    CHECK(values(i, 0) >= values(i, 1));
    const auto determinant =
        frf.entries[0].h[i] * frf.entries[3].h[i] - frf.entries[1].h[i] * frf.entries[2].h[i];
    CHECK(values(i, 0) * values(i, 1) == Approx(std::abs(determinant)));
  }
}
