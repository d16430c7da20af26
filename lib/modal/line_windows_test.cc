#include "modal/line_windows.h"

#include <catch2/catch.hpp>
#include <complex>

using namespace stablecut;
using namespace stablecut::modal;

TEST_CASE("windows hold every line once, in order, and five lines at least") {
  const std::vector<Eigen::VectorXd> lines = {
      Eigen::VectorXd::LinSpaced(1000, 1, 1000), Eigen::VectorXd::LinSpaced(23, 500, 522),
      Eigen::VectorXd::LinSpaced(400, 0, 6).array().exp(), Eigen::VectorXd::LinSpaced(7, 10, 1000)};
  for (const Eigen::VectorXd& hz : lines) {
    const std::vector<LineSpan> windows = octave_windows(hz);
    REQUIRE(!windows.empty());
    CHECK(windows.front().first == 0);
    CHECK(windows.back().end == hz.size());
    for (std::size_t w = 0; w < windows.size(); ++w) {
      CHECK(windows[w].end - windows[w].first >= 5);
      if (w > 0) CHECK(windows[w].first == windows[w - 1].end);
    }
  }
}

TEST_CASE("where lines are close, a window is a sixth of an octave wide") {
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(20001, 100, 2100);
  const std::vector<LineSpan> windows = octave_windows(hz);
  for (std::size_t w = 0; w + 1 < windows.size(); ++w)
    CHECK(hz[windows[w].end] / hz[windows[w].first] == Approx(std::pow(2, 1.0 / 6)).epsilon(2e-3));
  CHECK(windows.size() == 27);  // log2(21) * 6 = 26.4
}

TEST_CASE("a window is summed up by medians, which one line cannot move") {
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(7, 10, 16);
  Eigen::VectorXcd h = Eigen::VectorXcd::Constant(7, {3e-6, -4e-6});
  Eigen::VectorXd variance = Eigen::VectorXd::Constant(7, 1e-14);
  h[2] = {1, 1};
  variance[4] = 1;
  const WindowSummary summary = summary_of({1, 6}, hz, h, variance);
  CHECK(summary.lo_hz == 11);
  CHECK(summary.hi_hz == 15);
  CHECK(summary.size == Approx(5e-6));
  CHECK(summary.noise == Approx(1e-7 / 5e-6));
  CHECK(summary.real == Approx(0.6));
  CHECK(summary.imaginary == Approx(-0.8));
}
