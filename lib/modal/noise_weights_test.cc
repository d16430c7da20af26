#include "modal/noise_weights.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "modal/error_weights.h"
#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;

TEST_CASE("a weight is the inverse of the variance and the regime's floors") {
  FitData data = fixtures::data_of(fixtures::close_pair(), 1e-2);
  data.curves[3].h.setZero();
  CurveVariances variance;
  for (const Curve& curve : data.curves) variance.push_back(1e-4 * curve.h.cwiseAbs2());
  double largest_rms = 0;
  for (const Curve& curve : data.curves)
    largest_rms = std::max(largest_rms, curve.h.norm() / std::sqrt(1000.0));
  struct Floors {
    Regime regime;
    double of_value, of_rms;
  };
  for (const Floors& floors : {Floors{Regime::kNoise, 1e-4, 1e-6}, Floors{Regime::kNoiseless, 1e-7, 1e-9},
                               Floors{Regime::kModelError, 1e-4, 0.045}}) {
    weigh_curves(data, variance, {}, floors.regime);
    for (std::size_t e = 0; e < 4; ++e) {
      const Curve& curve = data.curves[e];
      // A curve of zeros is as sure as the largest one.
      const double rms = e == 3 ? largest_rms : curve.h.norm() / std::sqrt(1000.0);
      const Eigen::VectorXd expected =
          (variance[e].array() + std::pow(floors.of_value, 2) * curve.h.array().abs2() +
           std::pow(floors.of_rms * rms, 2))
              .inverse();
      CHECK((curve.weight - expected).norm() < 1e-12 * expected.norm());
    }
  }
}

TEST_CASE("where nearly all noise is shared each curve keeps what it has of its own") {
  FitData data = fixtures::data_of(fixtures::close_pair(), 1e-2);
  CurveVariances own, shared, variance;
  for (const Curve& curve : data.curves) {
    shared.push_back(1e-2 * curve.h.cwiseAbs2());
    own.push_back(1e-3 * shared.back());
    variance.push_back(own.back() + shared.back());
  }
  // The measured values are off by more than the own part: the shared variance is not theirs any more.
  for (Curve& curve : data.curves) curve.h *= 1.1;
  weigh_curves(data, variance, shared, Regime::kNoise);
  const std::vector<ErrorWeights> weights = error_weights(data);
  for (std::size_t c = 0; c < own.size(); ++c) {
    // The regime's floor is a thousandth of the own part, and adds some more where the curve is small.
    CHECK((weights[c].own.cwiseProduct(own[c]).array() <= 1 + 1e-9).all());
    CHECK((weights[c].own.cwiseProduct(own[c]).array() > 0.5).any());
  }
}

TEST_CASE("the floors decide where there is next to no noise") {
  FitData data = fixtures::data_of(fixtures::close_pair(), 1e-2);
  for (const auto& [share, regime, decide] :
       {std::tuple(1e-2, Regime::kNoise, false), std::tuple(2e-3, Regime::kNoise, false),
        std::tuple(5e-4, Regime::kNoise, true), std::tuple(0.0, Regime::kNoise, true),
        std::tuple(5e-4, Regime::kNoiseless, false)}) {
    CurveVariances variance;
    for (const Curve& curve : data.curves) variance.push_back(share * share * curve.h.cwiseAbs2());
    weigh_curves(data, variance, {}, regime);
    INFO(share);
    CHECK(floors_decide(data, regime) == decide);
  }
}

TEST_CASE("variances differ much where any line's does") {
  const CurveVariances a(2, Eigen::VectorXd::Ones(9));
  CurveVariances b = a;
  CHECK_FALSE(differ_much(a, b));
  b[1][4] = 3.9;
  CHECK_FALSE(differ_much(a, b));
  b[1][4] = 4.1;
  CHECK(differ_much(a, b));
  CHECK(differ_much(b, a));
}

TEST_CASE("noise of the curves and noise of a residual are what was added") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  FitData data = fixtures::data_of(truth, 1e-2);
  dynamics::FrequencyResponse noisy = dynamics::synthesize(truth, Eigen::VectorXd::LinSpaced(1000, 1, 1000));
  dynamics::add_noise(noisy, {{}, 40.0, 2});
  for (std::size_t e = 0; e < 4; ++e) data.curves[e].h = noisy.entries[e].h;
  const ResidualVariances residual = residual_as_noise(data, truth.modes, 1, true);
  CHECK_FALSE(residual.is_local);
  // Medians of windows of 49 scatter by 20 %, a fit to all 1000 lines by 3 %.
  const CurveVariances by_curve = scatter_of_curves(data),
                       by_residual = scatter_of_residual(data, truth.modes);
  for (std::size_t e = 0; e < 4; ++e) {
    const Eigen::ArrayXd expected = noisy.entries[e].variance;
    CHECK((residual.variance[e].array() / expected).mean() == Approx(1).margin(0.12));
    CHECK((by_residual[e].array() / expected).mean() == Approx(1).margin(0.25));
    // 300 lines are six windows; elsewhere sharp peaks count as noise of the lines around them.
    CHECK((by_curve[e].array() / expected).tail(300).mean() == Approx(1).margin(0.4));
  }
}
