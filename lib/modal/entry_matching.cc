#include "modal/entry_matching.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

#include "base/units.h"
#include "modal/tap_channels.h"
#include "modal/vector_fitting.h"
#include "numerics/golden_section.h"
#include "numerics/order_statistics.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr double kMostDelay = 6e-3;     // s
constexpr double kStepsPerPeriod = 12;  // of the highest line, in which delays are tried
constexpr double kMostTrials = 1e4;     // bounds the time: reached at 140 kHz
constexpr double kHalfOctave = 1.4142135623730951;
constexpr int kSections = 12;               // of the interval of a delay
constexpr Eigen::Index kPhaseLines = 1000;  // of which phases are looked at, or a few more
// Mean square of the energy that a driving point seems to give, as a sine of the phase, that is conspicuous,
// and what a common delay may leave more than delays of each.
constexpr double kGivenEnergy = 0.0001;
// Mean cosine between mirrored entries that is conspicuous, and what a delay must make better.
constexpr double kOutOfPhase = 0.985, kMoreInPhase = 0.02;
constexpr Eigen::Index kLeastLines = 20;  // clear of noise, or phases tell nothing
// Chi-square that a residue must be worth to tell a size: three of its deviations.
constexpr double kClearResidue = 9;
constexpr std::size_t kLeastResidues = 2;  // that tell a scale
// A scale is off by at least that (logarithm), and by so many deviations.
constexpr double kLeastScale = 0.01, kSignificant = 2;
// Logarithm of the odds from which on an entry is named, and not all that it could be.
constexpr double kSureWhich = 3;
constexpr double kLeastDeviation = 0.003;  // of a logarithm of four residues: poles are not known exactly
const double kDeviationOfMedian = 1.4826 * 1.2533;  // from the median absolute deviation, of a median

// Between delays that are tried.
double delay_step(double highest) {
  return std::max(kTwoPi / (kStepsPerPeriod * highest), kMostDelay / kMostTrials);
}

// A curve over its root mean square within half an octave, so that the resonances of each octave count alike.
Eigen::ArrayXcd levelled(const FitData& data, const Curve& curve) {
  const Eigen::ArrayXd size = local_rms(data, curve, kHalfOctave);
  return (size > 0).select(curve.h.array() / size.cast<Complex>(), Complex(0));
}

// Phases on lines that are clear of noise, weighted so that each octave counts alike.
class LinePhases {
 public:
  void add(double omega, Complex value) {
    omega_.push_back(omega);
    value_.push_back(value / omega);
    size_ += std::abs(value) / omega;
  }
  bool tells() const { return static_cast<Eigen::Index>(omega_.size()) >= kLeastLines && size_ > 0; }
  // Mean of cos(phase + omega delay).
  double cosine(double delay) const {
    double sum = 0;
    for (std::size_t i = 0; i < omega_.size(); ++i)
      sum += (value_[i] * std::polar(1.0, omega_[i] * delay)).real();
    return sum / size_;
  }
  // Mean of max(0, sin(phase + omega delay))^2.
  double given_energy(double delay) const {
    double sum = 0;
    for (std::size_t i = 0; i < omega_.size(); ++i) {
      const double sine = (value_[i] * std::polar(1.0, omega_[i] * delay)).imag();
      if (sine > 0) sum += sine * sine / std::abs(value_[i]);
    }
    return sum / size_;
  }

 private:
  std::vector<double> omega_;
  std::vector<Complex> value_;
  double size_ = 0;
};

// Median of logarithms by their precisions, and its deviation: from their scatter or from their own
// deviations, if more.
struct Middle {
  double value = 0, deviation = 0;
  std::size_t count = 0;
};

Middle middle_of(const std::vector<double>& values, const std::vector<double>& precisions) {
  Middle middle;
  middle.count = values.size();
  if (values.empty()) return middle;
  middle.value = numerics::weighted_quantile(values, precisions, 0.5);
  std::vector<double> away;
  away.reserve(values.size());
  double precision = 0, squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    away.push_back(std::abs(values[i] - middle.value));
    precision += precisions[i];
    squares += precisions[i] * precisions[i];
  }
  // As many equal ones tell as much.
  const double alike = precision * precision / squares;
  middle.deviation =
      std::max(kDeviationOfMedian * numerics::weighted_quantile(away, precisions, 0.5) / std::sqrt(alike),
               1 / std::sqrt(precision));
  return middle;
}

