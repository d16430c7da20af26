#include "milling/circle_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Eigenvalues below this share of what limits at the largest depth, or farther than kSector (cosine) from the
// positive real axis, need no derivative.
constexpr double kSmall = 0.5, kSector = 0.5;
// Shares of the defects of the trapezoid rule and of Euler's that bound the curve between two places.
constexpr double kCubicShare = 1.0 / 2, kQuadraticShare = 1.0;
// Two branches go where they fit this much better than the other way round.
constexpr double kSurely = 10;
// Points of a curve between two places, and steps of bisection for a crossing of it.
constexpr int kBetween = 8, kBisections = 50;
// Share of `least` below which a curve cannot reach the axis beyond it.
constexpr double kOutOfReach = 0.9;
// Share of its size within which an eigenvalue touches the axis.
constexpr double kTouch = 3e-3;

// A branch over a stretch of angle, in s from 0 to 1.
struct Curve {
  Complex from, to, slope_from, slope_to;  // slopes times the stretch
  bool cubic = false;
  bool slope_at_end = false;  // of a quadratic, the slope that is known
  double error = 0;
  double margin = 0;  // of the size: how wrong the eigenvalues may be

  Complex at(double s) const {
    if (cubic) {
      const double a = s * s * (3 - 2 * s);
      return from * (1 - a) + to * a + s * (1 - s) * ((1 - s) * slope_from - s * slope_to);
    }
    if (slope_at_end) {
      const double t = 1 - s;
      return to + (from - to) * t * t - slope_to * t * (1 - t);
    }
    return from + (to - from) * s * s + slope_from * s * (1 - s);
  }
  // How much of the error there may be at s.
  double bump(double s) const { return 16 * s * s * (1 - s) * (1 - s); }
};

// Where the imaginary part of a curve is least or greatest: s, and its second derivative by s. There the
// curve may touch the axis, or cross it twice however narrowly.
struct Extremum {
  double s = 0, curvature = 0;
};
struct Extrema {
  std::array<Extremum, 2> at;
  std::size_t count = 0;
};

Extrema extrema_of(const Curve& c) {
  // Im z = (...) + b s + c2 s^2 + c3 s^3.
  const double step = c.to.imag() - c.from.imag();
  double b = c.slope_from.imag(), c2 = step - b, c3 = 0;
  if (c.cubic) {
    c2 = 3 * step - 2 * c.slope_from.imag() - c.slope_to.imag();
    c3 = c.slope_from.imag() + c.slope_to.imag() - 2 * step;
  } else if (c.slope_at_end) {
    b = 2 * step - c.slope_to.imag();
    c2 = c.slope_to.imag() - step;
  }
  Extrema extrema;
  const auto add = [&](double s) {
    if (s > 0 && s < 1) extrema.at[extrema.count++] = {s, 2 * c2 + 6 * c3 * s};
  };
  // Roots of b + 2 c2 s + 3 c3 s^2, without cancellation; a c3 of 0 leaves the second.
  const double discriminant = c2 * c2 - 3 * c3 * b;
  if (!(discriminant >= 0)) return extrema;
  const double sum = -(c2 + std::copysign(std::sqrt(discriminant), c2));
  if (c3 != 0) add(sum / (3 * c3));
  if (sum != 0) add(b / sum);
  return extrema;
}

Curve curve_between(const Place& a, std::size_t i, const Place& b, std::size_t j) {
  const double stretch = b.angle - a.angle;
  const Branch &x = a.branches[i], &y = b.branches[j];
  Curve c;
  c.from = x.value;
  c.to = y.value;
  c.slope_from = stretch * x.slope;
  c.slope_to = stretch * y.slope;
  c.cubic = x.has_slope && y.has_slope;
  c.slope_at_end = !x.has_slope;
  const Complex step = y.value - x.value;
  if (c.cubic)
    c.error = kCubicShare * size_of(step - (c.slope_from + c.slope_to) / 2.0);
  else
    c.error = kQuadraticShare * size_of(step - (x.has_slope ? c.slope_from : c.slope_to));
  return c;
}

// Branches from one place to the next: indices at both.
struct Pairing {
  double error;
  std::size_t from, to;
};

// Those that fit best first, until every branch with a slope has one. A branch without a slope at either end
// is in none.
std::vector<Pairing> pairings(const Place& a, const Place& b) {
  const auto with_slope = [](const Place& place) {
    return std::count_if(place.branches.begin(), place.branches.end(),
                         [](const Branch& branch) { return branch.has_slope; });
  };
  auto left = with_slope(a) + with_slope(b);
  std::vector<Pairing> all, chosen;
  all.reserve(a.branches.size() * b.branches.size());
  for (std::size_t i = 0; i < a.branches.size(); ++i) {
    for (std::size_t j = 0; j < b.branches.size(); ++j) {
      if (a.branches[i].has_slope || b.branches[j].has_slope)
        all.push_back({curve_between(a, i, b, j).error, i, j});
    }
  }
  // Few are taken of many.
  const auto worse = [](const Pairing& x, const Pairing& y) { return x.error > y.error; };
  std::make_heap(all.begin(), all.end(), worse);
  std::vector<bool> used_a(a.branches.size(), false), used_b(b.branches.size(), false);
  for (auto end = all.end(); left > 0 && end != all.begin();) {
    std::pop_heap(all.begin(), end, worse);
    const Pairing& pair = *--end;
    if (used_a[pair.from] || used_b[pair.to]) continue;
    used_a[pair.from] = used_b[pair.to] = true;
    left -= a.branches[pair.from].has_slope + b.branches[pair.to].has_slope;
    chosen.push_back(pair);
  }
  return chosen;
}

