#include "modal/mismatch_proof.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

#include "modal/likelihood.h"
#include "modal/maximum_likelihood.h"
#include "modal/mode_search.h"
#include "modal/vector_fitting.h"

namespace stablecut::modal {
namespace {

constexpr std::size_t kMostMismatches = 4;  // of one group
constexpr int kEstimates = 3;               // of a delay or factor, between refinements
constexpr double kLeastOwn = 1e-6;          // share of its slope that modes cannot imitate
constexpr double kLeftOfAsMany = 0.95;      // of a model error, when as many modes meet the mended curves
constexpr double kNoWorse = 2;  // chi-square of linear least squares that may be left of mended curves
constexpr Effort kBetween{60, 0.01};

// Schwarz' criterion [Schwarz1978].
double criterion(const GroupFit& fit, double inflation) {
  return 2 * fit.refined.chi_square / inflation +
         static_cast<double>(fit.modes().size()) * fit.parameters_per_mode() * std::log(fit.data.values());
}

// The mismatch that is left of curves that modes explain, of the logarithm of a factor or of a delay: one
// step of Gauss and Newton for it and the modes' parameters together. It moves the model: noise on the curve
// would pull a slope of what was measured.
double step_of(const GroupFit& fit, const EntryMismatch& mismatch) {
  if (fit.modes().empty()) return 0;  // nothing says what the curves should be
  FitData changed = fit.data;
  double product = 0, square = 0;
  for (std::size_t c = 0; c < changed.curves.size(); ++c) {
    Curve& curve = changed.curves[c];
    const Eigen::VectorXcd model = curve_of(fit.modes(), curve, changed.s);
    Eigen::VectorXcd slope = Eigen::VectorXcd::Zero(curve.h.size());  // of model - h
    if (mismatch.all || c == mismatch.curve)
      slope = mismatch.factor == 1 ? Eigen::VectorXcd(-changed.s.cwiseProduct(model)) : model;
    product += (slope.conjugate().cwiseProduct(model - curve.h)).real().dot(curve.weight);
    square += slope.cwiseAbs2().dot(curve.weight);
    curve.h = model - slope;
    curve.shared.resize(0);
  }
  const ModeParameters parameters(fit.modes(), changed.dofs, fit.model);
  const Eigen::VectorXd x = parameters.pack(fit.modes());
  const std::vector<bool> outside = out_of_band(changed, fit.modes());
  // The gradient of curves that are off by the slope is the product of both.
  const NormalEquations of_slope = Likelihood(changed, parameters, outside).evaluate(x, true);
  const Eigen::VectorXd along = inverse_normal_matrix(of_slope) * of_slope.gradient;
  FitData measured = fit.data;
  for (Curve& curve : measured.curves) curve.shared.resize(0);
  const NormalEquations of_error = Likelihood(measured, parameters, outside).evaluate(x, true);
  const double left = square - along.dot(of_slope.gradient);
  return left > kLeastOwn * square ? -(product - along.dot(of_error.gradient)) / left : 0;
}

EntryMismatch inverse_of(EntryMismatch mismatch) {
  mismatch.delay_s = -mismatch.delay_s;
  mismatch.factor = 1 / mismatch.factor;
  return mismatch;
}

struct Proven {
  EntryMismatch mismatch;
  double gain = 0;  // in Schwarz' criterion, of the mended curves
};

// Whether the curves have no free scales against each other.
bool in_one_part(const FitData& data) {
  const std::vector<std::size_t> parts = data.vector_parts();
  return std::all_of(parts.begin(), parts.end(), [&](std::size_t part) { return part == parts[0]; });
}

class Proof {
 public:
  Proof(const GroupFit& fit, const CurveVariances& given, const SelectionOptions& options)
      : fit_(fit), given_(given), options_(options) {}

  // The curves of `now` mended, if modes explain them better than `now` explains them as they are. A factor
  // is looked for from the other curves' modes and from the one that was suggested: either may be far off.
  std::optional<Proven> of(const GroupFit& now, const EntryMismatch& suggested) const {
    if (suggested.factor == 1 && is_worse(now, suggested)) return std::nullopt;
    if (suggested.all) return of_all(now, suggested);
    EntryMismatch told = suggested;
    std::optional<GroupFit> from_others = from_the_others(now, told);
    std::optional<Proven> best = from_others ? proved(now, told, std::move(*from_others)) : std::nullopt;
    if (from_others && suggested.factor == 1) return best;
    std::optional<Proven> other =
        proved(now, suggested, searched(now, mended(now.data, suggested), given_, suggested));
    return !best || (other && other->gain > best->gain) ? other : best;
  }

