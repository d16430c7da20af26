#include "words.h"

#include <catch2/catch.hpp>

using namespace stablecut;
using modal::FitFinding;
using modal::FitFindingKind;
using modal::TapFinding;
using modal::TapFindingKind;

namespace {

const modal::EntryName kXx{"x", "x"}, kXy{"x", "y"}, kYx{"y", "x"};

void check(const TapFinding& finding, const std::string& text, bool band_chosen = false) {
  CHECK(words_of(finding, band_chosen) == text);
}
void check(const FitFinding& finding, const std::string& text) { CHECK(words_of(finding) == text); }

}  // namespace

TEST_CASE("what a tap shows about itself, in words") {
  check({.kind = TapFindingKind::kUnevenLines, .least = 0.11567, .most = 11.5},
        "the lines are 0.116 to 11.5 Hz apart: each counts alike, so that modes where they lie close are "
        "weighed more");
  check({.kind = TapFindingKind::kZeroEntry, .entry = kXy},
        "Hxy: all lines are 0: a dead channel, or one that was not measured; taken as uncoupled");
  check({.kind = TapFindingKind::kConstantEntry, .entry = kXy},
        "Hxy: the same value on every line: a dead channel; modes that follow from it are not measured");
  check({.kind = TapFindingKind::kNothingButNoise, .entry = kYx},
        "Hyx: nothing but noise: a dead channel, or uncoupled directions; left out of the fit");
  check({.kind = TapFindingKind::kDrift, .entry = kXx, .lo_hz = 65.4, .hi_hz = 70},
        "below 65.4 Hz Hxx rises towards 0 Hz with an imaginary part above 0, as no structure does: "
        "integrated drift of the sensor; left out of the fit, with any modes that it has (--band says "
        "otherwise)");
  check({.kind = TapFindingKind::kDrift, .entry = kXx, .lo_hz = 65.4, .hi_hz = 70},
        "below 65.4 Hz Hxx rises towards 0 Hz with an imaginary part above 0, as no structure does: "
        "integrated drift of the sensor; modes found there are not the structure's",
        true);
  check({.kind = TapFindingKind::kDrift, .entry = kXx, .hi_hz = 18.5},
        "below 18.5 Hz Hxx rises towards 0 Hz within 10 dB of its noise or beyond it, as no structure does: "
        "integrated noise or drift of the sensor; modes there may be missing, or be none of the structure");
  check({.kind = TapFindingKind::kNoiseAtLowEnd, .entry = kXx, .hi_hz = 18.5},
        "below 18.5 Hz Hxx is within 10 dB of its noise: modes there may be missing in the table, and then "
        "limit no chart");
  check({.kind = TapFindingKind::kNoiseAtHighEnd, .entry = kXx, .lo_hz = 810},
        "above 810 Hz Hxx is within 10 dB of its noise: these lines add little but computing time (--band)");
  check({.kind = TapFindingKind::kLikeVelocity, .entry = kXx},
        "Hxx: its real part has one sign, where a driving point's imaginary part has: is it a velocity "
        "(--quantity), or was it one already? The modes would not be the tool's");
  check({.kind = TapFindingKind::kPositiveRising, .entry = kXx, .most = 1},
        "Hxx: a driving point's imaginary part is negative, this is positive on 100 %: is it an acceleration "
        "(--quantity)? Else the sign of response or force is swapped; the modes would give energy away");
  check({.kind = TapFindingKind::kPositiveFalling, .entry = kXx, .most = 0.9},
        "Hxx: a driving point's imaginary part is negative, this is positive on 90 %: is it a displacement "
        "already (--quantity)? Else the sign of response or force is swapped; the modes would give energy "
        "away");
  check(
      {.kind = TapFindingKind::kPositive, .entry = kXx, .most = 1},
      "Hxx: a driving point's imaginary part is negative, this is positive on 100 %: the sign of response or "
      "force is swapped, or it is another quantity (--quantity); the modes would give energy away");
  check({.kind = TapFindingKind::kExchanged, .entry = kXx, .mirror = kYx, .least = 0.02, .most = 0.6},
        "Hxx and Hyx look exchanged: cross entries differ from their mirror images by 60 %, the other way "
        "round by 2 %; the modes would not be the tool's (swap the channels in the file or in --entry)");
  check({.kind = TapFindingKind::kOppositeMirror, .entry = kXy, .mirror = kYx},
        "Hxy is Hyx with the other sign: one direction is swapped in one of them (-x in the file or in "
        "--entry); the modes cannot be reciprocal");
  check(
      {.kind = TapFindingKind::kNotReciprocal, .least = 0.012, .most = 0.2},
      "cross entries differ from their mirror images by 20 %, noise alone would by 1.2 %: not reciprocal, as "
      "a controlled robot is, or taps at other places than the sensor's; the modes follow what was measured");
  check({.kind = TapFindingKind::kSoft, .most = 0.5},
        "the largest receptance is 0.5 m/N, a structure as soft as 2 N/m: is that the unit (--unit, "
        "--quantity)? Depths of cut would be wrong by as much");
  check({.kind = TapFindingKind::kStiff, .most = 1e-12},
        "the largest receptance is 1e-12 m/N, a structure as stiff as 1e+12 N/m: is that the unit (--unit, "
        "--quantity)? Depths of cut would be wrong by as much");
  check({.kind = TapFindingKind::kPoorCoherence,
         .entry = kXx,
         .lo_hz = 40,
         .hi_hz = 990,
         .least = 0.8,
         .most = 0.4,
         .hit_delay_s = 0.012},
        "Hxx: coherence below 0.8 on 40 % of the lines that respond, from 40 to 990 Hz, with dips every 83.3 "
        "Hz, "
        "as of a second hit 12 ms after the first; with --averages N such lines weigh less");
  check(
      {.kind = TapFindingKind::kPoorCoherence,
       .entry = kXx,
       .lo_hz = 40,
       .hi_hz = 990,
       .least = 0.8,
       .most = 0.4,
       .averages_known = true},
      "Hxx: coherence below 0.8 on 40 % of the lines that respond, from 40 to 990 Hz: noise, a double hit or "
      "a changing structure; such lines weigh less");
  TapFinding disturbed{.kind = TapFindingKind::kDisturbedLines};
  disturbed.lines_hz = {50, 100, 150};
  check(disturbed,
        "single lines stand out of their neighbours (3: 50, 100, 150 Hz), as hum does: left out, since each "
        "would be taken for a mode");
  disturbed.lines_hz = {50, 100, 150, 200, 250, 300};
  check(disturbed,
        "single lines stand out of their neighbours (6: 50, 100, 150, 200, 250, ... Hz), as hum does: left "
        "out, since each would be taken for a mode");
}

