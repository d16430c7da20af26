#include "receptance/measured_holder.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "dynamics/synthesis.h"
#include "receptance/artefact.h"
#include "receptance/slopes.h"
#include "receptance/taps.h"

namespace stablecut::receptance {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kDirectPairs = 3;  // unknowns of a symmetric 2 x 2 block
constexpr std::size_t kCrossPairs = 4;   // unknowns of any 2 x 2 block

bool all_zero(const std::vector<const Tap*>& taps) {
  return std::all_of(taps.begin(), taps.end(), [](const Tap* tap) { return tap->h.isZero(0); });
}

// Passive: no load draws energy from the part, (H - H^*) / 2i has no positive eigenvalue. Deflections and
// slopes are measured in units in which the diagonal of H has modulus 1, and eigenvalues up to kPassiveShare
// allowed.
bool is_passive(const Receptance<2>& h) {
  const Eigen::Matrix2cd dissipation = (h - h.adjoint()) / Complex(0, 2);
  const Eigen::Vector2d unit = h.diagonal().cwiseAbs().cwiseMax(kAboveZero).cwiseSqrt().cwiseInverse();
  const Eigen::Matrix2cd scaled = unit.asDiagonal() * dissipation * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2cd> solver(scaled, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff() <= kPassiveShare;
}

bool any_cross_entry(const std::vector<Receptance<4>>& lines) {
  return std::any_of(lines.begin(), lines.end(), [](const Receptance<4>& h) {
    return !h.topRightCorner<2, 2>().isZero(0) || !h.bottomLeftCorner<2, 2>().isZero(0);
  });
}

// The intervals in which some tap within direction d is doubtful; those that meet or overlap become one.
std::vector<dynamics::DoubtfulInterval> all_doubtful(const Taps& taps, int d) {
  std::vector<dynamics::DoubtfulInterval> all, merged;
  for (const Tap& tap : taps) {
    if (tap.response / 2 == d && tap.reference / 2 == d)
      all.insert(all.end(), tap.doubtful.begin(), tap.doubtful.end());
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.from_hz < b.from_hz; });
  for (const auto& interval : all) {
    if (merged.empty() || merged.back().to_hz < interval.from_hz) {
      merged.push_back(interval);
    } else {
      merged.back().to_hz = std::max(merged.back().to_hz, interval.to_hz);
      merged.back().error = std::max(merged.back().error, interval.error);
    }
  }
  return merged;
}

// Throws InvalidArgument for a place beyond the artefact's end.
void check_places(const Taps& taps, const BeamChain& artefact) {
  const double length = length_of(artefact);
  for (const Tap& tap : taps) {
    const double farthest = std::max(tap.response_m, tap.reference_m);
    if (length > 0 && farthest > length * (1 + kPlaceRounding)) {
      throw InvalidArgument("position " + number_text(1e3 * farthest) +
                            " mm: expected a place on the artefact, up to " + number_text(1e3 * length) +
                            " mm");
    }
  }
}

class HolderBuilder {
 public:
  HolderBuilder(const HolderMeasurement& measurement, BeamTheory theory, const Eigen::VectorXd& frequency_hz)
      : measurement_(measurement),
        theory_(theory),
        frequency_hz_(frequency_hz),
        lines_(frequency_hz.size()),
        taps_(taps_of(measurement.frf, frequency_hz)) {
    if (measurement.sensor_mass_kg > 0) remove_sensor(taps_, measurement.sensor_mass_kg, frequency_hz);
    complete_by_reciprocity(taps_);
    check_places(taps_, measurement.artefact);
    holder_.receptance.assign(lines_, Receptance<4>::Zero());
    for (int d = 0; d < 2; ++d) {
      quality(d).measured = !taps(d, d).empty();
      quality(d).doubtful = all_doubtful(taps_, d);
    }
    if (!quality(0).measured && !quality(1).measured)
      throw InvalidArgument("no entry xx and none yy: expected one");
  }

  MeasuredHolder build() {
    if (!measurement_.artefact.empty() && enough_pairs_of_places()) {
      from_pairs_of_places();
    } else {
      from_slopes();
      if (!measurement_.artefact.empty()) take_artefact_off();
    }
    holder_.couples_directions = any_cross_entry(holder_.receptance);
    for (int d = 0; d < 2; ++d) {
      if (!quality(d).measured) continue;
      for (std::size_t i = 0; i < lines_; ++i) {
        if (!is_passive(holder_.receptance[i].block<2, 2>(2 * d, 2 * d)))
          quality(d).unphysical_hz.push_back(frequency_hz_[i]);
      }
    }
    return std::move(holder_);
  }

