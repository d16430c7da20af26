#include "milling/depth_scan.h"

#include <catch2/catch.hpp>
#include <functional>

#include "base/range.h"
#include "milling/milling_fixtures_test.h"
#include "milling/spectral.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

// Every change of sign on a fine grid is a boundary, in the same order. How many there are.
std::size_t check_against_direct(const PeriodMap& map, double largest_depth_m, int count) {
  const DepthScan scan(map, largest_depth_m);
  const std::vector<double> depths = Range{0, largest_depth_m, count}.values();
  const std::vector<double> radii = scan.spectral_radii(depths), direct = spectral_radii(map, depths);
  const std::vector<StabilityBoundary> boundaries = scan.boundaries();
  std::size_t found = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    INFO("depth " << depths[i] << ", radius " << direct[i]);
    CHECK(std::abs(radii[i] - direct[i]) < 2e-7 * std::max(1.0, direct[i]));
    if (i == 0 || (direct[i] > 1) == (direct[i - 1] > 1)) continue;
    // Pairs of boundaries between two grid points are finer than the grid.
    while (found < boundaries.size() && boundaries[found].depth_m < depths[i - 1]) ++found;
    bool seen = false;
    for (; found < boundaries.size() && boundaries[found].depth_m <= depths[i]; ++found)
      seen = seen || boundaries[found].unstable_above == (direct[i] > 1);
    CHECK(seen);
  }
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    CHECK(boundaries[i].unstable_above == (i % 2 == 0));
    CHECK(std::abs(spectral_radius(map, boundaries[i].depth_m) - 1) < 1e-8);
  }
  return boundaries.size();
}

// A map whose leading multipliers are known: the roots of z^2 - sum(a) z + product(a), a the depth.
class KnownMap : public PeriodMap {
 public:
  using Function = std::function<double(double)>;
  KnownMap(Function sum, Function product)
      : PeriodMap(one_mode(), 1, 1), sum_(std::move(sum)), product_(std::move(product)) {}

  Eigen::MatrixXd monodromy(double depth_m) const override {
    Eigen::MatrixXd companion(2, 2);
    companion << sum_(depth_m), -product_(depth_m), 1, 0;
    return companion;
  }
  std::vector<ForceImpulse> forces(double, std::complex<double>, const Eigen::VectorXcd&) const override {
    return {};
  }
  double radius(double depth_m) const {
    const std::complex<double> half = sum_(depth_m) / 2;
    const std::complex<double> root = std::sqrt(half * half - product_(depth_m));
    return std::max(std::abs(half + root), std::abs(half - root));
  }

 private:
  static const TipStructure& one_mode() {
    static const TipStructure structure = tip_structure(fixtures::oscillator({"x"}));
    return structure;
  }
  Function sum_, product_;
};

// The known multiplier, and one of 0.1 beside it.
KnownMap alone(const KnownMap::Function& multiplier) {
  return {[=](double a) { return multiplier(a) + 0.1; }, [=](double a) { return 0.1 * multiplier(a); }};
}

}  // namespace

TEST_CASE("a scan ends where the map's rounding makes nearly the tolerance in every panel, however narrow") {
  // Up and down from node to node: the last coefficient is 1.3 times the amplitude, whatever the width.
  int maps = 0;
  const KnownMap uneven([&](double) { return 0.5 + (++maps % 2 == 0 ? 1.5e-7 : -1.5e-7); },
                        [](double) { return 0.0; });
  const DepthScan scan(uneven, 1);
  CHECK(std::abs(scan.spectral_radii({0.9}).front() - 0.5) < 5e-7);
  CHECK(maps < 8 * 4 * 512 * 1.1);  // panels of a quarter of the least width
}

TEST_CASE("polynomials of degree kNodes - 3 are followed exactly, in the widest panels") {
  // Their last two coefficients are zero in any panel, so that kMostGrowth alone limits the widths: 1/8,
  // 0.21, 0.36 and the rest. With fewer nodes there are more panels.
  int maps = 0;
  const auto polynomial = [](double a) { return 1.1 + 0.02 * std::cos(5 * std::acos(2 * a - 1)); };
  static_assert(kNodes - 3 == 5);
  const KnownMap map([&](double a) { return ++maps, polynomial(a) + 0.1; },
                     [&](double a) { return 0.1 * polynomial(a); });
  const DepthScan scan(map, 1);
  CHECK(maps == 4 * kNodes);
  const std::vector<double> depths = Range{0, 1, 201}.values(), radii = scan.spectral_radii(depths);
  CHECK(maps == 4 * kNodes);
  for (std::size_t i = 0; i < depths.size(); ++i) CHECK(std::abs(radii[i] - polynomial(depths[i])) < 1e-12);
}

TEST_CASE("an island narrower than the distance of the samples is found, and one that ends below 1 is none") {
  // 1 + rise - (a - middle)^2 is above 1 within sqrt(rise) of the middle: a ten-thousandth of the depths. In
  // a panel a sample is some hundredth of them from the next.
  const double rise = 1e-8, half_width = 1e-4;
  for (const double sign : {1.0, -1.0}) {
    for (double middle = 0.153; middle < 1; middle += 0.107) {
      const auto map = [&](double top) {
        return alone([=](double a) { return 1 + sign * (top - (a - middle) * (a - middle)); });
      };
      INFO("middle " << middle << ", sign " << sign);
      const KnownMap island = map(rise), none = map(-rise);
      const auto boundaries = DepthScan(island, 1).boundaries();
      REQUIRE(boundaries.size() == 2);
      CHECK(std::abs(boundaries[0].depth_m - (middle - half_width)) < 2e-8);
      CHECK(std::abs(boundaries[1].depth_m - (middle + half_width)) < 2e-8);
      CHECK(boundaries[0].unstable_above == (sign > 0));
      CHECK(boundaries[1].unstable_above == (sign < 0));
      CHECK(DepthScan(none, 1).boundaries().empty());
    }
  }
}