// On which side of the positive real axis beyond `least` a point of a curve is.
enum class Side { kAbove, kBelow, kFar, kUncertain };

Side side_of(const Curve& c, double s, double least) {
  const Complex z = c.at(s);
  const double error = c.error * c.bump(s) + (c.margin > 0 ? c.margin * size_of(z) : 0);
  if (z.real() + error < kOutOfReach * least) return Side::kFar;
  if (std::abs(z.imag()) <= error) return Side::kUncertain;
  return z.imag() > 0 ? Side::kAbove : Side::kBelow;
}

// Where the imaginary part changes its sign between two places (s).
double zero_between(const Curve& c, double low, double high) {
  const bool above = c.at(low).imag() > 0;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = (low + high) / 2;
    ((c.at(middle).imag() > 0) == above ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Where the curve is looked at (s): at equal distances, and at its extrema.
struct Looks {
  std::array<double, kBetween + 3> s;
  std::size_t count = 0;
};

Looks places_to_look(const Extrema& extrema) {
  Looks looks;
  for (int i = 0; i <= kBetween; ++i) looks.s[looks.count++] = static_cast<double>(i) / kBetween;
  if (extrema.count == 0) return looks;
  for (std::size_t i = 0; i < extrema.count; ++i) looks.s[looks.count++] = extrema.at[i].s;
  std::sort(looks.s.begin(), looks.s.begin() + looks.count);
  return looks;
}

// Whether it is clear where the curve crosses the positive real axis beyond `least`, and the places (s).
bool clear_crossings(const Curve& c, const Extrema& extrema, double least, std::vector<Crossing>& found) {
  const Looks looks = places_to_look(extrema);
  Side last = Side::kUncertain;
  double last_s = 0;
  int uncertain = 0;  // points since the last one whose side is certain
  for (std::size_t i = 0; i < looks.count; ++i) {
    const double s = looks.s[i];
    const Side side = side_of(c, s, least);
    if (side == Side::kUncertain) {
      // Ends lie exactly where they are; on the axis only where the multiplier is real.
      if (i > 0 && i + 1 < looks.count) ++uncertain;
      continue;
    }
    const bool crosses =
        (last == Side::kAbove && side == Side::kBelow) || (last == Side::kBelow && side == Side::kAbove);
    if (crosses) {
      const double zero = zero_between(c, last_s, s);
      found.push_back({zero, c.at(zero)});
      if (uncertain > kBetween / 2) return false;
    } else if (uncertain > 0) {
      return false;  // it may touch the axis
    }
    last = side;
    last_s = s;
    uncertain = 0;
  }
  return uncertain == 0;
}

// Whether the imaginary part turns where it is less than the margin, between `least` and `most`.
bool turns(const Curve& c, double least, double most) {
  bool rising = c.slope_from.imag() > 0, near_before = false;
  Complex before = c.from;
  for (int i = 0; i <= kBetween; ++i) {
    const Complex z = c.at(static_cast<double>(i) / kBetween);
    const bool near =
        z.real() > kOutOfReach * least && z.real() < most && std::abs(z.imag()) < c.margin * size_of(z);
    const bool rises = i == 0 ? rising : (z - before).imag() > 0;
    const bool known = i > 0 && (i > 1 || c.cubic || !c.slope_at_end);
    if (known && rises != rising && (near || near_before)) return true;
    rising = rises;
    before = z;
    near_before = near;
  }
  return c.cubic && near_before && (c.slope_to.imag() > 0) != rising;
}

}  // namespace

bool matters(Complex value, double least) {
  const double size = size_of(value);
  return size >= kSmall * least && value.real() >= kSector * size;
}

bool nearly_real(Complex value) { return std::abs(value.imag()) < kTouch * value.real(); }

bool nearly_one(double mean, double square) { return std::abs(square) < kTouch * mean * mean; }

bool clear_between(const Place& place, const Place& next, double least, double margin, Passing& passing) {
  const std::vector<Pairing> pairs = pairings(place, next);
  std::vector<std::vector<Crossing>> found(pairs.size());
  const double stretch = next.angle - place.angle;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    Curve curve = curve_between(place, pairs[k].from, next, pairs[k].to);
    curve.margin = margin;
    const Extrema extrema = extrema_of(curve);
    if (!clear_crossings(curve, extrema, least, found[k])) return false;
    for (const auto& [s, value] : found[k]) passing.crossings.push_back({place.angle + s * stretch, value});
    for (std::size_t i = 0; i < extrema.count; ++i) {
      const auto& [s, curvature] = extrema.at[i];
      const Complex value = curve.at(s);
      if (value.real() >= kOutOfReach * least && nearly_real(value))
        passing.touches.push_back({place.angle + s * stretch, value, curvature / (stretch * stretch)});
    }
  }
  // Where two branches might as well go to each other's ends, and would cross the axis otherwise.
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l) {
      const Curve one = curve_between(place, pairs[k].from, next, pairs[l].to),
                  other = curve_between(place, pairs[l].from, next, pairs[k].to);
      if (one.error + other.error > kSurely * (pairs[k].error + pairs[l].error)) continue;
      std::vector<Crossing> swapped;
      const bool clear = clear_crossings(one, extrema_of(one), least, swapped) &&
                         clear_crossings(other, extrema_of(other), least, swapped);
      if (!clear || swapped.size() != found[k].size() + found[l].size()) return false;
    }
  }
  return true;
}

bool turns_near_axis(const Place& place, const Place& next, double least, double most, double margin) {
  for (const Pairing& pair : pairings(place, next)) {
    Curve curve = curve_between(place, pair.from, next, pair.to);
    curve.margin = margin;
    if (turns(curve, least, most)) return true;
  }
  return false;
}

}  // namespace stablecut::milling