 private:
  HolderQuality& quality(int d) { return holder_.quality[d]; }

  // Taps of deflections in direction d by forces in direction e.
  std::vector<const Tap*> taps(int d, int e) const { return taps_of_coordinates(taps_, 2 * d, 2 * e); }

  Artefact artefact_at(std::size_t line) const {
    return Artefact(measurement_.artefact, theory_, rad_per_s_from_hz(frequency_hz_[line]));
  }

  // Whether each measured direction has as many different pairs of places as unknowns.
  bool enough_pairs_of_places() const {
    for (int d = 0; d < 2; ++d) {
      std::set<std::pair<double, double>> pairs;  // by reciprocity h(a, b) and h(b, a) are one
      for (const Tap* tap : taps(d, d)) pairs.insert(std::minmax(tap->response_m, tap->reference_m));
      if (!pairs.empty() && pairs.size() < kDirectPairs) return false;
    }
    return std::none_of(taps_.begin(), taps_.end(), [](const Tap& tap) { return tap.has_slope(); });
  }

  // Whether entries from direction e to direction d were measured that are not zero and of use: with only one
  // direction measured they are left out, which is noted.
  bool cross_wanted(int d, int e) {
    if (all_zero(taps(d, e))) return false;
    if (quality(0).measured && quality(1).measured) return true;
    holder_.cross_left_out = true;
    return false;
  }

  // ---- slopes at the face, or at the artefact's tip ----

  void from_slopes() {
    for (int d = 0; d < 2; ++d) {
      if (quality(d).measured) take_direct_block(d);
    }
    if (!cross_wanted(0, 1) && !cross_wanted(1, 0)) return;
    try {
      take_block(0, 1);
      take_block(1, 0);
    } catch (const InvalidArgument&) {
      holder_.cross_left_out = true;
      for (Receptance<4>& h : holder_.receptance) {
        h.topRightCorner<2, 2>().setZero();
        h.bottomLeftCorner<2, 2>().setZero();
      }
    }
  }

  DirectionBlock take_block(int d, int e) {
    DirectionBlock block = block_with_slopes(taps_, d, e);
    for (std::size_t i = 0; i < lines_; ++i) holder_.receptance[i].block<2, 2>(2 * d, 2 * e) = block.value[i];
    return block;
  }

  void take_direct_block(int d) {
    const DirectionBlock block = take_block(d, d);
    if (block.spacing_m > 0) quality(d).slopes = SlopeSource::kFiniteDifference;
    quality(d).spacing_m = block.spacing_m;
    quality(d).second_difference = block.second_difference;
    for (std::size_t i = 0; i < lines_; ++i) {
      const Eigen::Index at = i;
      if (std::abs(block.value[i](0, 1)) < kNoisyDeviations * std::sqrt(block.l_variance[at]))
        quality(d).noisy_hz.push_back(frequency_hz_[at]);
    }
  }

  // From the receptance at the artefact's tip to that of the face it stands on.
  void take_artefact_off() {
    for (std::size_t i = 0; i < lines_; ++i) {
      Receptance<4>& h = holder_.receptance[i];
      const BeamReceptances ends = artefact_at(i).ends();
      if (quality(0).measured && quality(1).measured) {
        h = holder_of_tip<4>(ends, h);
      } else {
        const int at = quality(0).measured ? 0 : 2;
        h.block<2, 2>(at, at) = holder_of_tip<2>(ends, h.block<2, 2>(at, at));
      }
    }
  }

  // ---- pairs of places along the artefact ----

  using TapBlocks = std::array<std::array<std::vector<const Tap*>, 2>, 2>;

  // The taps that are used for each of the four blocks; cross blocks both, or neither.
  TapBlocks chosen_taps() {
    TapBlocks chosen;
    for (int d = 0; d < 2; ++d) {
      for (int e = 0; e < 2; ++e) {
        if (d == e || cross_wanted(d, e)) chosen[d][e] = taps(d, e);
      }
    }
    if (chosen[0][1].size() < kCrossPairs || chosen[1][0].size() < kCrossPairs) {
      holder_.cross_left_out = holder_.cross_left_out || !chosen[0][1].empty() || !chosen[1][0].empty();
      chosen[0][1].clear();
      chosen[1][0].clear();
    }
    return chosen;
  }

