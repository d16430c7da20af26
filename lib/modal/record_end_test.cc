#include "modal/record_end.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"

using namespace stablecut;
using namespace stablecut::modal;

namespace {

// One mode of 20 Hz, 2 %, whose decay is 2.51 1/s, and one of 300 Hz.
dynamics::ModalModel table(double deviation) {
  dynamics::ModalModel model;
  model.dofs = {"x"};
  for (const double hz : {20.0, 300.0})
    model.modes.push_back({hz, 0.02, Eigen::VectorXcd::Ones(1), Eigen::VectorXcd::Ones(1)});
  model.covariance = Eigen::MatrixXd::Identity(12, 12) * deviation * deviation;
  return model;
}

}  // namespace

TEST_CASE("modes that ring at the end of a record are told by the distance of its lines") {
  const auto ringing = ringing_at_end(table(1e-3), Eigen::VectorXd::LinSpaced(1000, 1, 1000));
  REQUIRE(ringing);
  CHECK(ringing->record_s == Approx(1));
  CHECK(ringing->hz == std::vector<double>{20});
  CHECK(ringing->share == Approx(std::exp(-0.02 * kTwoPi * 20)));
  // A long record, vectors that are known worse, lines of a sweep, modes outside the band.
  CHECK_FALSE(ringing_at_end(table(1e-3), Eigen::VectorXd::LinSpaced(4000, 0.25, 1000)));
  CHECK_FALSE(ringing_at_end(table(0.2), Eigen::VectorXd::LinSpaced(1000, 1, 1000)));
  CHECK_FALSE(
      ringing_at_end(table(1e-3), Eigen::VectorXd::LinSpaced(300, 0, std::log(1000)).array().exp().matrix()));
  dynamics::ModalModel outside = table(1e-3);
  outside.modes[0].out_of_band = true;
  CHECK_FALSE(ringing_at_end(outside, Eigen::VectorXd::LinSpaced(1000, 1, 1000)));
}
