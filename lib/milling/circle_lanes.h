// A circle operator at eight places of the unit circle side by side. README.md, "Limits from the unit
// circle".
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <complex>
#include <vector>

#include "milling/circle_operator.h"
#include "numerics/complex_eigen_lanes.h"
#include "numerics/lane_array.h"

namespace stablecut::milling {

/// An eigenvalue of M(exp(i angle)) in each lane, and its derivative by the angle.
struct EigenvalueLanes {
  std::array<std::complex<double>, numerics::kLanes> value, slope;
};

class CircleLanes {
 public:
  static constexpr std::size_t kPlaces = numerics::kLanes;
  using Angles = std::array<double, kPlaces>;

  explicit CircleLanes(const CircleOperator& of);

  /// M at mu = exp(i angle), in Hessenberg form. The operator must outlive this object.
  void form(const Angles& angles);
  /// All eigenvalues at each place (after form), to `accuracy` of the operator's size.
  std::array<std::vector<std::complex<double>>, kPlaces> values(double accuracy) {
    return eigen_.values(accuracy);
  }
  /// One near `shifts` at each place (after form): the quotient y^H M x / y^H x of its vectors, whose error
  /// is the square of theirs.
  EigenvalueLanes refined(const std::array<std::complex<double>, kPlaces>& shifts);
  /// The same quotients of those vectors with another operator with equal modes, as many rows and one part.
  std::array<std::complex<double>, kPlaces> quotients(const CircleOperator& other);
  /// det(I - depth M) at each place (after form) times (-1 / depth)^size, over its modulus.
  std::array<std::complex<double>, kPlaces> determinant_phases(double depth_m) {
    return eigen_.determinant_phases(1 / depth_m);
  }
  /// Vectors of the last refined().
  Eigen::VectorXcd right(std::size_t place) const { return vector(right_, place); }
  Eigen::VectorXcd left(std::size_t place) const { return vector(left_, place); }

  /// Eight of some items, from `first` on; where there are fewer the last one again and again.
  template <typename T>
  static std::array<T, kPlaces> eight_from(const std::vector<T>& items, std::size_t first) {
    std::array<T, kPlaces> eight;
    for (std::size_t i = 0; i < kPlaces; ++i) eight[i] = items[std::min(first + i, items.size() - 1)];
    return eight;
  }

 private:
  Eigen::VectorXcd vector(const numerics::LaneArray& of, std::size_t place) const;

  const CircleOperator& of_;
  Eigen::Index size_, modes_, groups_;
  std::vector<Eigen::Index> group_of_;        // [modes] those with equal poles together
  std::vector<std::complex<double>> growth_;  // [groups]
  std::vector<std::vector<double>> terms_;    // [parts][size x size x (1 + 2 groups); or x 1 without states]
  numerics::LaneArray factors_;               // [groups x (a, b, a', b')] blocks of G and its derivative
  numerics::LaneArray scales_;  // [parts x 2] blocks: what multiplies a part, and its derivative
  numerics::LaneArray right_, left_, work_;
  numerics::ComplexEigenLanes eigen_;
};

}  // namespace stablecut::milling
