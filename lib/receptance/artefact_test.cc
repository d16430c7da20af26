#include "receptance/artefact.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "numerics/random.h"
#include "receptance/receptance_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::receptance;
using namespace stablecut::receptance::fixtures;

namespace {

constexpr BeamTheory kTheory = BeamTheory::kTimoshenko;
const double kOmega = rad_per_s_from_hz(900);
const BeamChain kChain = {bar(25), bar(30)};

Receptance<2> some_holder() {
  return Receptance<2>{{{2e-8, -1e-9}, {3e-7, -2e-8}}, {{3e-7, -2e-8}, {1e-5, -4e-7}}};
}

// Taps along the held artefact, one line each, of a relative standard deviation.
Taps taps_along(const std::vector<std::pair<double, double>>& places, double share) {
  Taps taps;
  for (const auto& [a, b] : places) {
    Tap tap{0, 0, a, b, Eigen::VectorXcd(1), Eigen::VectorXd(1)};
    tap.h[0] = receptance_along<2>(kChain, kTheory, kOmega, some_holder(), a, b)(0, 0);
    tap.variance[0] = std::norm(share * tap.h[0]);
    taps.push_back(tap);
  }
  return taps;
}

OpeningStiffness stiffness_of(const Taps& taps) {
  std::vector<const Tap*> pointers;
  for (const Tap& tap : taps) pointers.push_back(&tap);
  Artefact artefact(kChain, kTheory, kOmega);
  return opening_stiffness(pointers, artefact, true, 0);
}

Receptance<2> exact() { return (free_chain(kChain, kTheory, kOmega).r22 + some_holder()).inverse(); }

const std::vector<std::pair<double, double>> kPlaces = {{0, 0}, {0, 0.03}, {0.03, 0.03}, {0.015, 0.045}};

}  // namespace

TEST_CASE("three pairs of places give what holds the artefact exactly, more agree") {
  const std::vector<std::pair<double, double>> three(kPlaces.begin(), kPlaces.end() - 1);
  CHECK(relative(stiffness_of(taps_along(three, 1e-3)).value, exact()) < 1e-9);
  CHECK(relative(stiffness_of(taps_along(kPlaces, 1e-3)).value, exact()) < 1e-9);
}

TEST_CASE("the covariance of what holds the artefact is the one that is seen over seeds") {
  const Taps clean = taps_along(kPlaces, 1e-3);
  const Eigen::MatrixXcd stated = stiffness_of(clean).covariance;
  const Receptance<2> truth = exact();
  Eigen::Matrix3cd seen = Eigen::Matrix3cd::Zero();
  constexpr int kSeeds = 2000;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    Taps taps = clean;
    for (Tap& tap : taps) tap.h[0] += std::sqrt(tap.variance[0]) * numerics::unit_complex_normal(random);
    const Receptance<2> off = stiffness_of(taps).value - truth;
    const Eigen::Vector3cd error(off(0, 0), off(0, 1), off(1, 1));
    seen += error * error.adjoint() / kSeeds;
  }
  // 2000 samples of a variance are good to 2.2 %: four of their deviations, and the correlations alike.
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double size = std::sqrt(stated(i, i).real() * stated(k, k).real());
      CHECK(std::abs(seen(i, k) - stated(i, k)) < 0.09 * size);
    }
  }
}

TEST_CASE("a tap that is known badly counts little") {
  Taps taps = taps_along(kPlaces, 1e-3);
  taps[1].h[0] *= 1.5;
  CHECK(relative(stiffness_of(taps).value, exact()) > 0.03);
  taps[1].variance[0] *= 1e16;
  CHECK(relative(stiffness_of(taps).value, exact()) < 1e-6);
}

TEST_CASE("pairs that say the same do not suffice") {
  CHECK_THROWS_AS(stiffness_of(taps_along({{0, 0}, {0, 0}, {0, 0}}, 1e-3)), InvalidArgument);
  CHECK_THROWS_AS(stiffness_of(taps_along({{0, 0}, {0, 0.03}, {0.03, 0}}, 1e-3)), InvalidArgument);
}