  // What a search finds in the mended curves, for the next mismatch to be looked for. The mismatch stays: of
  // what is left of it the modes of a search are an imitation.
  GroupFit without(const GroupFit& now, const EntryMismatch& mismatch) const {
    return searched(now, mended(now.data, mismatch), given_, mismatch);
  }

 private:
  // Phases of driving points bound a common delay from below, and modes without a resonance or above the band
  // imitate what is left of it: if that proves nothing it is estimated without these, and the curves are
  // searched again.
  std::optional<Proven> of_all(const GroupFit& now, const EntryMismatch& suggested) const {
    const GroupFit after = searched(now, mended(now.data, suggested), given_, suggested);
    std::optional<Proven> proven = proved(now, suggested, after);
    for (const bool above_band : {false, true}) {
      if (proven) break;
      GroupFit plain = after;
      std::erase_if(plain.refined.modes, [&](const dynamics::Mode& mode) {
        return above_band ? mode.pole().imag() > now.data.highest() : mode.damping_ratio > kMostDamping;
      });
      if (plain.modes().empty() || plain.modes().size() == after.modes().size()) continue;
      plain.refined = plain.refine(plain.modes(), kBetween);
      EntryMismatch mismatch = suggested;
      estimate(plain, mismatch);
      proven = proved(now, mismatch, searched(now, mended(now.data, mismatch), given_, mismatch));
    }
    return proven;
  }

  // `after` is a fit of the curves without the mismatch. Both are judged by the noise that the mended curves
  // show, and the curves as they are by the better of both fits' modes: that a search found more is no
  // mismatch.
  std::optional<Proven> proved(const GroupFit& now, EntryMismatch mismatch, GroupFit after) const {
    estimate(after, mismatch);
    if (!matters(now.data, mismatch)) return std::nullopt;
    // A fit must not excuse its own misfit by a larger inflation.
    const double inflation = std::min(after.inflation_of(after.refined), now.inflation_of(now.refined));
    GroupFit before = now, alike = now;
    before.data = alike.data = mended(after.data, inverse_of(mismatch));
    before.refined = before.refine(now.modes(), kBetween);
    alike.refined = alike.refine(after.modes(), kBetween);
    const double with_as_many = alike.refined.chi_square;
    if (criterion(alike, inflation) < criterion(before, inflation)) before = std::move(alike);
    const double gain = criterion(before, inflation) - criterion(after, inflation);
    if (!(gain > price_of(mismatch))) return std::nullopt;
    // Against a model error a chi-square tells little: fewer modes prove nothing unless as many leave more.
    if (after.regime == Regime::kModelError && after.refined.chi_square > before.refined.chi_square &&
        after.refined.chi_square > kLeftOfAsMany * with_as_many)
      return std::nullopt;
    return Proven{mismatch, gain};
  }

  // Its own number, and which curve's, and of delays which one, it is the best of: each of n is one of n by
  // chance.
  double price_of(const EntryMismatch& mismatch) const {
    const auto curves = static_cast<double>(fit_.data.curves.size()) + 1;
    const double trials = mismatch.factor == 1 ? curves * delays_tried(fit_.data.highest()) : curves;
    return std::log(fit_.data.values()) + 2 * std::log(trials);
  }

  // Poles that imitate a delay are no worse for curves without it: where they are, there was none. Linear
  // least squares tell at once, and spare a search.
  static bool is_worse(const GroupFit& now, const EntryMismatch& mismatch) {
    FitData without = mended(now.data, mismatch), with = now.data;
    if (!mismatch.all) {
      with.curves = {with.curves[mismatch.curve]};
      without.curves = {without.curves[mismatch.curve]};
    }
    return linear_residues(without, now.start_poles).chi_square >
           kNoWorse * linear_residues(with, now.start_poles).chi_square;
  }

  // Improves the mismatch, which has been taken off the curves of `fit`.
  void estimate(GroupFit& fit, EntryMismatch& mismatch) const {
    for (int i = 0; i < kEstimates; ++i) {
      const double step = step_of(fit, mismatch);
      EntryMismatch left = mismatch;
      left.delay_s = mismatch.factor == 1 ? step : 0;
      left.factor = mismatch.factor == 1 ? 1 : std::exp(step);
      fit.data = mended(std::move(fit.data), left);
      weigh(fit);
      mismatch.delay_s += left.delay_s;
      mismatch.factor *= left.factor;
    }
  }

