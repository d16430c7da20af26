#include "receptance/measured_holder.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "base/error.h"
#include "base/units.h"
#include "dynamics/noise.h"
#include "dynamics/synthesis.h"

namespace stablecut {
namespace {

using Complex = std::complex<double>;

constexpr std::array<const char*, 4> kCoordinates = {"x", "slope_x", "y", "slope_y"};
constexpr double kSamePlace = 1e-9;     // m
constexpr double kDeviations = 3;       // of the noise, below which a value is noise
constexpr double kPassiveShare = 0.05;  // of the receptance, which may be given away before it is said
constexpr std::size_t kDirectPairs = 3, kCrossPairs = 4;  // unknowns of a symmetric and of any 2x2 matrix

// One measured curve between two places.
struct Tap {
  int response = 0, reference = 0;  // of kCoordinates
  double response_m = 0, reference_m = 0;
  Eigen::VectorXcd h;
  Eigen::VectorXd variance;  // of the complex value

  bool slope() const { return response % 2 == 1 || reference % 2 == 1; }
  bool between(int a, int b) const { return response == a && reference == b; }
  bool at(double a, double b) const {
    return std::abs(response_m - a) < kSamePlace && std::abs(reference_m - b) < kSamePlace;
  }
};

using Taps = std::vector<Tap>;

const Tap* find(const Taps& taps, int response, int reference, double response_m, double reference_m) {
  const auto found = std::find_if(taps.begin(), taps.end(), [&](const Tap& tap) {
    return tap.between(response, reference) && tap.at(response_m, reference_m);
  });
  return found == taps.end() ? nullptr : &*found;
}

Taps taps_of(const FrequencyResponse& measured, const Eigen::VectorXd& frequency_hz) {
  // A line at 0 Hz has no receptance when acceleration was measured, and no assembly asks for it.
  FrequencyResponse frf = to_receptance(
      within_band(measured, std::numeric_limits<double>::min(), std::numeric_limits<double>::infinity()));
  if (frf.frequency_hz.size() == 0) throw InvalidArgument("no line above 0 Hz");
  for (auto& entry : frf.entries) {
    entry.variance = known_variance(entry);
    if (entry.variance.size() == 0) entry.variance = estimated_variance(entry.h, entry.h.cwiseAbs());
  }
  frf = on_lines(frf, frequency_hz);
  Taps taps;
  for (const auto& entry : frf.entries) {
    const auto coordinate = [](const std::string& name) {
      return static_cast<int>(std::find(kCoordinates.begin(), kCoordinates.end(), name) -
                              kCoordinates.begin());
    };
    Tap tap{coordinate(entry.response),
            coordinate(entry.reference),
            entry.response_position_m.value_or(0),
            entry.reference_position_m.value_or(0),
            entry.h,
            entry.variance};
    if (tap.response < 4 && tap.reference < 4) taps.push_back(std::move(tap));
  }
  return taps;
}

// H = (1 + m w^2 D)^-1 H_measured, D the measured direct receptances (x and y) at the sensor's place.
void remove_sensor(Taps& taps, double mass_kg, const Eigen::VectorXd& frequency_hz) {
  const Taps measured = taps;
  for (Tap& tap : taps) {
    if (tap.slope())
      throw InvalidArgument("a sensor's mass can be taken off deflections only, not off slopes");
    const double a = tap.response_m;
    const int other = 2 - tap.response;
    const auto curve = [&](int response, int reference, double reference_m) {
      const Tap* found = find(measured, response, reference, a, reference_m);
      return found == nullptr ? Eigen::VectorXcd::Zero(tap.h.size()).eval() : found->h;
    };
    if (find(measured, tap.response, tap.response, a, a) == nullptr) {
      throw InvalidArgument(std::string("the direct receptance ") +
                            kCoordinates[static_cast<std::size_t>(tap.response)] +
                            " at the sensor's place, " + std::to_string(1e3 * a) +
                            " mm: missing, and needed to take its mass away");
    }
    const Eigen::VectorXcd own = curve(tap.response, tap.response, a), away = curve(tap.response, other, a);
    const Eigen::VectorXcd back = curve(other, tap.response, a), across = curve(other, other, a);
    const Eigen::VectorXcd other_h = curve(other, tap.reference, tap.reference_m);
    for (Eigen::Index i = 0; i < tap.h.size(); ++i) {
      const double mw2 = mass_kg * std::pow(rad_per_s_from_hz(frequency_hz[i]), 2);
      const Eigen::Matrix2cd factor{{1.0 + mw2 * own[i], mw2 * away[i]},
                                    {mw2 * back[i], 1.0 + mw2 * across[i]}};
      const Eigen::Matrix2cd inverse = factor.inverse();
      tap.variance[i] *= std::norm(inverse(0, 0));
      tap.h[i] = inverse(0, 0) * tap.h[i] + inverse(0, 1) * other_h[i];
    }
  }
}

// Between directions, what was measured one way only holds the other way as well.
void complete_by_reciprocity(Taps& taps) {
  const std::size_t measured = taps.size();
  for (std::size_t i = 0; i < measured; ++i) {
    Tap mirrored = taps[i];
    std::swap(mirrored.response, mirrored.reference);
    std::swap(mirrored.response_m, mirrored.reference_m);
    const bool between_directions = mirrored.response / 2 != mirrored.reference / 2;
    if (between_directions && find(taps, mirrored.response, mirrored.reference, mirrored.response_m,
                                   mirrored.reference_m) == nullptr)
      taps.push_back(std::move(mirrored));
  }
}

std::string direction_name(int direction) { return kCoordinates[static_cast<std::size_t>(2 * direction)]; }

// One of the four blocks, response direction d, reference direction e, line by line, with the variance of its
// upper right entry l.
struct Block {
  std::vector<Receptance<2>> value;
  Eigen::VectorXd l_variance;
};

// What was measured with slopes; a missing one of l and n is taken by reciprocity on the diagonal.
bool block_of_slopes(const Taps& taps, int d, int e, Block& block) {
  std::array<const Tap*, 4> entry{};
  for (int i = 0; i < 4; ++i)
    entry[static_cast<std::size_t>(i)] = find(taps, 2 * d + i / 2, 2 * e + i % 2, 0, 0);
  if (d == e && entry[1] == nullptr) entry[1] = entry[2];
  if (d == e && entry[2] == nullptr) entry[2] = entry[1];
  if (entry[1] == nullptr || entry[2] == nullptr) return false;
  if (entry[0] == nullptr || entry[3] == nullptr) {
    throw InvalidArgument(direction_name(d) + direction_name(e) +
                          ": entries with slopes: expected deflection and slope by force and moment");
  }
  for (std::size_t i = 0; i < block.value.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
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
    const auto at = static_cast<Eigen::Index>(i);
    const Complex h = direct->h[at], l = (h - of_moment->h[at]) / spacing,
                  n = (h - of_slope->h[at]) / spacing;
    Complex p = h == 0.0 ? 0.0 : l * n / h;
    if (far != nullptr) p = (h - of_moment->h[at] - of_slope->h[at] + far->h[at]) / (spacing * spacing);
    block.value[i] << h, l, n, p;
  }
  return true;
}

// The free artefact at one line: between the pairs of places, and from each place to the joint.
class Artefact {
 public:
  Artefact(const BeamChain& chain, BeamTheory theory, double omega)
      : chain_(chain), theory_(theory), omega_(omega) {}