TEST_CASE("modes of which nothing is told, in words") {
  dynamics::ModalModel table;
  table.dofs = {"x"};
  for (const double hz : {100.0, 200.0, 300.0, 400.0, 500.0, 600.0, 700.04})
    table.modes.push_back({hz, 0.02, Eigen::VectorXcd::Ones(1), Eigen::VectorXcd::Ones(1)});
  table.covariance = Eigen::MatrixXd::Zero(42, 42);
  CHECK(untold_text(table) == "");
  table.covariance(37, 37) = 1;  // the last damping
  CHECK(untold_text(table) ==
        "damping or vectors of 1 of 7 modes are smaller than their own standard deviations (700 Hz): these "
        "numbers tell nothing by themselves");
  for (int k = 0; k < 6; ++k) table.covariance(6 * k + 1, 6 * k + 1) = 1;
  CHECK_THAT(untold_text(table),
             Catch::Contains("7 of 7 modes") && Catch::Contains("(100, 200, 300, 400, 500, ... Hz)"));
}

TEST_CASE("modes that ring at the end of a record, in words") {
  CHECK(ringing_text({.record_s = 0.5, .hz = {14.1, 22.04}, .share = 0.2345}) ==
        "at the end of records of 0.5 s, as lines 2 Hz apart come from, modes still ring with up to 23 % of "
        "their first size (14.1, 22.04 Hz): if these were records of taps, their vectors are off by up to as "
        "much, and drift is added; longer records help, or an exponential window (--window-decay)");
}

TEST_CASE("a low end that was left out is said") {
  CHECK(left_out_text(18.5, false) ==
        "below 18.5 Hz: left out of the fit, which has no answer with these lines; modes there are missing "
        "in the table, and limit no chart");
  CHECK(
      left_out_text(18.5, true) ==
      "below 18.5 Hz: left out of the fit, as no modes of a structure explain what rises towards 0 Hz there: "
      "integrated drift of the sensor (--band says otherwise); modes there are missing in the table, and "
      "limit no chart");
}