  void from_pairs_of_places() {
    for (int d = 0; d < 2; ++d) quality(d).slopes = SlopeSource::kArtefact;
    const TapBlocks chosen = chosen_taps();
    for (std::size_t i = 0; i < lines_; ++i) {
      const Eigen::Index line = i;
      Artefact artefact = artefact_at(i);
      // A direction without taps: any value that can be inverted, since its block is not used.
      Receptance<4> stiffness = Receptance<4>::Identity();
      std::array<Eigen::MatrixXcd, 2> covariance;
      for (int d = 0; d < 2; ++d) {
        for (int e = 0; e < 2; ++e) {
          if (chosen[d][e].empty()) continue;
          const OpeningStiffness block = opening_stiffness(chosen[d][e], artefact, d == e, line);
          stiffness.block<2, 2>(2 * d, 2 * e) = block.value;
          if (d == e) covariance[d] = block.covariance;
        }
      }
      const Receptance<4> sum = stiffness.inverse();  // R22 + H
      const Receptance<2> r22 = artefact.ends().r22;
      for (int d = 0; d < 2; ++d) {
        if (quality(d).measured) take_difference(d, line, sum, r22, covariance[d]);
      }
    }
  }

  // H = (R22 + H) - R22 in the rows of direction d, and whether l is above its noise there.
  void take_difference(int d, Eigen::Index line, const Receptance<4>& sum, const Receptance<2>& r22,
                       const Eigen::MatrixXcd& covariance) {
    const Receptance<2> a = sum.block<2, 2>(2 * d, 2 * d);
    Receptance<4>& h = holder_.receptance[line];
    h.block<2, 4>(2 * d, 0) = sum.block<2, 4>(2 * d, 0);
    h.block<2, 2>(2 * d, 2 * d) = a - r22;
    if (!quality(1 - d).measured) h.block<2, 2>(2 * d, 2 - 2 * d).setZero();
    // Of A = Y^-1, dA = -A dY A: the derivatives of A12, but for the sign, by Y11, Y12 and Y22.
    const Eigen::RowVector3cd by(a(0, 0) * a(0, 1), a(0, 0) * a(1, 1) + a(0, 1) * a(0, 1), a(0, 1) * a(1, 1));
    const double deviation = std::sqrt((by * covariance * by.adjoint())(0, 0).real());
    if (std::abs(a(0, 1) - r22(0, 1)) < kNoisyDeviations * deviation)
      quality(d).noisy_hz.push_back(frequency_hz_[line]);
  }

  const HolderMeasurement& measurement_;
  BeamTheory theory_;
  const Eigen::VectorXd& frequency_hz_;
  std::size_t lines_;
  Taps taps_;
  MeasuredHolder holder_;
};

}  // namespace

MeasuredHolder measured_holder(const HolderMeasurement& measurement, BeamTheory theory,
                               const Eigen::VectorXd& frequency_hz) {
  return HolderBuilder(measurement, theory, frequency_hz).build();
}

MeasuredHolder modal_holder(const dynamics::ModalModel& model, const Eigen::VectorXd& frequency_hz) {
  std::array<Eigen::Index, 4> row{};
  for (std::size_t i = 0; i < 4; ++i) row[i] = model.dof(kCoordinates[i]);
  MeasuredHolder holder;
  for (std::size_t d = 0; d < 2; ++d) {
    const bool deflection = row[2 * d] >= 0, slope = row[2 * d + 1] >= 0;
    if (deflection != slope) {
      throw InvalidArgument(std::string("expected ") + kCoordinates[2 * d] + " and " +
                            kCoordinates[2 * d + 1] +
                            " together: a tool bends its holder by force and moment");
    }
    holder.quality[d].measured = deflection;
  }
  if (row[0] < 0 && row[2] < 0)
    throw InvalidArgument("expected x and slope_x, y and slope_y, or one of the pairs");
  for (const double hz : frequency_hz) {
    const Eigen::MatrixXcd h = dynamics::receptance_at(model, Complex(0, rad_per_s_from_hz(hz)));
    Receptance<4> at_joint = Receptance<4>::Zero();
    for (Eigen::Index i = 0; i < 4; ++i) {
      for (Eigen::Index j = 0; j < 4; ++j) {
        const auto from = row[i], to = row[j];
        if (from >= 0 && to >= 0) at_joint(i, j) = h(from, to);
      }
    }
    holder.receptance.push_back(at_joint);
  }
  holder.couples_directions = any_cross_entry(holder.receptance);
  return holder;
}

}  // namespace stablecut::receptance
