// Units at the edges (mm, deg, Hz, rpm, N/mm2) and inside (m, rad, rad/s, Hz, N/m2).
#pragma once

#include <numbers>

namespace stablecut {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2.0 * kPi;

inline constexpr double kStandardGravity = 9.80665;  // m/s2; of a kilogram-force, N

constexpr double metres_from_mm(double mm) { return mm * 1e-3; }
constexpr double mm_from_metres(double m) { return m * 1e3; }
constexpr double radians_from_degrees(double deg) { return deg * (kPi / 180.0); }
constexpr double degrees_from_radians(double rad) { return rad * (180.0 / kPi); }
constexpr double rad_per_s_from_hz(double hz) { return hz * kTwoPi; }
constexpr double hz_from_rad_per_s(double rad_per_s) { return rad_per_s / kTwoPi; }
constexpr double revolutions_per_s_from_rpm(double rpm) { return rpm / 60.0; }
constexpr double rpm_from_revolutions_per_s(double revolutions_per_s) { return revolutions_per_s * 60.0; }
constexpr double cm3_per_min_from_m3_per_s(double m3_per_s) { return m3_per_s * 60e6; }
constexpr double n_per_m2_from_n_per_mm2(double n_per_mm2) { return n_per_mm2 * 1e6; }
constexpr double n_per_mm2_from_n_per_m2(double n_per_m2) { return n_per_m2 * 1e-6; }
constexpr double n_per_m_from_n_per_mm(double value) { return value * 1e3; }

}  // namespace stablecut
