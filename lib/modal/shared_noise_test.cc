#include "modal/shared_noise.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "modal/modal_fixtures_test.h"
#include "modal/mode_search.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::modal;

namespace {

// Exact curves with noise of their own, that share of each value, and with relative noise that the curves of
// each reference share.
FitData noisy(double shared, double own = 1.0 / 300) {
  FitData data = fixtures::data_of(fixtures::close_pair(), 1.0 / 300);
  std::mt19937_64 generator(11);
  for (Eigen::Index reference = 0; reference < data.dofs; ++reference) {
    for (Eigen::Index i = 0; i < data.lines(); ++i) {
      const std::complex<double> common = shared * numerics::unit_complex_normal(generator);
      for (Curve& curve : data.curves) {
        if (curve.reference == reference)
          curve.h[i] *= 1.0 + common + own * numerics::unit_complex_normal(generator);
      }
    }
  }
  return data;
}

CurveVariances whole(const FitData& data, double relative_variance) {
  CurveVariances variance;
  for (const Curve& curve : data.curves) variance.push_back(relative_variance * curve.h.cwiseAbs2());
  return variance;
}

}  // namespace

TEST_CASE("noise that entries share is told from their own") {
  const std::vector<dynamics::Mode> modes = fixtures::close_pair().modes;
  const FitData data = noisy(0.01);
  CurveVariances variance = whole(data, 1e-4 + 1.0 / 9e4);
  const CurveVariances shared = shared_noise(data, modes, 1, false, variance);
  REQUIRE(shared.size() == 4);
  for (std::size_t c = 0; c < 4; ++c) {
    REQUIRE(shared[c].size() == data.lines());
    // A mean over 125 lines scatters by 9 %; over all lines by 3 %.
    const Eigen::ArrayXd relative = shared[c].array() / data.curves[c].h.array().abs2();
    CHECK(relative.mean() == Approx(1e-4).epsilon(0.12));
    const Eigen::ArrayXd own = variance[c].array() / data.curves[c].h.array().abs2() - relative;
    CHECK(own.mean() == Approx(1.0 / 9e4).epsilon(0.2));
  }
}

TEST_CASE("noise of each entry's own is shared by none") {
  const FitData data = noisy(0);
  CurveVariances variance = whole(data, 1.0 / 9e4);
  const CurveVariances shared = shared_noise(data, fixtures::close_pair().modes, 1, false, variance);
  REQUIRE(shared.size() == 4);
  for (const Eigen::VectorXd& of_curve : shared) CHECK(of_curve.size() == 0);
}

TEST_CASE("poles are nearly free of noise that all curves of a reference share") {
  const std::vector<dynamics::Mode> truth = fixtures::close_pair().modes;
  const GroupFit fit = search_modes(noisy(0.03, 1e-5), {}, {});
  REQUIRE(fit.modes().size() == truth.size());
  // After one split they are off by up to three times as much.
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const std::complex<double> pole = truth[k].pole();
    CHECK(std::abs(fit.modes()[k].pole() - pole) < 2e-4 * -pole.real());
  }
}
