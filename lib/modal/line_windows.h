// Windows of neighbouring lines, by which the tap checks judge a curve: README.md, "Windows of lines".
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::modal {

/// The lines from `first` to `end` - 1.
struct LineSpan {
  Eigen::Index first = 0, end = 0;
};

/// Consecutive windows that together hold all lines (`hz`, increasing, above 0): each a sixth of an octave
/// wide, but five lines at least.
std::vector<LineSpan> octave_windows(const Eigen::VectorXd& hz);

/// What the lines of a window say of an entry, each by its median over the lines.
struct WindowSummary {
  double lo_hz = 0, hi_hz = 0;  ///< first and last line
  double size = 0;              ///< |H|
  double noise = 0;             ///< standard deviation of the noise over |H|
  double imaginary = 0;         ///< Im H / |H|
  double real = 0;              ///< Re H / |H|
  double lines = 0;             ///< how many
};
/// `hz`, the entry's values `h` and the variance of its noise, each [lines].
WindowSummary summary_of(const LineSpan& window, const Eigen::VectorXd& hz, const Eigen::VectorXcd& h,
                         const Eigen::VectorXd& variance);

}  // namespace stablecut::modal
