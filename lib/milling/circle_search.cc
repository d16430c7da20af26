#include "milling/circle_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/units.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Places between 0 and pi that are looked at first: so many at equal distances, and at so many widths of each
// mode's resonance beside it, if that is narrower than kWide (rad).
constexpr int kEven = 24;
constexpr double kBeside[] = {-3, -1, 0, 1, 3};
constexpr double kWide = 0.4;
// Depths this far above the largest are looked for too: a projected operator finds them a little off.
constexpr double kAbove = 1.02;
// Backward error of the eigenvalues, of the operator's size.
constexpr double kAccuracy = 1e-11;
// Rounds of bisection, places, and radians of a stretch, at which the search gives up.
constexpr int kMostRounds = 40;
constexpr std::size_t kMostPlaces = 6000;
constexpr double kLeastStretch = 1e-9;
// Imaginary part of a real eigenvalue, of the largest.
constexpr double kRealValue = 1e-9;
// With a variation over the depth: steps to the value at its own depth, the change that ends them, how far
// beyond the high depth the quadratic is taken, and the largest change of a value.
constexpr int kMostDepthSteps = 12;
constexpr double kSameDepth = 1e-6, kFarthestDepth = 1.2, kMostOfValue = 0.5;
// Radians of a stretch then: where eigenvalues meet, these values have jumps.
constexpr double kLeastStretchAlong = 1e-4;
// Radians that a determinant's phase may change from place to place, and its factors between scalings that
// keep it finite.
constexpr double kMostTurn = 2;
constexpr int kBetweenScalings = 16;

}  // namespace

CircleSearch::CircleSearch(const CircleOperator& of, double largest_depth_m, const DepthVariation* along)
    : lanes_(of), least_(1 / (kAbove * largest_depth_m)), along_(along) {
  std::vector<double> angles;
  for (int i = 0; i <= kEven; ++i) angles.push_back(kPi * i / kEven);
  for (const Complex& growth : of.growth) {
    const double width = -std::log(std::abs(growth));
    if (width > kWide) continue;
    for (const double beside : kBeside) {
      const double angle = std::abs(std::arg(growth)) + beside * width;
      if (angle > 0 && angle < kPi) angles.push_back(angle);
    }
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  add(angles);
}

void CircleSearch::settle() {
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<double> angles;
    for (auto place = places_.begin(); std::next(place) != places_.end(); ++place) {
      if (place->settled) continue;
      const Place& next = *std::next(place);
      place->passing = {};
      place->settled = clear_between(*place, next, least_, 0, place->passing);
      if (!place->settled) {
        const double least_stretch = along_ != nullptr ? kLeastStretchAlong : kLeastStretch;
        if (next.angle - place->angle < least_stretch || places_.size() + angles.size() >= kMostPlaces) {
          place->settled = true;  // the count tells whether something was lost
        } else {
          angles.push_back((place->angle + next.angle) / 2);
        }
      }
    }
    if (angles.empty()) return;
    add(angles);
  }
}

void CircleSearch::refine() {
  std::vector<double> angles;
  for (auto place = places_.begin(); std::next(place) != places_.end(); ++place)
    angles.push_back((place->angle + std::next(place)->angle) / 2);
  add(angles);
  settle();
}

std::vector<Start> CircleSearch::starts() const {
  std::vector<Start> all;
  for (const Place& place : places_) {
    for (const auto& [angle, value] : place.passing.crossings) all.push_back({angle, value, Seek::kAxis});
    for (const Touch& touch : place.passing.touches)
      all.push_back({touch.angle, touch.value, Seek::kTouch, touch.curvature});
  }
  for (const Place* place : {&places_.front(), &places_.back()}) {
    for (const Branch& branch : place->branches) {
      if (branch.value.real() >= least_ && branch.value.imag() == 0)
        all.push_back({place->angle, branch.value, Seek::kAtOne});
    }
  }
  return all;
}

