#include "words.h"

#include <algorithm>

#include "base/number_text.h"

namespace stablecut {
namespace {

constexpr std::size_t kShownLines = 5;  // of the disturbed ones, and of modes

std::string number(double value) { return number_text(value, 3); }

std::string name_of(const modal::EntryName& entry) { return "H" + entry.response + entry.reference; }

std::string positive_on(const modal::TapFinding& finding, const std::string& guess) {
  return name_of(finding.entry) + ": a driving point's imaginary part is negative, this is positive on " +
         percent_text(finding.most) + guess + "; the modes would give energy away";
}

std::string poor_coherence(const modal::TapFinding& finding) {
  std::string text = name_of(finding.entry) + ": coherence below " + number(finding.least) + " on " +
                     percent_text(finding.most) + " of the lines that respond, from " +
                     number(finding.lo_hz) + " to " + number(finding.hi_hz) + " Hz";
  text += finding.hit_delay_s
              ? ", with dips every " + number(1 / *finding.hit_delay_s) + " Hz, as of a second hit " +
                    number(1e3 * *finding.hit_delay_s) + " ms after the first"
              : ": noise, a double hit or a changing structure";
  return text +
         (finding.averages_known ? "; such lines weigh less" : "; with --averages N such lines weigh less");
}

std::string exchanged(const modal::TapFinding& finding) {
  const std::string which =
      finding.kind == modal::TapFindingKind::kExchanged
          ? name_of(finding.entry) + " and " + name_of(finding.mirror) + " look exchanged"
          : "the responses along " + finding.entry.response + " and " + finding.entry.reference +
                " look exchanged in all entries";
  return which + ": cross entries differ from their mirror images by " + percent_text(finding.most) +
         ", the other way round by " + percent_text(finding.least) +
         "; the modes would not be the tool's (swap the channels in the file or in --entry)";
}

std::string unusual_peak(const modal::TapFinding& finding) {
  return "the largest receptance is " + number(finding.most) + " m/N, a structure as " +
         (finding.kind == modal::TapFindingKind::kSoft ? "soft" : "stiff") + " as " +
         number(1 / finding.most) +
         " N/m: is that the unit (--unit, --quantity)? Depths of cut would be wrong by as much";
}

std::string disturbed_lines(const modal::TapFinding& finding) {
  std::string list;
  for (std::size_t i = 0; i < std::min(finding.lines_hz.size(), kShownLines); ++i)
    list += (i == 0 ? "" : ", ") + number_text(finding.lines_hz[i]);
  if (finding.lines_hz.size() > kShownLines) list += ", ...";
  return "single lines stand out of their neighbours (" + std::to_string(finding.lines_hz.size()) + ": " +
         list + " Hz), as hum does: left out, since each would be taken for a mode";
}

std::string frequencies(const std::vector<double>& hz) {
  std::string list;
  for (std::size_t i = 0; i < std::min(hz.size(), kShownLines); ++i)
    list += (i == 0 ? "" : ", ") + number_text(hz[i], 4);
  return list + (hz.size() > kShownLines ? ", ..." : "");
}

std::string list_of(const std::vector<modal::EntryName>& entries, const std::string& between = ", ") {
  std::string list;
  for (const modal::EntryName& entry : entries)
    list += (list.empty() ? "" : between) + entry.response + entry.reference;
  return list;
}

std::string scaled(const modal::FitFinding& finding) {
  const auto part = [&](std::size_t from, std::size_t count, double factor) {
    const std::vector<modal::EntryName> entries(finding.missing.begin() + from,
                                                finding.missing.begin() + from + count);
    return "H" + list_of(entries, " or H") + " is " + number_text(factor, 4) + " times what fits the others";
  };
  const bool or_cross = finding.missing.size() == 4;
  const modal::EntryName& first = finding.missing[0];
  return part(0, or_cross ? 2 : finding.missing.size(), finding.factor) +
         (or_cross ? ", or " + part(2, 2, 1 / finding.factor) : "") +
         ": a wrong sensitivity or unit; modes are doubled to make up for it (--scale " + first.response +
         first.reference + "=" + number_text(1 / finding.factor, 4) +
         (finding.missing.size() > 1 ? ", if it is that one)" : ")");
}

std::string one_factor(const modal::FitFinding& finding) {
  const modal::ReciprocityFactor& found = finding.reciprocity;
  return name_of(finding.missing[0]) + " is " + number(found.factor) + " (+- " +
         number_text(found.deviation, 1) + ") times " + name_of(finding.missing[1]) + " in all " +
         std::to_string(found.modes) +
         " modes that show both: the sensitivity of a sensor or of the hammer is off in one direction, or "
         "the taps of one direction lie beside the sensor; depths of cut are wrong by up to as much";
}

std::string shifted(const modal::FitFinding& finding) {
  const modal::PoleShift& shift = finding.shift;
  const std::string part = shift.of_force ? "force" : "response";
  const auto factor = [](double value) { return number_text(value, 5); };
  return "the curves of " + part + " " + finding.directions[0] + " have natural frequencies " +
         factor(shift.least) + (shift.least == shift.most ? "" : " to " + factor(shift.most)) + " (+- " +
         number_text(shift.deviation, 1) + ") times those of " +
         (finding.directions.size() == 2 ? part + " " + finding.directions[1] : "the others") +
         (shift.in_all         ? ""
          : shift.doubled == 1 ? " in one mode"
                               : " in " + std::to_string(shift.doubled) + " modes") +
         ": a sensor that was moved, or a structure that changed between the taps; the speeds of a chart are "
         "off by as much" +
         (shift.doubled == 0 ? ""
          : shift.doubled == 1
              ? ", and a mode is doubled to make up for it"
              : ", and " + std::to_string(shift.doubled) + " modes are doubled to make up for it");
}

std::string unexplained(const modal::FitFinding& finding) {
  const std::string modes = finding.restricted ? "modes of this model" : "the modes found";
  const std::string left = finding.missing.empty()
                               ? "the curves"
                               : name_of(finding.missing[0]) + " from " + number(finding.lo_hz) + " to " +
                                     number(finding.hi_hz) + " Hz";
  return modes + " leave " + percent_text(finding.error) + " of " + left +
         (finding.restricted ? ": the structure is not like that" : ": is a part of the band unusable?");
}

}  // namespace

std::string words_of(const modal::TapFinding& finding, bool band_chosen) {
  const std::string name = name_of(finding.entry);
  switch (finding.kind) {
    case modal::TapFindingKind::kUnevenLines:
      return "the lines are " + number(finding.least) + " to " + number(finding.most) +
             " Hz apart: each counts alike, so that modes where they lie close are weighed more";
    case modal::TapFindingKind::kZeroEntry:
      return name + ": all lines are 0: a dead channel, or one that was not measured; taken as uncoupled";
    case modal::TapFindingKind::kConstantEntry:
      return name +
             ": the same value on every line: a dead channel; modes that follow from it are not measured";
    case modal::TapFindingKind::kNothingButNoise:
      return name + ": nothing but noise: a dead channel, or uncoupled directions; left out of the fit";
    case modal::TapFindingKind::kDrift:
      return finding.lo_hz > 0
                 ? "below " + number(finding.lo_hz) + " Hz " + name +
                       " rises towards 0 Hz with an imaginary part above 0, as no structure does: integrated "
                       "drift of the sensor; " +
                       (band_chosen
                            ? "modes found there are not the structure's"
                            : "left out of the fit, with any modes that it has (--band says otherwise)")
                 : "below " + number(finding.hi_hz) + " Hz " + name +
                       " rises towards 0 Hz within 10 dB of its noise or beyond it, as no structure does: "
                       "integrated noise or drift of the sensor; modes there may be missing, or be none of "
                       "the structure";
    case modal::TapFindingKind::kNoiseAtLowEnd:
      return "below " + number(finding.hi_hz) + " Hz " + name +
             " is within 10 dB of its noise: modes there may be missing in the table, and then limit no "
             "chart";
    case modal::TapFindingKind::kNoiseAtHighEnd:
      return "above " + number(finding.lo_hz) + " Hz " + name +
             " is within 10 dB of its noise: these lines add little but computing time (--band)";
    case modal::TapFindingKind::kLikeVelocity:
      return name +
             ": its real part has one sign, where a driving point's imaginary part has: is it a velocity "
             "(--quantity), or was it one already? The modes would not be the tool's";
    case modal::TapFindingKind::kPositiveRising:
      return positive_on(
          finding, ": is it an acceleration (--quantity)? Else the sign of response or force is swapped");
    case modal::TapFindingKind::kPositiveFalling:
      return positive_on(finding,
                         ": is it a displacement already (--quantity)? Else the sign of response or "
                         "force is swapped");
    case modal::TapFindingKind::kPositive:
      return positive_on(
          finding, ": the sign of response or force is swapped, or it is another quantity (--quantity)");
    case modal::TapFindingKind::kOppositeMirror:
      return name + " is " + name_of(finding.mirror) +
             " with the other sign: one direction is swapped in one of them (-x in the file or in --entry); "
             "the modes cannot be reciprocal";
    case modal::TapFindingKind::kNotReciprocal:
      return "cross entries differ from their mirror images by " + percent_text(finding.most) +
             ", noise alone would by " + percent_text(finding.least) +
             ": not reciprocal, as a controlled robot is, or taps at other places than the sensor's; the "
             "modes follow what was measured";
    case modal::TapFindingKind::kExchanged:
    case modal::TapFindingKind::kBothExchanged:
      return exchanged(finding);
    case modal::TapFindingKind::kPoorCoherence:
      return poor_coherence(finding);
    case modal::TapFindingKind::kSoft:
    case modal::TapFindingKind::kStiff:
      return unusual_peak(finding);
    case modal::TapFindingKind::kDisturbedLines:
      return disturbed_lines(finding);
  }
  return "";
}

std::string untold_text(const dynamics::ModalModel& table) {
  const std::vector<std::size_t> untold = dynamics::untold_modes(table);
  if (untold.empty()) return "";
  std::vector<double> hz;
  for (const std::size_t k : untold) hz.push_back(table.modes[k].frequency_hz);
  return "damping or vectors of " + std::to_string(untold.size()) + " of " +
         std::to_string(table.modes.size()) + " modes are smaller than their own standard deviations (" +
         frequencies(hz) + " Hz): these numbers tell nothing by themselves";
}

std::string ringing_text(const modal::RingingModes& ringing) {
  return "at the end of records of " + number(ringing.record_s) + " s, as lines " +
         number(1 / ringing.record_s) + " Hz apart come from, modes still ring with up to " +
         percent_text(ringing.share) + " of their first size (" + frequencies(ringing.hz) +
         " Hz): if these were records of taps, their vectors are off by up to as much, and drift is added; "
         "longer records help, or an exponential window (--window-decay)";
}

std::string left_out_text(double hz, bool falls) {
  return "below " + number(hz) + " Hz: left out of the fit, " +
         (falls ? "as no modes of a structure explain what rises towards 0 Hz there: integrated drift of the "
                  "sensor (--band says otherwise)"
                : "which has no answer with these lines") +
         "; modes there are missing in the table, and limit no chart";
}

std::string words_of(const modal::FitFinding& finding) {
  switch (finding.kind) {
    case modal::FitFindingKind::kVarianceTooSmall:
      return "the residual is much larger than the given variance: the noise was estimated instead";
    case modal::FitFindingKind::kFewerModes:
      return "only " + std::to_string(finding.modes) + " modes could be told apart";
    case modal::FitFindingKind::kSelectionUnsettled:
      return "the selection of modes was ended before it had settled, at " + std::to_string(finding.modes) +
             " modes: there may be more (--band divides the work)";
    case modal::FitFindingKind::kByReciprocity:
      return "missing entries " + list_of(finding.missing) +
             ": what they would tell is set by reciprocity, or to zero";
    case modal::FitFindingKind::kTakenAsUncoupled:
      return "missing entries " + list_of(finding.missing) + ": these directions are taken as uncoupled";
    case modal::FitFindingKind::kDelayed:
      return "H" + finding.missing[0].response + finding.missing[0].reference + ": its response comes " +
             number(1e3 * finding.delay_s) +
             " ms late, so that its modes do not fit those of the others (--delay " +
             finding.missing[0].response + finding.missing[0].reference + "=" +
             number_text(1e3 * finding.delay_s, 4) + ")";
    case modal::FitFindingKind::kAllDelayed:
      return "the responses come " + number(1e3 * finding.delay_s) +
             " ms late: no structure has such phases (--delay " + number_text(1e3 * finding.delay_s, 4) + ")";
    case modal::FitFindingKind::kScaled:
      return scaled(finding);
    case modal::FitFindingKind::kOneFactor:
      return one_factor(finding);
    case modal::FitFindingKind::kShifted:
      return shifted(finding);
    case modal::FitFindingKind::kLowEndLeft:
      return "below " + number(finding.hi_hz) +
             " Hz the curves fall as those of no structure do: integrated drift of the sensor, or lines that "
             "nothing was "
             "measured on (--band); modes there may be none of the structure";
    case modal::FitFindingKind::kNoMode:
      return "no mode in the band stands out of the noise";
    case modal::FitFindingKind::kNotConverged:
      return "the fit did not converge";
    case modal::FitFindingKind::kUnexplained:
      return unexplained(finding);
    case modal::FitFindingKind::kModelError:
      return "the residual is larger than the noise, or not white: " +
             std::string(finding.restricted ? "modes of this model" : "the strongest modes") + " leave " +
             percent_text(finding.error) + " of the curves";
  }
  return "";
}

}  // namespace stablecut
