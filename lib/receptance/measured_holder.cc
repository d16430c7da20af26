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
#include "receptance/taps.h"

namespace stablecut::receptance {
namespace {

using Complex = std::complex<double>;

constexpr double kDeviations = 3;       // of the noise, below which a value is noise
constexpr double kPassiveShare = 0.05;  // of the receptance, which may be given away before it is said
constexpr std::size_t kDirectPairs = 3, kCrossPairs = 4;  // unknowns of a symmetric and of any 2x2 matrix

std::string direction_name(int direction) { return kCoordinates[2 * direction]; }

// One of the four blocks, response direction d, reference direction e, line by line, with the variance of its
// upper right entry l.
struct Block {
  std::vector<Receptance<2>> value;
  Eigen::VectorXd l_variance;
};

// What was measured with slopes; a missing one of l and n is taken by reciprocity on the diagonal.
bool block_of_slopes(const Taps& taps, int d, int e, Block& block) {
  std::array<const Tap*, 4> entry{};
  for (int i = 0; i < 4; ++i) entry[i] = find(taps, 2 * d + i / 2, 2 * e + i % 2, 0, 0);
  if (d == e && entry[1] == nullptr) entry[1] = entry[2];
  if (d == e && entry[2] == nullptr) entry[2] = entry[1];
  if (entry[1] == nullptr || entry[2] == nullptr) return false;
  if (entry[0] == nullptr || entry[3] == nullptr) {
    throw InvalidArgument(direction_name(d) + direction_name(e) +
                          ": entries with slopes: expected deflection and slope by force and moment");
  }
  for (std::size_t i = 0; i < block.value.size(); ++i) {
    const Eigen::Index at = i;
    block.value[i] << entry[0]->h[at], entry[1]->h[at], entry[2]->h[at], entry[3]->h[at];
  }
  block.l_variance = entry[1]->variance;
  return true;
}

// The one other place, besides 0, that a pair of directions was tapped at.
double spacing_of(const Taps& taps, int d, int e) {
  double spacing = 0;
  for (const Tap& tap : taps) {
    if (!tap.between(2 * d, 2 * e)) continue;
    for (const double place : {tap.response_m, tap.reference_m}) {
      if (place < -kSamePlace)
        throw InvalidArgument(direction_name(d) + ": a position below 0: expected a distance from the tip");
      if (place < kSamePlace) continue;
      if (spacing > 0 && std::abs(place - spacing) > kSamePlace)
        throw InvalidArgument(direction_name(d) + direction_name(e) +
                              ": more than two places: expected 0 and one other for a finite difference");
      spacing = place;
    }
  }
  return spacing;
}

// Finite difference of the places 0 and S: slopes towards the tip.
bool block_of_differences(const Taps& taps, int d, int e, Block& block, HolderQuality& quality) {
  const double spacing = spacing_of(taps, d, e);
  const auto curve = [&](double a, double b) { return find(taps, 2 * d, 2 * e, a, b); };
  const Tap *direct = curve(0, 0), *of_moment = curve(0, spacing), *of_slope = curve(spacing, 0);
  if (spacing == 0 || direct == nullptr || (of_moment == nullptr && of_slope == nullptr)) return false;
  if (of_moment == nullptr) of_moment = of_slope;
  if (of_slope == nullptr) of_slope = of_moment;
  const Tap* far = curve(spacing, spacing);
  quality.spacing_m = spacing;
  quality.second_difference = far != nullptr;
  block.l_variance = (direct->variance + of_moment->variance) / (spacing * spacing);
  for (std::size_t i = 0; i < block.value.size(); ++i) {
    const Eigen::Index at = i;
    const Complex h = direct->h[at], l = (h - of_moment->h[at]) / spacing,
                  n = (h - of_slope->h[at]) / spacing;
    Complex p = h == 0.0 ? 0.0 : l * n / h;
    if (far != nullptr) p = (h - of_moment->h[at] - of_slope->h[at] + far->h[at]) / (spacing * spacing);
    block.value[i] << h, l, n, p;
  }
  return true;
}

bool all_zero(const std::vector<const Tap*>& taps) {
  return std::all_of(taps.begin(), taps.end(), [](const Tap* tap) { return tap->h.isZero(0); });
}

// A receptance takes energy in at every motion: (H - H^*) / 2i is not positive in any direction.
bool is_passive(const Receptance<2>& h) {
  const Eigen::Matrix2cd dissipation = (h - h.adjoint()) / Complex(0, 2);
  // Deflections and slopes in units in which the receptance's diagonal is 1.
  const Eigen::Vector2d unit = h.diagonal().cwiseAbs().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::Matrix2cd scaled = unit.asDiagonal() * dissipation * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2cd> solver(scaled, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff() <= kPassiveShare;
}

// Whether a load in one direction moves the other.
bool couple(const std::vector<Receptance<4>>& lines) {
  return std::any_of(lines.begin(), lines.end(), [](const Receptance<4>& h) {
    return !h.topRightCorner<2, 2>().isZero(0) || !h.bottomLeftCorner<2, 2>().isZero(0);
  });
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
    double length = 0;
    for (const BeamSegment& segment : measurement.artefact) length += segment.length_m;
    for (const Tap& tap : taps_) {
      const double farthest = std::max(tap.response_m, tap.reference_m);
      if (length > 0 && farthest > length * (1 + 1e-12)) {
        throw InvalidArgument("position " + number_text(1e3 * farthest) +
                              " mm: expected a place on the artefact, up to " + number_text(1e3 * length) +
                              " mm");
      }
    }
    holder_.receptance.assign(lines_, Receptance<4>::Zero());
    for (int d = 0; d < 2; ++d) quality(d).measured = !taps_between(taps_, 2 * d, 2 * d).empty();
    if (!quality(0).measured && !quality(1).measured)
      throw InvalidArgument("no entry xx and none yy: expected one");
  }

  MeasuredHolder build() {
    if (!measurement_.artefact.empty() && along_artefact()) {
      from_pairs_of_places();
    } else {
      from_tip();
    }
    holder_.couples_directions = couple(holder_.receptance);
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

  bool along_artefact() const {
    for (int d = 0; d < 2; ++d) {
      std::set<std::pair<double, double>> pairs;  // h(a, b) and h(b, a) say the same
      for (const Tap* tap : taps_between(taps_, 2 * d, 2 * d))
        pairs.insert(std::minmax(tap->response_m, tap->reference_m));
      if (!pairs.empty() && pairs.size() < kDirectPairs) return false;
    }
    return std::none_of(taps_.begin(), taps_.end(), [](const Tap& tap) { return tap.slope(); });
  }

  // Whether there are entries between the two directions that can be of use; says so when not.
  bool cross_wanted(int d, int e) {
    if (all_zero(taps_between(taps_, 2 * d, 2 * e))) return false;
    if (quality(0).measured && quality(1).measured) return true;
    holder_.cross_left_out = true;
    return false;
  }

  // Slopes as measured or by differences, at the face or at the artefact's tip.
  void from_tip() {
    for (int d = 0; d < 2; ++d) {
      if (quality(d).measured) quality(d) = take_block(d, d);
    }
    if (cross_wanted(0, 1) || cross_wanted(1, 0)) {
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
    if (measurement_.artefact.empty()) return;
    for (std::size_t i = 0; i < lines_; ++i) {
      Artefact artefact = artefact_at(i);
      Receptance<4>& h = holder_.receptance[i];
      const BeamReceptances ends = artefact.ends();
      if (quality(0).measured && quality(1).measured) {
        h = holder_of_tip<4>(ends, h);
      } else {
        const int at = quality(0).measured ? 0 : 2;
        h.block<2, 2>(at, at) = holder_of_tip<2>(ends, h.block<2, 2>(at, at));
      }
    }
  }

  HolderQuality take_block(int d, int e) {
    Block block{std::vector<Receptance<2>>(lines_), {}};
    HolderQuality found;
    if (!block_of_slopes(taps_, d, e, block)) {
      if (!block_of_differences(taps_, d, e, block, found)) {
        throw InvalidArgument(direction_name(d) + direction_name(e) +
                              ": no slopes and no second place: expected entries with slope_" +
                              direction_name(d) + ", or taps at the positions 0 and one other");
      }
      found.slopes = SlopeSource::kFiniteDifference;
    }
    for (std::size_t i = 0; i < lines_; ++i) {
      holder_.receptance[i].block<2, 2>(2 * d, 2 * e) = block.value[i];
      const Eigen::Index at = i;
      if (std::abs(block.value[i](0, 1)) < kDeviations * std::sqrt(block.l_variance[at]))
        found.noisy_hz.push_back(frequency_hz_[at]);
    }
    found.measured = true;
    return found;
  }

  void from_pairs_of_places() {
    std::array<std::array<std::vector<const Tap*>, 2>, 2> taps;
    for (int d = 0; d < 2; ++d) {
      quality(d).slopes = SlopeSource::kArtefact;
      for (int e = 0; e < 2; ++e) {
        auto& pairs = taps[d][e];
        if (d == e || cross_wanted(d, e)) pairs = taps_between(taps_, 2 * d, 2 * e);
      }
    }
    // Cross entries in both senses, or not at all.
    if (taps[0][1].size() < kCrossPairs || taps[1][0].size() < kCrossPairs) {
      holder_.cross_left_out = holder_.cross_left_out || !taps[0][1].empty() || !taps[1][0].empty();
      taps[0][1].clear();
      taps[1][0].clear();
    }
    for (std::size_t i = 0; i < lines_; ++i) {
      const Eigen::Index line = i;
      Artefact artefact = artefact_at(i);
      // A direction without taps is held by nothing here, and left zero.
      Receptance<4> inverse = Receptance<4>::Identity();
      std::array<Inverse, 2> direct;
      for (int d = 0; d < 2; ++d) {
        for (int e = 0; e < 2; ++e) {
          const auto& pairs = taps[d][e];
          if (pairs.empty()) continue;
          const Inverse found = inverse_of(pairs, artefact, d == e, line);
          inverse.block<2, 2>(2 * d, 2 * e) = found.value;
          if (d == e) direct[d] = found;
        }
      }
      const Receptance<4> sum = inverse.inverse();
      const Receptance<2> r22 = artefact.ends().r22;
      for (int d = 0; d < 2; ++d) {
        if (!quality(d).measured) continue;
        const Receptance<2> a = sum.block<2, 2>(2 * d, 2 * d);
        holder_.receptance[i].block<2, 4>(2 * d, 0) = sum.block<2, 4>(2 * d, 0);
        holder_.receptance[i].block<2, 2>(2 * d, 2 * d) = a - r22;
        if (!quality(1 - d).measured) holder_.receptance[i].block<2, 2>(2 * d, 2 - 2 * d).setZero();
        // d l = -(A dY A)_12.
        const Eigen::RowVector3cd by(a(0, 0) * a(0, 1), a(0, 0) * a(1, 1) + a(0, 1) * a(0, 1),
                                     a(0, 1) * a(1, 1));
        const double deviation = std::sqrt((by * direct[d].covariance * by.adjoint())(0, 0).real());
        if (std::abs(a(0, 1) - r22(0, 1)) < kDeviations * deviation)
          quality(d).noisy_hz.push_back(frequency_hz_[line]);
      }
    }
  }

  Artefact artefact_at(std::size_t line) const {
    return Artefact(measurement_.artefact, theory_, rad_per_s_from_hz(frequency_hz_[line]));
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
  holder.couples_directions = couple(holder.receptance);
  return holder;
}

}  // namespace stablecut::receptance