std::vector<RealPair> CircleSearch::pairs() const {
  std::vector<RealPair> all;
  for (const Place* place : {&places_.front(), &places_.back()}) {
    std::vector<double> real;
    for (const Branch& branch : place->branches) {
      const Complex value = branch.value;
      if (value.real() < least_) continue;
      if (value.imag() == 0) real.push_back(value.real());
      const double square = -value.imag() * value.imag();
      if (value.imag() > 0 && nearly_one(value.real(), square))
        all.push_back({place->angle, value.real(), square});
    }
    std::sort(real.begin(), real.end());
    for (std::size_t i = 1; i < real.size(); ++i) {
      const double mean = (real[i - 1] + real[i]) / 2, half = (real[i] - real[i - 1]) / 2;
      if (!nearly_one(mean, half * half)) continue;
      all.push_back({place->angle, mean, half * half});
      ++i;  // none is in two pairs
    }
  }
  return all;
}

std::optional<Start> CircleSearch::nearest() const {
  std::optional<Start> best;
  for (const Place& place : places_) {
    for (const Branch& branch : place.branches) {
      if (branch.has_slope && (!best || branch.value.real() > best->value.real()))
        best = {place.angle, branch.value, Seek::kValue};
    }
  }
  return best;
}

bool CircleSearch::touches(double share) const {
  for (auto place = places_.begin(); std::next(place) != places_.end(); ++place) {
    Passing found;
    if (!clear_between(*place, *std::next(place), least_, share, found)) return true;
  }
  return false;
}

bool CircleSearch::turns_near_axis(double share, double least_depth_m) const {
  for (auto place = places_.begin(); std::next(place) != places_.end(); ++place) {
    if (milling::turns_near_axis(*place, *std::next(place), least_, 1 / least_depth_m, share)) return true;
  }
  return false;
}

std::optional<int> CircleSearch::count(double depth_m) const {
  double turn = 0;
  Complex before = 1;
  for (const Place& place : places_) {
    Complex phase = 1;
    int factors = 0;
    for (const Branch& branch : place.branches) {
      phase *= 1.0 - depth_m * branch.value;
      if (++factors % kBetweenScalings == 0) phase /= size_of(phase);
    }
    const double step = &place == &places_.front() ? 0 : std::arg(phase * std::conj(before));
    if (std::abs(step) > kMostTurn) return std::nullopt;
    turn += step;
    before = phase;
  }
  return -static_cast<int>(std::lround(turn / kPi));
}

std::vector<double> CircleSearch::angles() const {
  std::vector<double> result;
  for (const Place& place : places_) result.push_back(place.angle);
  return result;
}

std::vector<Complex> CircleSearch::values_near(const std::vector<Start>& at) {
  std::vector<Complex> result;
  for (std::size_t first = 0; first < at.size(); first += CircleLanes::kPlaces) {
    const std::size_t count = std::min(CircleLanes::kPlaces, at.size() - first);
    CircleLanes::Angles angles;
    for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = at[first + std::min(i, count - 1)].angle;
    for (const Place& place : computed(angles, count)) {
      const Complex near = at[result.size()].value;
      const auto nearest = std::min_element(place.branches.begin(), place.branches.end(),
                                            [&](const Branch& a, const Branch& b) {
                                              return size_of(a.value - near) < size_of(b.value - near);
                                            });
      result.push_back(nearest->value);
    }
  }
  return result;
}

