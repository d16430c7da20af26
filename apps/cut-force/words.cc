#include "words.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "document/kinds/identified_cut_json.h"

namespace stablecut {
namespace {

using milling::Coefficient;
using milling::CoefficientVerdict;

constexpr std::array<const char*, milling::kCoefficients> kSymbols = {"Kt", "Kr", "Kte", "Kre", "Ka", "Kae"};
constexpr std::array<double, milling::kCoefficients> kUnits = {1e6, 1e6, 1e3, 1e3, 1e6, 1e3};

constexpr double kFewSamples = 100;  // effective: an outer quantile then rests on two or three
constexpr double kCoarse = 0.01;     // an error of the growth from which on there is a warning

const char* unit_text(int c) { return kUnits[c] > 1e5 ? " N/mm2" : " N/mm"; }

std::string value_text(const milling::ForceIdentification& found, int c) {
  return std::string(kSymbols[c]) + " = " + number_text(found.value[c] / kUnits[c], 4) + " +- " +
         number_text(found.half_interval_95[c] / kUnits[c], 3) + unit_text(c);
}

bool surely_negative(const milling::ForceIdentification& found, int c) {
  return found.verdict[c] == CoefficientVerdict::kIdentified &&
         found.value[c] + found.half_interval_95[c] < 0;
}

std::string of(int count, const char* what) { return std::to_string(count) + " " + what; }

}  // namespace

std::string no_coefficients_text(const milling::ForceIdentification& fitted) {
  for (const int c : {static_cast<int>(Coefficient::kKt), static_cast<int>(Coefficient::kKr)}) {
    const std::string symbol = kSymbols[c];
    switch (fitted.verdict[c]) {
      case CoefficientVerdict::kUnmeasured:
        return symbol + " cannot be found: expected forces fx_n and fy_n";
      case CoefficientVerdict::kInseparable:
        return symbol +
               " cannot be told from its edge force or the other coefficients: expected cuts at several "
               "feeds with forces in both directions, or --edges cut";
      case CoefficientVerdict::kHeld:
      case CoefficientVerdict::kIdentified:
        break;
    }
  }
  const bool kt_wrong = !(fitted.of(Coefficient::kKt) > 0);
  if (!kt_wrong && !surely_negative(fitted, static_cast<int>(Coefficient::kKr))) return "";
  std::string text = value_text(fitted, 0) + ", " + value_text(fitted, 1) + ": expected numbers above 0: ";
  if (kt_wrong && fitted.of(Coefficient::kKr) < 0)
    return text + "are these the forces on the workpiece? (--force-on workpiece)";
  return text +
         "is fx_n along the feed and fy_n to its left seen from the spindle, with their signs, and is up or "
         "down milling right?";
}

std::vector<std::string> identification_warnings(const milling::ForceIdentification& fitted,
                                                 const std::array<bool, milling::kCoefficients>& held_at_zero,
                                                 const std::string& source) {
  std::vector<std::string> warnings;
  const std::array<const char*, 2> forces = {"forces in the plane", "axial forces"};
  for (int g = 0; g < 2; ++g) {
    const milling::ForceResidual& residual = fitted.residual[g];
    if (residual.measured == 0) continue;
    if (!fitted.deviations_known[g])
      warnings.push_back(source + ": " + of(residual.measured, forces[g]) +
                         " are as many as the coefficients: no standard deviations");
    if (residual.deviations_contradicted)
      warnings.push_back(source + ": " + forces[g] +
                         ": the residuals are too large for the stated standard "
                         "deviations (chi-square per degree of freedom " +
                         number_text(*residual.chi_square_per_dof, 3) + "): the deviations were scaled up");
    if (residual.not_linear)
      warnings.push_back(source + ": " + forces[g] +
                         " are not linear in the feed: the coefficients are those of "
                         "a line through these feeds, and their deviations do not hold beyond");
    if (residual.uneven)
      warnings.push_back(source +
                         ": fx_n and fy_n scatter differently: columns fx_std_n and fy_std_n would weigh "
                         "them, and make the deviations right");
  }
  for (int c = 2; c < milling::kCoefficients; ++c) {
    if (fitted.verdict[c] == CoefficientVerdict::kInseparable)
      warnings.push_back(std::string(kSymbols[c]) +
                         " cannot be told from other coefficients: left as in the cut");
  }
  for (int c = 0; c < milling::kCoefficients; ++c) {
    if (!held_at_zero[c]) continue;
    warnings.push_back(
        value_text(fitted, c) + ": held at 0, and the others found anew" +
        (surely_negative(fitted, c)
             ? ": it is plainly below 0: are the signs right, and the forces linear in the feed?"
             : ""));
  }
  std::string untold;
  for (int c = 0; c < milling::kCoefficients; ++c) {
    if (fitted.verdict[c] == CoefficientVerdict::kIdentified && !held_at_zero[c] &&
        std::abs(fitted.value[c]) <= fitted.half_interval_95[c])
      untold += (untold.empty() ? "" : ", ") + value_text(fitted, c);
  }
  if (!untold.empty()) warnings.push_back(untold + ": the interval reaches 0");
  return warnings;
}

std::vector<std::string> point_warnings(const std::vector<document::SimulatedPoint>& points,
                                        const std::string& source) {
  int failed = 0, away = 0, slow = 0, coarse = 0, open = 0, elsewhere = 0;
  const std::string* first = nullptr;
  for (const document::SimulatedPoint& point : points) {
    if (!point.result) {
      ++failed;
      if (!first) first = &point.failure;
      continue;
    }
    coarse += !(point.result->growth.error < kCoarse);
    open += point.result->is_open();
    elsewhere += !point.result->keeps_contact;
    away += point.result->ran_away;
    slow += point.result->stable() && !point.result->settled && !point.result->ran_away;
  }
  std::vector<std::string> warnings;
  if (failed > 0)
    warnings.push_back(source + ": " + *first + "; points without an answer: " + std::to_string(failed));
  if (coarse > 0)
    warnings.push_back(source + ": at " +
                       of(coarse,
                          "points the growth has not settled with the steps (see "
                          "growth_error)"));
  if (open > 0)
    warnings.push_back(source + ": at " +
                       of(open,
                          "points the growth is nearer to 1 than its error: whether they are stable is left "
                          "open"));
  if (elsewhere > 0)
    warnings.push_back(source + ": at " +
                       of(elsewhere,
                          "points the motion whose growth is told would leave a tooth without its chip: the "
                          "growth says nothing of the one that takes its place (see keeps_contact)"));
  if (away > 0)
    warnings.push_back(source + ": at " +
                       of(away,
                          "points the tip went a decimetre away: the modes of the table "
                          "do not hold a tool there, and only the growth is said"));
  if (slow > 0)
    warnings.push_back(source + ": at " +
                       of(slow,
                          "points the growth is below 1, and the motion has not settled: "
                          "near the limit, or another motion beside the stable one (--passes, --from-rest)"));
  return warnings;
}

std::string contradiction_text(const milling::CoefficientPosterior& posterior,
                               const milling::PosteriorRequest& request, std::size_t cuts) {
  return "the tested cuts contradict the modal table and the deviations of Kt and Kr: only a share of " +
         number_text(posterior.as_unlikely_share, 2) +
         " of what these would show is as improbable; the Kt and Kr that agree best leave " +
         std::to_string(posterior.least_contradicting) + " of " + std::to_string(cuts) +
         " cuts unexplained, of which " + number_text(request.wrong_share * static_cast<double>(cuts), 2) +
         " may be wrong: another tool, larger deviations, or more wrong observations (--wrong-share)?";
}

std::vector<std::string> posterior_warnings(const milling::CoefficientPosterior& posterior) {
  std::vector<std::string> warnings;
  if (posterior.effective_samples < kFewSamples)
    warnings.push_back("the answer rests on " + number_text(posterior.effective_samples, 2) +
                       " effective samples: more are needed (--samples)");
  const auto judge = [&](const char* symbol, double value, double deviation) {
    if (deviation > value)
      warnings.push_back(std::string(symbol) + " = " + number_text(value * 1e-6, 4) +
                         " N/mm2 with a standard deviation of " + number_text(deviation * 1e-6, 3) +
                         ": the tested cuts leave it open");
  };
  judge("Kt", posterior.kt_n_per_m2, posterior.deviations.kt_n_per_m2);
  judge("Kr", posterior.kr_n_per_m2, posterior.deviations.kr_n_per_m2);
  return warnings;
}

}  // namespace stablecut
