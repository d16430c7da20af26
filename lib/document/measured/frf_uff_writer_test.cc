#include "document/measured/frf_uff_writer.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "document/measured/universal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::document;
using namespace stablecut::document::fixtures;
using Complex = std::complex<double>;

TEST_CASE("what is written reads back") {
  dynamics::FrequencyResponse frf;
  frf.quantity = dynamics::Quantity::kMobility;
  for (const char* response : {"x", "y"}) {
    for (const char* reference : {"x", "y"}) {
      dynamics::FrequencyResponseEntry entry;
      entry.response = response;
      entry.reference = reference;
      frf.entries.push_back(entry);
    }
  }
  const auto fill = [&](const Eigen::VectorXd& lines) {
    frf.frequency_hz = lines;
    double seed = 0.1;
    for (auto& entry : frf.entries) {
      entry.h.resize(lines.size());
      for (auto& value : entry.h) {
        const double a = seed = std::fmod(seed * 997.3 + 0.7, 1.0);
        const double b = seed = std::fmod(seed * 997.3 + 0.7, 1.0);
        value = Complex((a - 0.5) * std::pow(10, 20 * b - 15), (b - 0.5) * 1e-7);
      }
    }
  };
  for (const Eigen::VectorXd& lines : {Eigen::VectorXd(Eigen::VectorXd::LinSpaced(401, 2, 102)),
                                       Eigen::VectorXd(Eigen::VectorXd::LinSpaced(333, 1, 1000)),
                                       Eigen::VectorXd(Eigen::VectorXd::LinSpaced(57, 0, 7).array().exp()),
                                       Eigen::VectorXd(Eigen::VectorXd::Constant(1, 50))}) {
    fill(lines);
    // Binary: the same to the last bit.
    const std::string binary = frf_to_universal_file(frf, UniversalForm::kBinary);
    const dynamics::FrequencyResponse same = read(binary);
    CHECK(remarks_on(binary).empty());
    CHECK(same.quantity == frf.quantity);
    CHECK(same.frequency_hz == frf.frequency_hz);
    for (const auto& entry : frf.entries) CHECK(same.find(entry.response, entry.reference)->h == entry.h);
    CHECK(frf_to_universal_file(same, UniversalForm::kBinary) == binary);
    // Text: to the thirteen digits that the format has, and from then on the same text.
    const std::string text = frf_to_universal_file(frf, UniversalForm::kText);
    const dynamics::FrequencyResponse near = read(text);
    CHECK(
        ((near.frequency_hz - frf.frequency_hz).array().abs() <= 1.1e-9 * frf.frequency_hz.maxCoeff()).all());
    for (const auto& entry : frf.entries) {
      const auto& other = near.find(entry.response, entry.reference)->h;
      CHECK(((other - entry.h).array().real().abs() <= 5.1e-13 * entry.h.array().real().abs()).all());
      CHECK(((other - entry.h).array().imag().abs() <= 5.1e-13 * entry.h.array().imag().abs()).all());
    }
    CHECK(frf_to_universal_file(near, UniversalForm::kText) == text);
    for (std::size_t from = 0; from < text.size();) {
      const auto end = text.find('\n', from);
      CHECK(end - from <= 80);
      from = end + 1;
    }
  }
  frf.entries[0].response = "slope_x";
  CHECK_THROWS_WITH(frf_to_universal_file(frf, UniversalForm::kText), Catch::Contains("slope_x"));
}