TEST_CASE("what a fit leaves to be known, in words") {
  check({.kind = FitFindingKind::kVarianceTooSmall},
        "the residual is much larger than the given variance: the noise was estimated instead");
  check({.kind = FitFindingKind::kFewerModes, .modes = 3}, "only 3 modes could be told apart");
  check({.kind = FitFindingKind::kSelectionUnsettled, .modes = 60},
        "the selection of modes was ended before it had settled, at 60 modes: there may be more (--band "
        "divides the work)");
  check({.kind = FitFindingKind::kByReciprocity, .missing = {kXy, {"y", "y"}}},
        "missing entries xy, yy: what they would tell is set by reciprocity, or to zero");
  check({.kind = FitFindingKind::kTakenAsUncoupled, .missing = {kXy, kYx}},
        "missing entries xy, yx: these directions are taken as uncoupled");
  check({.kind = FitFindingKind::kModelError, .error = 0.017},
        "the residual is larger than the noise, or not white: the strongest modes leave 1.7 % of the curves");
  check({.kind = FitFindingKind::kModelError, .error = 0.3, .restricted = true},
        "the residual is larger than the noise, or not white: modes of this model leave 30 % of the curves");
  check({.kind = FitFindingKind::kDelayed, .missing = {kXy}, .delay_s = 7.1112e-4},
        "Hxy: its response comes 0.711 ms late, so that its modes do not fit those of the others (--delay "
        "xy=0.7111)");
  check({.kind = FitFindingKind::kAllDelayed, .missing = {kXx}, .delay_s = 1.5e-3},
        "the responses come 1.5 ms late: no structure has such phases (--delay 1.5)");
  check({.kind = FitFindingKind::kScaled, .missing = {kXx, {"y", "y"}}, .factor = 1.25},
        "Hxx or Hyy is 1.25 times what fits the others: a wrong sensitivity or unit; modes are doubled to "
        "make up for it (--scale xx=0.8, if it is that one)");
  check({.kind = FitFindingKind::kScaled, .missing = {kXx, {"y", "y"}, kXy, kYx}, .factor = 1.25},
        "Hxx or Hyy is 1.25 times what fits the others, or Hxy or Hyx is 0.8 times what fits the others: a "
        "wrong sensitivity or unit; modes are doubled to make up for it (--scale xx=0.8, if it is that one)");
  check(
      {.kind = FitFindingKind::kOneFactor,
       .missing = {kXy, kYx},
       .reciprocity = {.factor = 1.1034, .deviation = 0.0123, .modes = 7}},
      "Hxy is 1.1 (+- 0.01) times Hyx in all 7 modes that show both: the sensitivity of a sensor or of the "
      "hammer is off in one direction, or the taps of one direction lie beside the sensor; depths of cut are "
      "wrong by up to as much");
  check({.kind = FitFindingKind::kLowEndLeft, .hi_hz = 14},
        "below 14 Hz the curves fall as those of no structure do: integrated drift of the sensor, or lines "
        "that nothing "
        "was measured on (--band); modes there may be none of the structure");
  check({.kind = FitFindingKind::kShifted,
         .shift = {.least = 0.99801, .most = 0.99801, .deviation = 2.34e-5, .doubled = 3},
         .directions = {"y", "x"}},
        "the curves of force y have natural frequencies 0.99801 (+- 2e-05) times those of force x: a sensor "
        "that was moved, or a structure that changed between the taps; the speeds of a chart are off by as "
        "much, and 3 modes are doubled to make up for it");
  check({.kind = FitFindingKind::kShifted,
         .shift = {.of_force = false,
                   .least = 0.992,
                   .most = 0.998,
                   .deviation = 1e-4,
                   .doubled = 2,
                   .in_all = false},
         .directions = {"y", "x", "z"}},
        "the curves of response y have natural frequencies 0.992 to 0.998 (+- 0.0001) times those of the "
        "others in 2 modes: a sensor that was moved, or a structure that changed between the taps; the "
        "speeds of a chart are off by as much, and 2 modes are doubled to make up for it");
  check({.kind = FitFindingKind::kNoMode}, "no mode in the band stands out of the noise");
  check({.kind = FitFindingKind::kNotConverged}, "the fit did not converge");
  check({.kind = FitFindingKind::kUnexplained, .missing = {kXy}, .error = 0.7, .lo_hz = 500, .hi_hz = 1000},
        "the modes found leave 70 % of Hxy from 500 to 1e+03 Hz: is a part of the band unusable?");
}
