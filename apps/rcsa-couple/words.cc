#include "words.h"

#include <algorithm>
#include <vector>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "option_values.h"

namespace stablecut {
namespace {

constexpr std::size_t kNamedGaps = 3;

// `12 of 400 lines (100 to 155 Hz)`.
std::string list_of_lines(const std::vector<double>& lines_hz, std::size_t all) {
  return std::to_string(lines_hz.size()) + " of " + std::to_string(all) + " lines (" +
         number_text(lines_hz.front()) + " to " + number_text(lines_hz.back()) + " Hz)";
}

// Intervals between measured lines, the worst error first.
std::string gaps_text(std::vector<dynamics::DoubtfulInterval> gaps) {
  std::sort(gaps.begin(), gaps.end(), [](const auto& a, const auto& b) { return a.error > b.error; });
  std::string text = "nothing was measured between ";
  for (std::size_t i = 0; i < std::min(kNamedGaps, gaps.size()); ++i)
    text += (i > 0 ? ", " : "") + number_text(gaps[i].from_hz) + " and " + number_text(gaps[i].to_hz) + " Hz";
  if (gaps.size() > kNamedGaps)
    text += " and in " + std::to_string(gaps.size() - kNamedGaps) + " more intervals";
  return text + ": the lines there are interpolated and may be off by " + percent_text(gaps.front().error) +
         " of the largest around or more, by a resonance that lies there or by noise that is carried across";
}

std::string limits_text(const receptance::HolderQuality& quality, std::size_t lines) {
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (quality.slopes == receptance::SlopeSource::kFiniteDifference) {
    add("slopes by a finite difference over " + number_text(mm_from_metres(quality.spacing_m)) +
        " mm, good where the part bends little between the two places" +
        (quality.second_difference ? "" : ", and slopes per moment as l n / h, exact for one mode only"));
  }
  if (!quality.noisy_hz.empty())
    add("the deflection per moment lies below " + number_text(receptance::kNoisyDeviations) +
        " standard deviations of its noise on " + list_of_lines(quality.noisy_hz, lines));
  if (!quality.unphysical_hz.empty())
    add("not passive on " + list_of_lines(quality.unphysical_hz, lines) +
        ": it would give energy to whatever loads it, by more than " +
        percent_text(receptance::kPassiveShare) + " of its receptance");
  if (!quality.doubtful.empty()) add(gaps_text(quality.doubtful));
  return text;
}

std::string words_of(const receptance::JointFinding& finding, const std::string& direction,
                     const std::string& tap) {
  using Kind = receptance::JointFinding::Kind;
  const std::string name = direction + ": " + kJointNames[finding.value];
  switch (finding.kind) {
    case Kind::kUnexplained:
      return direction + ": the best joint leaves " + percent_text(finding.number) +
             " of the measured tip, " + tap + ", unexplained: are tool, holder and units right?";
    case Kind::kNothingTold:
      return direction + ": the measured tip, " + tap +
             ", does not determine any of the joint's values: it moves no mode of this band, or is too stiff "
             "to be seen";
    case Kind::kPoorFit:
      return direction + ": the best joint leaves " + percent_text(finding.number) +
             " of the measured tip unexplained";
    case Kind::kAtBound:
      return name + " lies at its bound, " + number_text(finding.number);
    case Kind::kNotIdentifiable:
      return name + " is not identifiable: its standard deviation is " + percent_text(finding.number) +
             " of its value";
  }
  return "";
}

}  // namespace

std::string words_of(const document::HolderFinding& finding) {
  const std::string direction = finding.direction == 0 ? "x" : "y";
  const std::string other = finding.direction == 0 ? "y" : "x";
  switch (finding.kind) {
    case document::HolderFinding::Kind::kTakenFromOther:
      return finding.place + ": " + direction + direction + " is missing: " + direction + " is taken as " +
             other;
    case document::HolderFinding::Kind::kLimits:
      return finding.place + ": " + direction + ": " + limits_text(finding.quality, finding.lines);
    case document::HolderFinding::Kind::kCrossLeftOut:
      return finding.place +
             ": xy and yx are left out: they are used where xx and yy were measured, too, and xy or yx has "
             "slopes, a second place or, along an artefact, four pairs of places";
  }
  return "";
}

std::string words_of(const document::DoubtfulMaterial& material) {
  using Kind = receptance::MaterialDoubt::Kind;
  const receptance::MaterialDoubt& doubt = material.doubt;
  const double modulus = 1e-9 * material.material.youngs_modulus_pa,
               density = material.material.density_kg_per_m3;
  const bool of_density =
      doubt.modulus_factor == 1 && (doubt.density_factor != 1 || doubt.kind == Kind::kDensity);
  std::string text = material.place + (of_density ? "/density_kg_per_m3: " : "/youngs_modulus_gpa: ") +
                     number_text(of_density ? density : modulus) + ": ";
  switch (doubt.kind) {
    case Kind::kModulus:
      text += "no solid is as stiff";
      break;
    case Kind::kDensity:
      text += of_density ? "no solid has this density"
                         : "with a density of " + number_text(density) + " kg/m3 no solid's";
      break;
    case Kind::kWaveSpeed:
      text += "with " + (of_density ? number_text(modulus) + " GPa" : number_text(density) + " kg/m3") +
              " a wave speed of " + number_text(doubt.wave_speed_m_per_s, 3) +
              " m/s, and solids (rubber apart) have 450 to 19 000";
      break;
  }
  if (doubt.modulus_factor == 1 && doubt.density_factor == 1) return text;
  text += ": were";
  if (doubt.modulus_factor != 1) text += " " + number_text(doubt.modulus_factor * modulus) + " GPa";
  if (doubt.modulus_factor != 1 && doubt.density_factor != 1) text += " and";
  if (doubt.density_factor != 1) text += " " + number_text(doubt.density_factor * density) + " kg/m3";
  return text + " meant?";
}

std::string words_of(const document::DoubtfulSize& size) {
  double thickest = 0;
  for (const auto& segment : size.segments) thickest = std::max(thickest, segment.outer_diameter_m);
  const bool thin = size.doubt == receptance::SizeDoubt::kDiameter;
  const double metres = thin ? thickest : receptance::length_of(size.segments);
  return size.place + ": " + (thin ? "at most " : "together ") + number_text(mm_from_metres(metres)) +
         " mm " + (thin ? "thick" : "long") + ", as no tool and no holder is: were " +
         number_text(1e3 * mm_from_metres(metres)) + " mm meant? Sizes are expected in mm, not in m";
}

std::string words_of(const document::DoubtfulJointValue& value) {
  std::string text = value.place + ": " + number_text(value.value) + ": ";
  if (value.at_bound)
    text += "lies at its bound";
  else if (value.relative_deviation)
    text += "is not identifiable: its standard deviation is " + percent_text(*value.relative_deviation) +
            " of its value";
  else
    text += "is not identifiable";
  return text + "; what it does at another overhang or in another band is not known";
}

std::vector<std::string> warnings_of(const receptance::IdentifiedJoints& joints,
                                     const receptance::JointBounds& bounds,
                                     receptance::JointObjective objective, const std::string& tap) {
  using Kind = receptance::JointFinding::Kind;
  bool told = false;
  std::string untold;
  std::vector<std::string> warnings;
  for (std::size_t d = 0; d < 2; ++d) {
    if (!joints.estimate[d] || (d == 1 && joints.one_for_both)) continue;
    const std::string direction = joints.one_for_both ? "x and y" : d == 0 ? "x" : "y";
    const auto findings = receptance::findings_of(*joints.estimate[d], bounds, objective);
    told = told || std::none_of(findings.begin(), findings.end(),
                                [](const auto& finding) { return finding.kind == Kind::kNothingTold; });
    for (const auto& finding : findings) {
      const std::string text = words_of(finding, direction, tap);
      if (finding.kind == Kind::kUnexplained) throw NoAnswer(text);
      if (finding.kind == Kind::kNothingTold && untold.empty()) untold = text;
      warnings.push_back(text);
    }
  }
  if (!told) throw NoAnswer(untold);
  return warnings;
}

}  // namespace stablecut