class Matching {
 public:
  Matching(const FitData& data, const std::vector<bool>& is_driving_point)
      : data_(data),
        driving_(is_driving_point),
        step_(std::max<Eigen::Index>(data.lines() / kPhaseLines, 1)) {
    for (std::size_t a = 0; a < data_.curves.size(); ++a) {
      const Curve& curve = data_.curves[a];
      const auto b = curve_between(curve.reference, curve.response);
      if (b && curve.response < curve.reference) {
        mirrors_.push_back({curve_between(curve.response, curve.response),
                            curve_between(curve.reference, curve.reference), a, *b});
      }
    }
  }

  std::vector<EntryMismatch> find(const Eigen::VectorXcd& poles) {
    judge_driving_points();
    for (const Mirrors& mirrors : mirrors_) judge_mirrors(mirrors);
    const LinearResidues residues = linear_residues(data_, poles);
    for (const Mirrors& mirrors : mirrors_)
      if (mirrors.ii && mirrors.jj) judge_scale(mirrors, poles, residues);
    return std::move(found_);
  }

 private:
  struct Mirrors {
    std::optional<std::size_t> ii, jj;
    std::size_t ij = 0, ji = 0;
  };

  std::optional<std::size_t> curve_between(Eigen::Index response, Eigen::Index reference) const {
    for (std::size_t c = 0; c < data_.curves.size(); ++c)
      if (data_.curves[c].response == response && data_.curves[c].reference == reference) return c;
    return std::nullopt;
  }
  bool is_clear(std::size_t c, Eigen::Index i) const {
    return std::norm(kNoiseShare * data_.curves[c].h[i]) * data_.curves[c].weight[i] > 1;
  }

  LinePhases phases_of(std::size_t c, double sign) const {
    LinePhases phases;
    for (Eigen::Index i = 0; i < data_.lines(); i += step_) {
      const Complex h = data_.curves[c].h[i];
      if (is_clear(c, i)) phases.add(data_.s[i].imag(), sign * h / std::abs(h));
    }
    return phases;
  }

  // A driving point takes energy, Im H <= 0. Either all curves are late, or some driving points.
  void judge_driving_points() {
    std::vector<LinePhases> points;
    double by_own = 0, now = 0;
    for (std::size_t c = 0; c < data_.curves.size(); ++c) {
      if (!driving_[c]) continue;
      LinePhases phases = phases_of(c, 1);
      if (!phases.tells()) continue;
      double given = phases.given_energy(0);
      // A swapped sign alone is no delay.
      if (LinePhases swapped = phases_of(c, -1); swapped.given_energy(0) < std::min(given, kGivenEnergy)) {
        given = swapped.given_energy(0);
        phases = std::move(swapped);
      }
      now += given;
      if (given > kGivenEnergy) {
        const double delay = best_delay(data_.highest(), [&](double d) { return -phases.given_energy(d); });
        by_own += phases.given_energy(delay);
        if (given - phases.given_energy(delay) > kGivenEnergy)
          found_.push_back({.curve = c, .delay_s = delay});
      } else {
        by_own += given;
      }
      points.push_back(std::move(phases));
    }
    if (found_.empty()) return;
    const auto given_by_all = [&](double delay) {
      double sum = 0;
      for (const LinePhases& phases : points) sum += phases.given_energy(delay);
      return sum;
    };
    const double delay = best_delay(data_.highest(), [&](double d) { return -given_by_all(d); });
    const double left = given_by_all(delay);
    if (now - left < kGivenEnergy) return;
    const EntryMismatch all{.curve = found_[0].curve, .delay_s = delay, .all = true};
    if (points.size() == 1) found_.clear();
    found_.insert(left - by_own < kGivenEnergy ? found_.begin() : found_.end(), all);
  }

  // Mirrored entries are equal, or opposite.
  void judge_mirrors(const Mirrors& mirrors) {
    const Eigen::ArrayXcd a = levelled(data_, data_.curves[mirrors.ij]),
                          b = levelled(data_, data_.curves[mirrors.ji]);
    LinePhases phases;
    for (Eigen::Index i = 0; i < data_.lines(); i += step_) {
      if (is_clear(mirrors.ij, i) && is_clear(mirrors.ji, i))
        phases.add(data_.s[i].imag(), a[i] * std::conj(b[i]) * std::abs(a[i] * b[i]));
    }
    if (!phases.tells() || std::abs(phases.cosine(0)) > kOutOfPhase) return;
    const auto alike = [&](double delay) { return std::abs(phases.cosine(delay)); };
    const double delay = best_delay(data_.highest(), alike);
    if (alike(delay) < alike(0) + kMoreInPhase) return;
    found_.push_back({.curve = mirrors.ij, .delay_s = delay});
    found_.push_back({.curve = mirrors.ji, .delay_s = -delay});
  }

