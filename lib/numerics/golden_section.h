// Golden section: the best of a function with one hump, by values alone.
#pragma once

namespace stablecut::numerics {

/// The share of a stretch that its inner point leaves on the shorter side, so that the points of one step
/// serve the next [Kiefer1953].
inline constexpr double kGoldenShare = 0.3819660112501051;

/// Narrows from ... to around the best point known, `steps` times or until `enough(best)`: a new point in the
/// longer side, and the stretch around the better of the two. `place(point)` says where a point is,
/// `point_at(x)` makes one, `better(a, b)` compares. Of a function with one hump in the stretch each step
/// leaves 0.62 of its length.
template <typename Point, typename Place, typename PointAt, typename Better, typename Enough>
Point golden_section(double from, double to, Point best, int steps, const Place& place,
                     const PointAt& point_at, const Better& better, const Enough& enough) {
  for (int step = 0; step < steps && !enough(best); ++step) {
    const double middle = place(best);
    const bool right = to - middle > middle - from;
    const double x = right ? middle + kGoldenShare * (to - middle) : middle - kGoldenShare * (middle - from);
    const Point trial = point_at(x);
    if (better(trial, best)) {
      (right ? from : to) = middle;
      best = trial;
    } else {
      (right ? to : from) = x;
    }
  }
  return best;
}

}  // namespace stablecut::numerics
