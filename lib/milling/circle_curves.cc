#include "milling/circle_curves.h"

#include <algorithm>
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

// A branch over a stretch of angle, in s from 0 to 1.
struct Curve {
  Complex from, to, slope_from, slope_to;  // slopes times the stretch
  bool cubic;
  bool slope_at_end;  // of a quadratic, the slope that is known
  double error;
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

Curve curve_between(const Place& a, std::size_t i, const Place& b, std::size_t j) {
  const double stretch = b.angle - a.angle;
  const Branch &x = a.branches[i], &y = b.branches[j];
  Curve c{x.value, y.value, stretch * x.slope, stretch * y.slope, x.has_slope && y.has_slope, !x.has_slope,
          0,       0};
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

// Those that fit best first. A branch without a slope at either end is in none.
std::vector<Pairing> pairings(const Place& a, const Place& b) {
  std::vector<Pairing> all, chosen;
  for (std::size_t i = 0; i < a.branches.size(); ++i) {
    for (std::size_t j = 0; j < b.branches.size(); ++j) {
      if (a.branches[i].has_slope || b.branches[j].has_slope)
        all.push_back({curve_between(a, i, b, j).error, i, j});
    }
  }
  std::sort(all.begin(), all.end(), [](const Pairing& x, const Pairing& y) { return x.error < y.error; });
  std::vector<bool> used_a(a.branches.size(), false), used_b(b.branches.size(), false);
  for (const Pairing& pair : all) {
    if (used_a[pair.from] || used_b[pair.to]) continue;
    used_a[pair.from] = used_b[pair.to] = true;
    chosen.push_back(pair);
  }
  return chosen;
}

// Whether it is clear where the curve crosses the positive real axis beyond `least`, and the places (s).
bool clear_crossings(const Curve& c, double least, std::vector<Crossing>& found) {
  // The sign of the imaginary part where it is certain; 0 where it is not, and 2 where the axis is out of
  // reach.
  int last = 0;
  double last_s = 0;
  bool uncertain_between = false;
  int uncertain_run = 0;
  for (int i = 0; i <= kBetween; ++i) {
    const double s = static_cast<double>(i) / kBetween;
    const Complex z = c.at(s);
    const double error = c.error * c.bump(s) + (c.margin > 0 ? c.margin * size_of(z) : 0);
    const double beyond = z.real() + error;
    int sign = 0;
    if (beyond < kOutOfReach * least) {
      // The nearest point of the ray is its end.
      sign = 2;
    } else if (std::abs(z.imag()) > error) {
      sign = z.imag() > 0 ? 1 : -1;
    }
    if (sign == 0) {
      // Ends lie exactly where they are; on the axis only where the multiplier is real.
      if (i == 0 || i == kBetween) continue;
      uncertain_between = true;
      ++uncertain_run;
      continue;
    }
    if (sign == 2) {
      last = 2;
      last_s = s;
      uncertain_between = false;
      uncertain_run = 0;
      continue;
    }
    if (last == 1 || last == -1) {
      if (sign != last) {
        // A sure crossing; by bisection of the curve.
        double low = last_s, high = s;
        for (int k = 0; k < kBisections; ++k) {
          const double middle = (low + high) / 2;
          ((c.at(middle).imag() > 0 ? 1 : -1) == last ? low : high) = middle;
        }
        found.push_back({(low + high) / 2, c.at((low + high) / 2)});
        if (uncertain_run > kBetween / 2) return false;
      } else if (uncertain_between) {
        return false;  // may touch the axis
      }
    } else if (last == 0 && uncertain_between) {
      return false;
    } else if (last == 2 && uncertain_between) {
      return false;
    }
    last = sign;
    last_s = s;
    uncertain_between = false;
    uncertain_run = 0;
  }
  return !uncertain_between;
}

}  // namespace

bool matters(Complex value, double least) {
  const double size = size_of(value);
  return size >= kSmall * least && value.real() >= kSector * size;
}

// Whether it is clear what crosses the axis between two places, and what does.
bool clear_between(const Place& place, const Place& next, double least, double margin,
                   std::vector<Crossing>& crossings) {
  const std::vector<Pairing> pairs = pairings(place, next);
  std::vector<std::vector<Crossing>> found(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    Curve curve = curve_between(place, pairs[k].from, next, pairs[k].to);
    curve.margin = margin;
    if (!clear_crossings(curve, least, found[k])) return false;
    for (const auto& [s, value] : found[k])
      crossings.push_back({place.angle + s * (next.angle - place.angle), value});
  }
  // Where two branches might as well go to each other's ends, and would cross the axis otherwise.
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l) {
      const Curve one = curve_between(place, pairs[k].from, next, pairs[l].to),
                  other = curve_between(place, pairs[l].from, next, pairs[k].to);
      if (one.error + other.error > kSurely * (pairs[k].error + pairs[l].error)) continue;
      std::vector<Crossing> swapped;
      const bool clear = clear_crossings(one, least, swapped) && clear_crossings(other, least, swapped);
      if (!clear || swapped.size() != found[k].size() + found[l].size()) return false;
    }
  }
  return true;
}

}  // namespace stablecut::milling