  // The modes of the other curves, where these tell all of the curve, and what they say of it: the delay or
  // factor.
  std::optional<GroupFit> from_the_others(const GroupFit& now, EntryMismatch& mismatch) const {
    if (mismatch.all) return std::nullopt;
    const Curve& curve = now.data.curves[mismatch.curve];
    FitData others = now.data;
    others.curves.erase(others.curves.begin() + static_cast<std::ptrdiff_t>(mismatch.curve));
    const auto shown = [&](auto&& by) { return std::any_of(others.curves.begin(), others.curves.end(), by); };
    if (!shown([&](const Curve& c) { return c.response == curve.response; }) ||
        !shown([&](const Curve& c) { return c.reference == curve.reference; }) || !in_one_part(others))
      return std::nullopt;
    CurveVariances variance = given_;
    if (!variance.empty()) variance.erase(variance.begin() + static_cast<std::ptrdiff_t>(mismatch.curve));
    GroupFit fit = searched(now, std::move(others), std::move(variance), mismatch);
    const Eigen::ArrayXcd told = curve_of(fit.modes(), curve, now.data.s);
    const Eigen::ArrayXcd product = told.conjugate() * curve.h.array() * curve.weight.array();
    if (mismatch.factor == 1) {
      mismatch.delay_s = best_delay(now.data.highest(), [&](double delay) {
        return (product * (now.data.s.array() * delay).exp()).real().sum();
      });
    } else {
      const double factor = product.real().sum() / (told.abs2() * curve.weight.array()).sum();
      if (!(factor > 0)) return std::nullopt;
      mismatch.factor = factor;
    }
    fit.data = mended(now.data, mismatch);
    weigh(fit);
    return fit;
  }

  // By the given noise, or by what the modes leave.
  void weigh(GroupFit& fit) const {
    fit.shared.clear();
    fit.variance = given_.empty() ? residual_as_noise(fit.data, fit.modes(), 1, true).variance : given_;
    for (std::size_t c = 0; c < given_.size(); ++c)
      fit.variance[c] *= fit.data.curves[c].h.squaredNorm() / fit_.data.curves[c].h.squaredNorm();
    fit.weigh(fit.regime);
    fit.refined = fit.refine(fit.modes(), kBetween);
  }

  // What a search finds in curves of `now` that have been mended. A factor leaves the poles as they are that
  // curves with residues of their own have; those that imitate a delay would be in its way.
  GroupFit searched(const GroupFit& now, FitData data, CurveVariances variance,
                    const EntryMismatch& mismatch) const {
    SelectionOptions options = options_;
    if (mismatch.factor != 1) options.starts = now.start_poles;
    GroupFit found = search_modes(std::move(data), std::move(variance), options);
    return found.model == fit_.model ? found : in_model(std::move(found), fit_.model, options_);
  }

  const GroupFit& fit_;
  const CurveVariances& given_;
  const SelectionOptions& options_;
};

// What was left of a mismatch that has been found is added to it.
void add(const EntryMismatch& mismatch, std::vector<EntryMismatch>& proved) {
  const auto same = std::find_if(proved.begin(), proved.end(), [&](const EntryMismatch& one) {
    return one.all == mismatch.all && (one.all || one.curve == mismatch.curve) &&
           (one.factor == 1) == (mismatch.factor == 1);
  });
  if (same == proved.end()) return proved.push_back(mismatch);
  same->delay_s += mismatch.delay_s;
  same->factor *= mismatch.factor;
}

}  // namespace

std::vector<EntryMismatch> proved_mismatches(const GroupFit& fit, const CurveVariances& given,
                                             const std::vector<bool>& is_driving_point,
                                             const SelectionOptions& options) {
  std::vector<EntryMismatch> proved;
  const Proof proof(fit, given, options);
  GroupFit now = fit;
  for (std::size_t i = 0; i < kMostMismatches; ++i) {
    std::optional<Proven> best;
    for (const EntryMismatch& suggested : suggested_mismatches(now.data, now.start_poles, is_driving_point)) {
      const std::optional<Proven> better = proof.of(now, suggested);
      if (better && (!best || better->gain > best->gain)) best = better;
    }
    if (!best) break;
    add(best->mismatch, proved);
    now = proof.without(now, best->mismatch);
  }
  return proved;
}

}  // namespace stablecut::modal
