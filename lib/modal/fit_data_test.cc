#include "modal/fit_data.h"

#include <catch2/catch.hpp>
#include <complex>

#include "base/units.h"

using namespace stablecut;
using namespace stablecut::modal;
using Complex = std::complex<double>;

TEST_CASE("a pole is in the band by its damped frequency, both ends in") {
  FitData data;
  data.s = Complex(0, 1) * Eigen::VectorXd::LinSpaced(11, 100, 200).cast<Complex>();
  CHECK(data.in_band({-1, 100}));
  CHECK(data.in_band({-1, 200}));
  CHECK_FALSE(data.in_band({-1, 99.9}));
  CHECK_FALSE(data.in_band({-1, 200.1}));
  // |lambda| is 206 and 103: where it counts is Im lambda.
  CHECK(data.in_band({-50, 200}));
  CHECK_FALSE(data.in_band({-50, 90}));
}

TEST_CASE("directions that only zeros connect are groups of their own") {
  dynamics::FrequencyResponse frf;
  frf.frequency_hz = Eigen::Vector3d(1, 2, 3);
  const auto add = [&](const char* response, const char* reference, double value) {
    dynamics::FrequencyResponseEntry entry;
    entry.response = response;
    entry.reference = reference;
    entry.h = Eigen::VectorXcd::Constant(3, value);
    frf.entries.push_back(entry);
  };
  add("z", "z", 1);
  add("x", "x", 1);
  add("x", "y", 0);
  add("y", "z", 2);
  add("z", "y", 0);
  CHECK(direction_names(frf) == std::vector<std::string>{"x", "y", "z"});
  const std::vector<DirectionGroup> groups = independent_groups(frf);
  REQUIRE(groups.size() == 2);
  // The zeros of zy lie within a group, those of xy between two.
  CHECK(groups[0].entries == std::vector<std::size_t>{0, 3, 4});
  CHECK(groups[1].entries == std::vector<std::size_t>{1});
}

TEST_CASE("curves are parts of one another where they share a vector's component") {
  FitData data;
  data.dofs = 2;
  for (const auto& [response, reference] : {std::pair(0, 1), std::pair(1, 0)})
    data.curves.push_back({response, reference, {}, {}});
  CHECK(data.vector_parts() == std::vector<std::size_t>{0, 1});
  data.curves.push_back({0, 0, {}, {}});
  CHECK(data.vector_parts() == std::vector<std::size_t>{0, 0, 0});
}