// Places at the first `count` angles, with derivatives where they matter.
std::vector<Place> CircleSearch::computed(const CircleLanes::Angles& angles, std::size_t count) {
  lanes_.form(angles);
  const auto values = lanes_.values(kAccuracy);
  std::vector<Place> places(count);
  std::array<std::vector<std::size_t>, CircleLanes::kPlaces> wanted;
  std::size_t most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    places[i].angle = angles[i];
    double size = 0;
    for (const Complex& value : values[i]) size = std::max(size, size_of(value));
    const bool is_real = angles[i] == 0 || angles[i] == kPi;
    for (const Complex& value : values[i]) {
      Branch branch{value, 0.0, false};
      if (is_real && std::abs(value.imag()) < kRealValue * size) branch.value = value.real();
      if (matters(value, least_)) wanted[i].push_back(places[i].branches.size());
      places[i].branches.push_back(branch);
    }
    most = std::max(most, wanted[i].size());
  }
  for (std::size_t turn = 0; turn < most; ++turn) {
    // Lanes that have no more repeat some value of theirs.
    std::array<Complex, CircleLanes::kPlaces> shifts;
    for (std::size_t i = 0; i < shifts.size(); ++i) {
      const std::size_t own = std::min(i, count - 1);
      shifts[i] =
          turn < wanted[own].size() ? places[own].branches[wanted[own][turn]].value : values[own].front();
    }
    const EigenvalueLanes refined = lanes_.refined(shifts);
    for (std::size_t i = 0; i < count; ++i) {
      if (turn >= wanted[i].size()) continue;
      Branch& branch = places[i].branches[wanted[i][turn]];
      branch.slope = refined.slope[i];
      branch.has_slope = std::isfinite(std::norm(branch.slope));
    }
    if (along_ != nullptr) follow_depth(wanted, turn, places);
  }
  return places;
}

// The value 1 / a for which it is the eigenvalue at the depth a, with the vectors of the searched depth: from
// a quadratic through the quotients at three depths.
void CircleSearch::follow_depth(const std::array<std::vector<std::size_t>, CircleLanes::kPlaces>& wanted,
                                std::size_t turn, std::vector<Place>& places) {
  const auto low = lanes_.quotients(along_->low), high = lanes_.quotients(along_->high);
  const double below = along_->low_m - along_->searched_m, above = along_->high_m - along_->searched_m;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (turn >= wanted[i].size()) continue;
    Branch& branch = places[i].branches[wanted[i][turn]];
    const Complex to_low = (low[i] - branch.value) / below, to_high = (high[i] - branch.value) / above;
    const Complex curve = (to_high - to_low) / (above - below), slope = to_low - curve * below;
    const double farthest = kFarthestDepth * along_->high_m;
    const auto within = [&](Complex depth) {
      const double far = size_of(depth) / farthest;
      return far > 1 ? depth / far : depth;
    };
    // Newton's method for depth * value = 1.
    Complex depth = within(1.0 / branch.value), value, change;
    for (int step = 0; step < kMostDepthSteps; ++step) {
      const Complex offset = depth - along_->searched_m;
      value = branch.value + offset * (slope + curve * offset);
      change = (slope + 2.0 * curve * offset) * depth;
      const Complex before = depth;
      depth = within(depth - (depth * value - 1.0) / (value + change));
      if (size_of(depth - before) < kSameDepth * size_of(depth)) break;
    }
    change /= value;
    // Near places where eigenvalues meet nothing of the first order holds.
    if (!(size_of(value - branch.value) < kMostOfValue * size_of(branch.value))) continue;
    branch.slope *= value / branch.value / (1.0 + change);
    branch.value = branch.value.imag() == 0 ? value.real() : value;
  }
}

// Computes places at these angles (increasing) and puts them in their order.
void CircleSearch::add(const std::vector<double>& angles) {
  auto at = places_.begin();
  for (std::size_t first = 0; first < angles.size(); first += CircleLanes::kPlaces) {
    const std::size_t count = std::min(CircleLanes::kPlaces, angles.size() - first);
    for (Place& place : computed(CircleLanes::eight_from(angles, first), count)) {
      while (at != places_.end() && at->angle < place.angle) ++at;
      if (at != places_.end() && at->angle == place.angle) continue;
      if (at != places_.begin()) std::prev(at)->settled = false;
      at = std::next(places_.insert(at, std::move(place)));
    }
  }
}

}  // namespace stablecut::milling
