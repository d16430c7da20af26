#include "modal/vector_fitting.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;
using Complex = std::complex<double>;

TEST_CASE("relocation of as many poles as there are finds them in exact data") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  const FitData data = fixtures::data_of(truth, 1e-3);
  Eigen::VectorXcd poles(4);
  poles << Complex(-6, 500), Complex(-9, 900), Complex(-20, 2000), Complex(-40, 5000);
  for (int i = 0; i < 20; ++i) poles = relocate_poles(data, poles);
  REQUIRE(poles.size() == 4);
  for (Eigen::Index k = 0; k < 4; ++k) {
    const Complex expected = truth.modes[k].pole();
    CHECK(std::abs(poles[k] - expected) < 1e-6 * std::abs(expected));
  }
  const LinearResidues linear = linear_residues(data, poles);
  CHECK(linear.chi_square < 1e-3);
  for (std::size_t e = 0; e < data.curves.size(); ++e) {
    const Complex expected = truth.modes[3].residue()(data.curves[e].response, data.curves[e].reference);
    CHECK(std::abs(linear.residue(3, e) - expected) < 1e-5 * truth.modes[3].residue().norm());
  }
}

TEST_CASE("a pole that is no mode costs nothing to leave out") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  const FitData data = fixtures::data_of(truth, 1e-3);
  Eigen::VectorXcd poles(5);
  for (Eigen::Index k = 0; k < 4; ++k) poles[k] = truth.modes[k].pole();
  poles[4] = Complex(-30, 2900);
  const LinearResidues linear = linear_residues(data, poles);
  CHECK(linear.removal_loss[4] < 1e-3);
  CHECK(linear.removal_loss.head(4).minCoeff() > 1e4);
}

TEST_CASE("start poles cover the band, no two alike") {
  const FitData data = fixtures::data_of(fixtures::close_pair(), 1e-2);
  const Eigen::VectorXcd poles = starting_poles(data, 30);
  REQUIRE(poles.size() >= 30);
  for (Eigen::Index k = 1; k < poles.size(); ++k) CHECK(poles[k].imag() > poles[k - 1].imag());
  CHECK(poles[0].imag() < data.s[0].imag());
  CHECK(poles[poles.size() - 1].imag() > data.s[data.lines() - 1].imag());
}