  BeamReceptances ends() const { return free_chain(chain_, theory_, omega_); }
  Complex between(double a, double b) const {
    return free_receptance_along(chain_, theory_, omega_, a, b)(0, 0);
  }
  Eigen::RowVector2cd to_joint(double a) {
    const auto found = to_joint_.find(a);
    if (found != to_joint_.end()) return found->second;
    return to_joint_[a] = free_response_to_end(chain_, theory_, omega_, a).row(0);
  }

 private:
  const BeamChain& chain_;
  BeamTheory theory_;
  double omega_;
  std::map<double, Eigen::RowVector2cd> to_joint_;
};

// (R22 + H)^-1 of one pair of directions from taps along the artefact, and the covariance of its parameters
// (symmetric: Y11, Y12, Y22) on the diagonal of directions.
struct Inverse {
  Receptance<2> value = Receptance<2>::Zero();
  Eigen::MatrixXcd covariance;
};

Inverse inverse_of(const std::vector<const Tap*>& taps, Artefact& artefact, bool symmetric,
                   Eigen::Index line) {
  const auto rows = static_cast<Eigen::Index>(taps.size());
  Eigen::MatrixXcd system(rows, symmetric ? 3 : 4);
  Eigen::VectorXcd right(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Tap& tap = *taps[static_cast<std::size_t>(i)];
    const Eigen::RowVector2cd a = artefact.to_joint(tap.response_m), b = artefact.to_joint(tap.reference_m);
    const double least = 1e-12 * std::abs(tap.h[line]);
    const double weight = 1 / std::max({std::sqrt(tap.variance[line]), least, 1e-300});
    right[i] =
        weight * ((symmetric ? artefact.between(tap.response_m, tap.reference_m) : Complex(0)) - tap.h[line]);
    if (symmetric) {
      system.row(i) << a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[1] * b[1];
    } else {
      system.row(i) << a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1];
    }
    system.row(i) *= weight;
  }
  const Eigen::VectorXd scale = system.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXcd scaled = system * scale.asDiagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXcd> solver(scaled);
  if (solver.rank() < scaled.cols()) {
    throw InvalidArgument(
        "the taps along the artefact are too alike to tell what holds it: expected pairs of at least two "
        "places, "
        "as 0 and 0, 0 and 45, 45 and 45 mm");
  }
  const Eigen::VectorXcd y = scale.asDiagonal() * solver.solve(right);
  Inverse inverse;
  if (symmetric) {
    inverse.value << y[0], y[1], y[1], y[2];
    inverse.covariance = scale.asDiagonal() * (scaled.adjoint() * scaled).inverse() * scale.asDiagonal();
  } else {
    inverse.value << y[0], y[1], y[2], y[3];
  }
  return inverse;
}

std::vector<const Tap*> taps_between(const Taps& taps, int d, int e) {
  std::vector<const Tap*> result;
  for (const Tap& tap : taps) {
    if (tap.between(2 * d, 2 * e)) result.push_back(&tap);
  }
  return result;
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

class HolderBuilder {
 public:
  HolderBuilder(const HolderMeasurement& measurement, BeamTheory theory, const Eigen::VectorXd& frequency_hz)
      : measurement_(measurement),
        theory_(theory),
        frequency_hz_(frequency_hz),
        lines_(static_cast<std::size_t>(frequency_hz.size())),
        taps_(taps_of(measurement.frf, frequency_hz)) {
    if (measurement.sensor_mass_kg > 0) remove_sensor(taps_, measurement.sensor_mass_kg, frequency_hz);
    complete_by_reciprocity(taps_);
    double length = 0;
    for (const BeamSegment& segment : measurement.artefact) length += segment.length_m;
    for (const Tap& tap : taps_) {
      const double farthest = std::max(tap.response_m, tap.reference_m);
      if (length > 0 && farthest > length * (1 + 1e-12)) {
        throw InvalidArgument("position " + std::to_string(1e3 * farthest) +
                              " mm: expected a place on the artefact, up to " + std::to_string(1e3 * length) +
                              " mm");
      }
    }
    holder_.receptance.assign(lines_, Receptance<4>::Zero());
    for (int d = 0; d < 2; ++d) quality(d).measured = !taps_between(taps_, d, d).empty();
    if (!quality(0).measured && !quality(1).measured)
      throw InvalidArgument("no entry xx and none yy: expected one");
  }

  MeasuredHolder build() {
    if (!measurement_.artefact.empty() && along_artefact()) {
      from_pairs_of_places();
    } else {
      from_tip();
    }
    for (const auto& h : holder_.receptance) {
      holder_.couples_directions = holder_.couples_directions || !h.topRightCorner<2, 2>().isZero(0) ||
                                   !h.bottomLeftCorner<2, 2>().isZero(0);
    }
    for (int d = 0; d < 2; ++d) {
      if (!quality(d).measured) continue;
      for (std::size_t i = 0; i < lines_; ++i) {
        if (!is_passive(holder_.receptance[i].block<2, 2>(2 * d, 2 * d)))
          quality(d).unphysical_hz.push_back(frequency_hz_[static_cast<Eigen::Index>(i)]);
      }
    }
    return std::move(holder_);
  }

 private:
  HolderQuality& quality(int d) { return holder_.quality[static_cast<std::size_t>(d)]; }

  bool along_artefact() const {
    for (int d = 0; d < 2; ++d) {
      std::set<std::pair<double, double>> pairs;  // h(a, b) and h(b, a) say the same
      for (const Tap* tap : taps_between(taps_, d, d))
        pairs.insert(std::minmax(tap->response_m, tap->reference_m));
      if (!pairs.empty() && pairs.size() < kDirectPairs) return false;
    }
    return std::none_of(taps_.begin(), taps_.end(), [](const Tap& tap) { return tap.slope(); });
  }

  // Whether there are entries between the two directions that can be of use; says so when not.
  bool cross_wanted(int d, int e) {
    if (all_zero(taps_between(taps_, d, e))) return false;
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
      const auto at = static_cast<Eigen::Index>(i);
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
        auto& pairs = taps[static_cast<std::size_t>(d)][static_cast<std::size_t>(e)];
        if (d == e || cross_wanted(d, e)) pairs = taps_between(taps_, d, e);
      }
    }
    // Cross entries in both senses, or not at all.
    if (taps[0][1].size() < kCrossPairs || taps[1][0].size() < kCrossPairs) {
      holder_.cross_left_out = holder_.cross_left_out || !taps[0][1].empty() || !taps[1][0].empty();
      taps[0][1].clear();
      taps[1][0].clear();
    }
    for (std::size_t i = 0; i < lines_; ++i) {
      const auto line = static_cast<Eigen::Index>(i);
      Artefact artefact = artefact_at(i);
      // A direction without taps is held by nothing here, and left zero.
      Receptance<4> inverse = Receptance<4>::Identity();
      std::array<Inverse, 2> direct;
      for (int d = 0; d < 2; ++d) {
        for (int e = 0; e < 2; ++e) {
          const auto& pairs = taps[static_cast<std::size_t>(d)][static_cast<std::size_t>(e)];
          if (pairs.empty()) continue;
          const Inverse found = inverse_of(pairs, artefact, d == e, line);
          inverse.block<2, 2>(2 * d, 2 * e) = found.value;
          if (d == e) direct[static_cast<std::size_t>(d)] = found;
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
        const double deviation =
            std::sqrt((by * direct[static_cast<std::size_t>(d)].covariance * by.adjoint())(0, 0).real());
        if (std::abs(a(0, 1) - r22(0, 1)) < kDeviations * deviation)
          quality(d).noisy_hz.push_back(frequency_hz_[line]);
      }
    }
  }

  Artefact artefact_at(std::size_t line) const {
    return Artefact(measurement_.artefact, theory_,
                    rad_per_s_from_hz(frequency_hz_[static_cast<Eigen::Index>(line)]));
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

MeasuredHolder modal_holder(const ModalModel& model, const Eigen::VectorXd& frequency_hz) {
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
    const Eigen::MatrixXcd h = receptance_at(model, Complex(0, rad_per_s_from_hz(hz)));
    Receptance<4> at_joint = Receptance<4>::Zero();
    for (Eigen::Index i = 0; i < 4; ++i) {
      for (Eigen::Index j = 0; j < 4; ++j) {
        const auto from = row[static_cast<std::size_t>(i)], to = row[static_cast<std::size_t>(j)];
        if (from >= 0 && to >= 0) at_joint(i, j) = h(from, to);
      }
    }
    holder.couples_directions = holder.couples_directions || !at_joint.topRightCorner<2, 2>().isZero(0) ||
                                !at_joint.bottomLeftCorner<2, 2>().isZero(0);
    holder.receptance.push_back(at_joint);
  }
  return holder;
}

}  // namespace stablecut
