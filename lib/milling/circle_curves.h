// Eigenvalues of a circle operator from place to place of the unit circle. README.md, "The search on the unit
// circle".
#pragma once

#include <cmath>
#include <complex>
#include <vector>

namespace stablecut::milling {

/// An eigenvalue at one place, and where it is known its derivative by the angle.
struct Branch {
  std::complex<double> value, slope;
  bool has_slope = false;
};

/// Where an eigenvalue is real and positive.
struct Crossing {
  double angle = 0;
  std::complex<double> value;
};

/// Where the imaginary part of an eigenvalue is least or greatest, and nearly 0.
struct Touch {
  double angle = 0;
  std::complex<double> value;
  double curvature = 0;  ///< second derivative of the imaginary part by the angle
};

/// What an eigenvalue does at the positive real axis between two places.
struct Passing {
  std::vector<Crossing> crossings;
  std::vector<Touch> touches;
};

/// An angle of the unit circle with all eigenvalues there.
struct Place {
  double angle = 0;
  std::vector<Branch> branches;
  /// The stretch to the next place has been looked at, and what is at the positive real axis in it.
  bool settled = false;
  Passing passing;
};

/// The modulus, without the care for overflow that std::abs takes.
inline double size_of(std::complex<double> z) { return std::sqrt(std::norm(z)); }

/// Whether an eigenvalue is so near the positive real axis beyond `least` that a derivative is worth its
/// price.
bool matters(std::complex<double> value, double least);

/// Whether an eigenvalue is so near the positive real axis that another operator of the same cut may have it
/// on the other side.
bool nearly_real(std::complex<double> value);
/// The same of two eigenvalues mean +- sqrt(square) of a real operator, which are real or conjugate.
bool nearly_one(double mean, double square);

/// Whether it is clear what crosses the positive real axis beyond `least` between two places, and what does
/// or touches it. Eigenvalues may be wrong by `margin` times their size.
bool clear_between(const Place& place, const Place& next, double least, double margin, Passing& passing);

/// Whether a curve between two places turns back so near the positive real axis, with a real part between
/// `least` and `most`, that an error of `margin` times its size might add or remove two crossings.
bool turns_near_axis(const Place& place, const Place& next, double least, double most, double margin);

}  // namespace stablecut::milling
