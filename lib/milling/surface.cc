#include "milling/surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/units.h"
#include "milling/cut_schedule.h"

namespace stablecut::milling {
namespace {

constexpr double kSamplesPerWave = 12;  // of the fastest mode, and of twice the spindle's turn
constexpr int kLeastSamples = 48, kMostSamples = 4096;
// The depth at which the surface's error becomes too large: steps up to it, and halvings of the one that it
// is in.
constexpr int kDepthSteps = 16, kHalvings = 10;

int samples_of(const TipStructure& structure, double revolutions_per_s, double period_rad) {
  const double fastest =
      structure.modes() > 0 ? structure.lambda.imag().maxCoeff() / (kTwoPi * revolutions_per_s) : 0;
  const double waves = std::max(fastest, 2.0) * period_rad / kTwoPi;
  return static_cast<int>(
      std::clamp(std::ceil(kSamplesPerWave * waves), double{kLeastSamples}, double{kMostSamples}));
}

// The largest of some values at equal distances over a period, by the parabola through the largest and its
// neighbours.
double summit(const Eigen::VectorXd& values) {
  Eigen::Index top = 0;
  values.maxCoeff(&top);
  const Eigen::Index n = values.size();
  const double before = values[(top + n - 1) % n], at = values[top], after = values[(top + 1) % n];
  const double bend = 2 * at - before - after;
  return bend > 0 ? at + (after - before) * (after - before) / (8 * bend) : at;
}

SurfacePoint scaled(SurfacePoint point, double depth_m) {
  if (point.location_error_m) *point.location_error_m *= depth_m;
  if (point.error_with_offset_m) *point.error_with_offset_m *= depth_m;
  point.peak_vibration_m *= depth_m;
  point.rms_vibration_m *= depth_m;
  point.mean_deflection_m *= depth_m;
  return point;
}

// Whether vibration leaves the chip as it is: every tooth leaves the same surface, and none rubs.
bool leaves_equal_chips(const Cutter& cutter, const CuttingLoad& load) {
  return cuts_alike(cutter, load) && cutter.damping_n_per_m == 0;
}

// Of the mean force per depth, in the cut's frame.
Eigen::Vector2d displacement_under(const Eigen::Matrix2d& compliance, const Cutter& cutter,
                                   const ForceCycle& force) {
  const Eigen::Matrix2d feed = Eigen::Rotation2Dd(cutter.feed_angle_rad).toRotationMatrix();
  return feed.transpose() * compliance * feed * force.mean().head<2>();
}

}  // namespace

Eigen::Matrix2d compliance_below_band(const dynamics::ModalModel& model) {
  double lowest = std::numeric_limits<double>::infinity();  // in the band
  for (const dynamics::Mode& mode : model.modes) {
    if (!mode.out_of_band) lowest = std::min(lowest, mode.frequency_hz);
  }
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  const std::array<Eigen::Index, 2> row = {model.dof("x"), model.dof("y")};
  for (const dynamics::Mode& mode : model.modes) {
    if (!mode.out_of_band || mode.frequency_hz >= lowest) continue;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        if (row[i] >= 0 && row[j] >= 0)
          sum(i, j) -= 2 * (mode.psi_r[row[i]] * mode.psi_l[row[j]] / mode.pole()).real();
      }
    }
  }
  return sum;
}

SurfaceAtSpeed::SurfaceAtSpeed(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                               double revolutions_per_s, int resolution,
                               const Eigen::Matrix2d& added_compliance)
    : structure_(structure),
      cutter_(cutter),
      load_(load),
      revolutions_per_s_(revolutions_per_s),
      resolution_(resolution),
      added_compliance_(added_compliance),
      samples_(samples_of(structure, revolutions_per_s, force_period_rad(cutter, load))) {}

// The force per depth is that of every depth but where the edge has a corner.
void SurfaceAtSpeed::set_depth(double depth_m) {
  if (forced_ && (cutter_.corner_radius_m == 0 || depth_m == depth_m_)) return;
  const ForceCycle force = force_cycle(cutter_, load_, depth_m);
  added_ = displacement_under(added_compliance_, cutter_, force);
  forced_.emplace(structure_, cutter_, force, revolutions_per_s_);
  depth_m_ = depth_m;
}

std::vector<SurfaceAtSpeed::Passage> SurfaceAtSpeed::passages(double depth_m) const {
  const int teeth = cuts_alike(cutter_, load_) ? 1 : cutter_.teeth;
  const double lag = cutter_.lag_rad_per_m * depth_m;
  const int steps =
      lag == 0 ? 0
               : 1 + static_cast<int>(std::ceil(samples_ * std::abs(lag) / force_period_rad(cutter_, load_)));
  std::vector<Passage> result;
  for (const double wall : wall_angles(cutter_)) {
    for (int i = 0; i <= steps; ++i) {
      // The edge at a height passes the wall after its tip.
      double turn = wall + (steps > 0 ? lag * i / steps : 0);
      for (int tooth = 0; tooth < teeth; ++tooth) {
        result.push_back({wall, turn, load_.runout_m.empty() ? 0 : load_.runout_m[tooth], i});
        turn += cutter_.pitch_after(tooth);
      }
    }
  }
  return result;
}

