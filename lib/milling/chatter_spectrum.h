// The largest line in the spectrum of a motion, beside what repeats. README.md, "Simulation".
#pragma once

#include <Eigen/Core>

namespace stablecut::milling {

struct SpectralLine {
  double frequency_hz = 0;
  double amplitude = 0;
};

/// `motion` [2 x samples] at equal distances of time, a whole number of periods of `period` samples each: its
/// mean over the periods is taken off, and the largest line of what is left, by Hann's window and a parabola,
/// in both components together.
SpectralLine largest_line(const Eigen::Matrix2Xd& motion, int period, double samples_per_s);

}  // namespace stablecut::milling
