// What a hammer and its accelerometers recorded.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::taps {

/// Channels sampled together, in SI.
struct Record {
  double sample_rate_hz = 0;
  Eigen::VectorXd force;                   ///< [samples] N
  std::vector<Eigen::VectorXd> responses;  ///< [channels][samples] m, m/s or m/s2

  Eigen::Index samples() const { return force.size(); }
};

}  // namespace stablecut::taps