double SurfaceAtSpeed::points_per_rad(double depth_m) const {
  double longest = 0;
  for (const CutPiece& piece : cut_schedule(cutter_, revolutions_per_s_, depth_m).pieces)
    longest = std::max(longest, piece.to_rad - piece.from_rad);
  return resolution_ / longest;
}

// At equal distances over the period, and then at the passages.
Eigen::Matrix3Xd SurfaceAtSpeed::displacements(double depth_m, const std::vector<Passage>& passages) {
  const auto count = static_cast<Eigen::Index>(passages.size());
  if (leaves_equal_chips(cutter_, load_)) {
    Eigen::Matrix3Xd result(3, samples_ + count);
    result.leftCols(samples_) = forced_->displacements(depth_m, samples_);
    for (Eigen::Index i = 0; i < count; ++i)
      result.col(samples_ + i) = forced_->displacement(depth_m, passages[i].turn_rad);
    return result;
  }
  if (!regenerative_ || cutter_.changes_with_depth()) {
    std::vector<double> turns;
    for (int i = 0; i < samples_; ++i) turns.push_back(i * force_period_rad(cutter_, load_) / samples_);
    for (const Passage& passage : passages) turns.push_back(passage.turn_rad);
    regenerative_.emplace(structure_, cutter_, load_, *forced_, revolutions_per_s_, depth_m,
                          points_per_rad(depth_m), turns);
  }
  return regenerative_->displacements(depth_m);
}

SurfacePoint SurfaceAtSpeed::at(double depth_m) {
  const bool in_proportion = leaves_equal_chips(cutter_, load_) && !cutter_.changes_with_depth();
  if (in_proportion && per_depth_) return scaled(*per_depth_, depth_m);
  if (depth_m == 0) {
    const auto nothing = wall_angles(cutter_).empty() ? std::nullopt : std::optional(0.0);
    return {nothing, nothing};
  }

  set_depth(depth_m);
  const std::vector<Passage> touched = passages(depth_m);
  const Eigen::Matrix2Xd motion = displacements(depth_m, touched).topRows<2>().colwise() + depth_m * added_;
  SurfacePoint result;
  result.mean_deflection_m = motion.leftCols(samples_).rowwise().mean();
  if (leaves_equal_chips(cutter_, load_))
    result.mean_deflection_m = forced_->mean(depth_m).head<2>() + depth_m * added_;
  const Eigen::RowVectorXd squares =
      (motion.leftCols(samples_).colwise() - result.mean_deflection_m).colwise().squaredNorm();
  result.peak_vibration_m = std::sqrt(summit(squares));
  result.rms_vibration_m = std::sqrt(squares.mean());

  const double farthest = load_.runout_m.empty() ? 0 : std::ranges::max(load_.runout_m);
  for (std::size_t i = 0; i < touched.size();) {
    // What the deepest tooth leaves at a height: a tip that stands nearer to the wall cuts deeper.
    const Passage& first = touched[i];
    const double outwards = first.wall_rad == 0 ? 1 : -1;  // along the normal
    double left = std::numeric_limits<double>::infinity();
    for (; i < touched.size() && touched[i].height == first.height && touched[i].wall_rad == first.wall_rad;
         ++i) {
      const double normal = motion(1, samples_ + static_cast<Eigen::Index>(i));
      left = std::min(left, farthest - touched[i].runout_m - outwards * normal);
    }
    const auto keep_larger = [](std::optional<double>& largest, double value) {
      if (!largest || std::abs(value) > std::abs(*largest)) largest = value;
    };
    keep_larger(result.location_error_m, left);
    keep_larger(result.error_with_offset_m, left + outwards * result.mean_deflection_m.y());
  }
  if (in_proportion) per_depth_ = scaled(result, 1 / depth_m);
  return result;
}

double SurfaceAtSpeed::deepest_within(double largest_error_m, double depth_m) {
  const auto within = [&](double depth) {
    const auto error = at(depth).location_error_m;
    return !error || std::abs(*error) <= largest_error_m;
  };
  double deepest = 0;
  for (int step = 1; step <= kDepthSteps; ++step) {
    double beyond = depth_m * step / kDepthSteps;
    if (within(beyond)) {
      deepest = beyond;
      continue;
    }
    for (int half = 0; half < kHalvings; ++half) {
      const double middle = (deepest + beyond) / 2;
      (within(middle) ? deepest : beyond) = middle;
    }
    break;
  }
  return deepest;
}

SurfaceChart surface_chart(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                           const std::vector<double>& revolutions_per_s, const std::vector<double>& depths_m,
                           const StabilityChart& chart, const Eigen::Matrix2d& added_compliance, int threads,
                           const Progress& progress) {
  SurfaceChart result(depths_m.size(), {revolutions_per_s.size(), std::nullopt});
  parallel_for(
      revolutions_per_s.size(), threads,
      [&](std::size_t s) {
        SurfaceAtSpeed surface(structure, cutter, load, revolutions_per_s[s], chart.resolution[s],
                               added_compliance);
        for (std::size_t d = 0; d < depths_m.size(); ++d) {
          if (chart.spectral_radius(d, s) < 1) result[d][s] = surface.at(depths_m[d]);
        }
      },
      progress);
  return result;
}

}  // namespace stablecut::milling
