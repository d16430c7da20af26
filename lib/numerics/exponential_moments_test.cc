#include "numerics/exponential_moments.h"

#include <catch2/catch.hpp>

#include "numerics/legendre.h"

using namespace stablecut;
using namespace stablecut::numerics;
using Complex = std::complex<double>;

TEST_CASE("exponential moments equal their integral by a fine quadrature") {
  const GaussRule fine = gauss_legendre(120);
  const Eigen::Index count = 16;
  for (const Complex z : {Complex(0, 0), Complex(-1e-9, 1e-6), Complex(-0.01, 0.3), Complex(-0.02, 1.5),
                          Complex(-0.1, 3.14159265358979), Complex(-0.05, 9.42), Complex(-5, 12),
                          Complex(-1, 30), Complex(-8, 0.01), Complex(-20, 33)}) {
    for (const double x : {-0.97, -0.3, 0.5, 1.0}) {
      const Eigen::VectorXcd moments = ExponentialMoments(z, count).at(x);
      Eigen::VectorXcd expected = Eigen::VectorXcd::Zero(count);
      for (Eigen::Index i = 0; i < fine.node.size(); ++i) {
        const double s = -1 + (x + 1) * (fine.node[i] + 1) / 2;
        expected += fine.weight[i] * (x + 1) / 2 * std::exp(z * (x - s)) * legendre_values(s, count);
      }
      INFO("z = " << z << ", x = " << x);
      CHECK((moments - expected).norm() < 3e-13 * expected.norm());
    }
  }
}