  // A mode's residues R_ii R_jj and R_ij R_ji are equal.
  void judge_scale(const Mirrors& mirrors, const Eigen::VectorXcd& poles, const LinearResidues& residues) {
    const std::array<std::size_t, 4> quad{*mirrors.ii, *mirrors.jj, mirrors.ij, mirrors.ji};
    std::vector<double> determinant, unlike, precision;
    for (Eigen::Index k = 0; k < poles.size(); ++k) {
      double variance = kLeastDeviation * kLeastDeviation;
      std::array<double, 4> size{};
      bool clear = data_.in_band(poles[k]) && -poles[k].real() < kMostDamping * std::abs(poles[k]);
      for (std::size_t c = 0; c < 4; ++c) {
        const double loss = residues.loss(k, static_cast<Eigen::Index>(quad[c]));
        clear = clear && loss > kClearResidue;
        variance += 0.5 / std::max(loss, 1.0);  // of the logarithm of a modulus
        size[c] = std::log(std::abs(residues.residue(k, static_cast<Eigen::Index>(quad[c]))));
      }
      if (!clear) continue;
      precision.push_back(1 / variance);
      determinant.push_back(size[0] + size[1] - size[2] - size[3]);
      unlike.push_back(size[2] - size[3]);
    }
    const Middle all = middle_of(determinant, precision), cross = middle_of(unlike, precision);
    if (all.count < kLeastResidues ||
        std::abs(all.value) < std::max(kLeastScale, kSignificant * all.deviation))
      return;
    // The scale of a cross entry shows against its mirror image too, that of a driving point does not; what
    // misplaced hits do to mirror images scatters over the modes: Student's distribution.
    const double freedom = static_cast<double>(cross.count) - 1;
    const auto unlikely = [&](double off) {
      return (freedom + 1) / 2 * std::log1p(std::pow(off / cross.deviation, 2) / freedom);
    };
    const double gain = unlikely(cross.value) - unlikely(std::abs(cross.value) - std::abs(all.value));
    if (gain > kSureWhich) {
      found_.push_back(
          {.curve = cross.value * all.value < 0 ? mirrors.ij : mirrors.ji, .factor = std::exp(-all.value)});
    } else {
      found_.push_back({.curve = *mirrors.ii,
                        .other = mirrors.jj,
                        .factor = std::exp(all.value),
                        .or_cross = gain > -kSureWhich});
    }
  }

  const FitData& data_;
  const std::vector<bool>& driving_;
  Eigen::Index step_;  // between lines whose phases are looked at
  std::vector<Mirrors> mirrors_;
  std::vector<EntryMismatch> found_;
};

}  // namespace

FitData mended(FitData data, const EntryMismatch& mismatch) {
  for (std::size_t c = 0; c < data.curves.size(); ++c) {
    if (!mismatch.all && c != mismatch.curve) continue;
    Curve& curve = data.curves[c];
    const Eigen::ArrayXcd change = (data.s.array() * mismatch.delay_s).exp() / mismatch.factor;
    curve.h.array() *= change;
    if (curve.shared.size() > 0) curve.shared.array() *= change;
    curve.weight *= mismatch.factor * mismatch.factor;
  }
  return data;
}

bool matters(const FitData& data, const EntryMismatch& mismatch) {
  return std::abs(std::log(mismatch.factor)) >= kLeastScale ||
         std::abs(mismatch.delay_s) * data.highest() >= kLeastScale;
}

double delays_tried(double highest) { return 2 * kMostDelay / delay_step(highest) + 1; }

double best_delay(double highest, const std::function<double(double)>& value) {
  const double step = delay_step(highest);
  double best = 0, most = value(0);
  const auto steps = static_cast<int>(kMostDelay / step);
  for (int k = 1; k <= steps; ++k) {
    const double delay = k * step;
    for (const double of_either_sign : {delay, -delay}) {
      const double now = value(of_either_sign);
      if (!(now > most)) continue;
      most = now;
      best = of_either_sign;
    }
  }
  struct Trial {
    double delay, value;
  };
  return numerics::golden_section(
             best - step, best + step, Trial{best, most}, kSections, [](const Trial& t) { return t.delay; },
             [&](double delay) {
               return Trial{delay, value(delay)};
             },
             [](const Trial& a, const Trial& b) { return a.value > b.value; },
             [](const Trial&) { return false; })
      .delay;
}

std::vector<EntryMismatch> suggested_mismatches(const FitData& data, const Eigen::VectorXcd& poles,
                                                const std::vector<bool>& is_driving_point) {
  if (poles.size() == 0) return {};
  return Matching(data, is_driving_point).find(poles);
}

}  // namespace stablecut::modal