TEST_CASE("multipliers that meet on the real axis are followed through the meeting") {
  // (z + 0.8 + a / 3)^2 = (a - 0.47) / 20: a complex pair up to 0.47, then two real ones; or the other way.
  for (const double side : {1.0, -1.0}) {
    const KnownMap map([](double a) { return -2 * (0.8 + a / 3); },
                       [=](double a) { return (0.8 + a / 3) * (0.8 + a / 3) - side * (a - 0.47) / 20; });
    const DepthScan scan(map, 1);
    const std::vector<double> depths = Range{0, 1, 1001}.values(), radii = scan.spectral_radii(depths);
    double change = 0;
    for (std::size_t i = 0; i < depths.size(); ++i) {
      CHECK(std::abs(radii[i] - map.radius(depths[i])) < 2e-7 * std::max(1.0, radii[i]));
      if (i > 0 && (radii[i] > 1) != (radii[i - 1] > 1)) change = depths[i];
    }
    REQUIRE(scan.boundaries().size() == 1);
    CHECK(scan.boundaries()[0].depth_m == Approx(change).margin(1e-3));
    CHECK(std::abs(map.radius(scan.boundaries()[0].depth_m) - 1) < 1e-8);
  }
}

TEST_CASE("the multipliers' branches agree with every depth computed by itself") {
  std::size_t boundaries = 0;
  for (const int modes : {1, 2, 4, 9, 15}) {
    const TipStructure structure =
        tip_structure(fixtures::coupled_modes(modes, static_cast<unsigned>(modes)));
    for (const double speed : {60.0, 150.0, 400.0}) {
      for (const double immersion : {0.1, 0.6}) {
        INFO(modes << " modes, " << speed << " /s, immersion " << immersion);
        const SpectralMap map(structure, fixtures::benchmark_cutter(speed < 200, immersion), speed, 14);
        boundaries += check_against_direct(map, 6e-3, 401);
      }
    }
  }
  CHECK(boundaries > 20);
}

TEST_CASE("flips and islands of the one-mode slot and of low immersion") {
  const TipStructure one = tip_structure(fixtures::oscillator({"x"}));
  const TipStructure two = tip_structure(fixtures::oscillator({"x", "y"}));
  std::size_t slot = 0, low = 0;
  for (const double rpm : {2500.0, 5000.0, 7000.0, 9000.0, 12000.0, 14500.0, 20000.0, 26000.0}) {
    INFO(rpm << " rpm");
    slot +=
        check_against_direct(SpectralMap(one, fixtures::benchmark_cutter(false, 1), rpm / 60, 24), 5e-3, 801);
    low += check_against_direct(SpectralMap(two, fixtures::benchmark_cutter(true, 0.05), rpm / 60, 12), 10e-3,
                                801);
  }
  CHECK(slot >= 8);
  CHECK(low >= 6);
  // Stable again from 2.9 to 3.8 mm.
  const Cutter down = fixtures::benchmark_cutter(false, 0.1);
  CHECK(check_against_direct(SpectralMap(one, down, 18025.3 / 60, 16), 20e-3, 801) == 3);
}

TEST_CASE("a boundary below the first node of an unresolved first panel is found") {
  // Up and down below depth 0.1 so fast that no panel follows it, above 1 everywhere but next to depth 0.
  const KnownMap map =
      alone([](double a) { return 0.9 + 0.4 * std::tanh(4000 * a) + 0.05 * std::sin(1e5 * a); });
  const auto boundaries = DepthScan(map, 1).boundaries();
  REQUIRE(!boundaries.empty());
  CHECK(boundaries.front().unstable_above);
  CHECK(boundaries.front().depth_m < 1e-3);
}

TEST_CASE("a radius outside of its error is on the right side of 1, also where a better one is far above") {
  CHECK(radius_error(0.5, 0.4) == Approx(0.1));
  CHECK(radius_error(30, 20) == Approx(0.5));
  CHECK(radius_error(1e6, 1e9) == 0);
  for (const double radius : {0.2, 0.9, 0.999, 1.001, 1.5, 4.0, 90.0, 1e5}) {
    for (const double better : {0.1, 0.8, 0.9999, 1.0001, 2.0, 30.0, 1e4}) {
      if (std::abs(std::min(radius, kFarAbove) - 1) > radius_error(radius, better))
        CHECK((radius > 1) == (better > 1));
    }
  }
}

TEST_CASE("the error of a scan is that of its radii against a better map") {
  const KnownMap map = alone([](double a) { return 0.9 + 0.2 * a; });
  const KnownMap better = alone([](double a) { return 0.9 + 0.2 * a + 1e-5; });
  CHECK(DepthScan(map, 1).error_against(map) < 1e-12);
  CHECK(DepthScan(map, 1).error_against(better) == Approx(1e-5).epsilon(0.2));
}
