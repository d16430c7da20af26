#include "milling/cutter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"

namespace stablecut::milling {

double Cutter::mean_pitch_rad() const { return kTwoPi / teeth; }

double Cutter::largest_lag_rad_per_m() const {
  double largest = std::abs(lag_rad_per_m);
  for (const double lag : tooth_lag_rad_per_m) largest = std::max(largest, std::abs(lag));
  return largest;
}

double Cutter::edges_meet_at_m() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < tooth_lag_rad_per_m.size(); ++j) {
    const double nearer = tooth_lag_rad_per_m[j] - tooth_lag_rad_per_m[(j + 1) % tooth_lag_rad_per_m.size()];
    if (nearer > 0) least = std::min(least, pitch_rad[j] / nearer);
  }
  return least;
}

void Cutter::check_edges_apart(double depth_m) const {
  if (const double height = edges_meet_at_m(); depth_m >= height)
    throw NoAnswer("an edge comes up with the one before it " + number_text(mm_from_metres(height)) +
                   " mm above the tip: expected a smaller depth");
}

Cutter Cutter::at_height(double height_m) const {
  Cutter straight = *this;
  straight.tooth_lag_rad_per_m.clear();
  for (std::size_t j = 0; j < pitch_rad.size(); ++j)
    straight.pitch_rad[j] +=
        height_m * (tooth_lag_rad_per_m[(j + 1) % pitch_rad.size()] - tooth_lag_rad_per_m[j]);
  return straight;
}

double Cutter::tooth_period_s(double revolutions_per_s) const { return 1 / (teeth * revolutions_per_s); }

void set_immersion(Cutter& cutter, bool up_milling, double radial_immersion) {
  if (!(radial_immersion > 0 && radial_immersion <= 1)) {
    throw InvalidArgument("radial immersion: expected a ratio above 0 and at most 1");
  }
  cutter.entry_rad = up_milling ? 0 : std::acos(2 * radial_immersion - 1);
  cutter.exit_rad = up_milling ? std::acos(1 - 2 * radial_immersion) : kPi;
}

std::vector<double> wall_angles(const Cutter& cutter) {
  std::vector<double> walls;
  if (cutter.entry_rad < kAtWall) walls.push_back(0);
  if (cutter.exit_rad > kPi - kAtWall) walls.push_back(kPi);
  return walls;
}

EdgeMeans edge_means(const Cutter& cutter, double depth_m) {
  const auto at = [](double kappa) -> EdgeMeans {
    if (kappa == kPi / 2) return {};
    const double s = std::sin(kappa), c = std::cos(kappa);
    return {s, c, c / s, c * c / s, 1 / s};
  };
  const double radius = cutter.corner_radius_m;
  if (radius == 0) return at(cutter.lead_rad);
  // On the corner kappa grows from 0 at the tip, where the height is radius (1 - cos kappa).
  const double top = 2 * std::asin(std::sqrt(std::min(depth_m / (2 * radius), 1.0)));
  const double kappa = std::min(cutter.lead_rad, top);
  const double height = 2 * radius * std::sin(kappa / 2) * std::sin(kappa / 2);
  const double s = std::sin(kappa), c = std::cos(kappa);
  if (height == 0) return {0, 1, 0, 0, 0};  // no edge
  const EdgeMeans corner{radius * (kappa - s * c) / 2, radius * s * s / 2, radius * s,
                         radius * (kappa + s * c) / 2, radius * kappa};
  const double beyond = top <= cutter.lead_rad ? 0 : depth_m - height, depth = height + beyond;
  const EdgeMeans edge = at(cutter.lead_rad);
  return {(corner.sine + beyond * edge.sine) / depth, (corner.cosine + beyond * edge.cosine) / depth,
          (corner.cotangent + beyond * edge.cotangent) / depth,
          (corner.cosine_cotangent + beyond * edge.cosine_cotangent) / depth,
          (corner.inverse_sine + beyond * edge.inverse_sine) / depth};
}

}  // namespace stablecut::milling
