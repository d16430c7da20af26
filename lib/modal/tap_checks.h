// What a measurement shows about itself before anything is fitted: lines, channels and signs that cannot be
// right, and lines that would be taken for modes ([Ewins2000]; README.md, "Tap checks").
#pragma once

#include <optional>
#include <vector>

#include "dynamics/frequency_response.h"
#include "modal/entry_name.h"

namespace stablecut::modal {

/// Which fields of a TapFinding a kind sets stands behind it.
enum class TapFindingKind {
  kUnevenLines,      ///< the lines are unevenly spaced; `least` and `most`: their distances, Hz
  kZeroEntry,        ///< `entry` is 0 on every line, where that means a dead channel
  kConstantEntry,    ///< `entry` has the same value on every line
  kNothingButNoise,  ///< `entry` is noise in most windows
  kDrift,  ///< below `hi_hz` `entry` rises towards 0 Hz as no structure does; below `lo_hz` it gives energy
  kNoiseAtHighEnd,  ///< above `lo_hz` `entry` is within 10 dB of its noise
  kNoiseAtLowEnd,   ///< below `hi_hz`, an octave or more above the first line, `entry` is: a driving point,
                    ///< the worst
  kLikeVelocity,    ///< `entry`, a driving point: its real part has the sign that its imaginary part should
                    ///< have
  /// The imaginary part of `entry`, a driving point, is positive on the share `most` of what counts, and ...
  kPositiveRising,   ///< ... |H| rises with frequency, as an accelerance
  kPositiveFalling,  ///< ... |H| falls more steeply than a receptance does
  kPositive,         ///< ... nothing else is conspicuous
  kOppositeMirror,   ///< `entry` is `mirror` with the other sign
  kNotReciprocal,    ///< the cross entries differ from their mirrors by the share `most`, noise alone by
                     ///< `least`
  kExchanged,        ///< `entry` and `mirror`, responses to one force, look exchanged: the cross entries
                     ///< differ by the share `most`, with these exchanged by `least`
  kBothExchanged,    ///< the same of the responses to both forces, along `entry`'s two directions
  /// The coherence of `entry` is below `least` on the share `most` of the lines that respond, from `lo_hz` to
  /// `hi_hz`; `hit_delay_s` where its dips tell; `averages_known`
  kPoorCoherence,
  kSoft,            ///< the largest receptance, `most` m/N, is more than a structure has
  kStiff,           ///< the same, less
  kDisturbedLines,  ///< `lines_hz` stand out of their neighbours, and are few enough to be left out
};

struct TapFinding {
  TapFindingKind kind;
  EntryName entry{}, mirror{};
  double lo_hz = 0, hi_hz = 0;
  double least = 0, most = 0;
  std::optional<double> hit_delay_s{};  ///< between two hits of one tap
  bool averages_known = false;          ///< so that lines of poor coherence already weigh less
  std::vector<double> lines_hz{};
};

struct TapReport {
  std::vector<TapFinding> findings;
  /// The useless low end (kDrift) reaches up to here: a fit should leave it out. 0 where there is none.
  double usable_from_hz = 0;
  /// Up to here the low end is in doubt (kDrift): to be left out where a fit with it has no answer.
  double doubtful_to_hz = 0;
  /// Driving points fall up to here, where the first of them rises on the way to a resonance: drift falls so,
  /// and so do the flanks of modes below the band. 0 where that is above the lower third of the band.
  double falls_to_hz = 0;
  /// Single lines (indices, increasing) on which a value stands out of its neighbours in some entry, as mains
  /// hum makes it: each would become a mode without width, so a fit should leave them out. Empty where there
  /// are so many that something else is behind them.
  std::vector<Eigen::Index> disturbed_lines;
};

/// Looks at a receptance (m/N) with lines above 0 Hz. An entry of exact zeros is a dead channel where
/// `zeros_are_dead`, else uncoupled. Nothing is found on fewer than 20 lines.
TapReport check_tap(const dynamics::FrequencyResponse& receptance, bool zeros_are_dead);

/// What of the receptance that was looked at a fit should use: without entries of nothing but noise (where
/// there are others), disturbed lines and, unless `from_lowest`, the useless low end.
dynamics::FrequencyResponse usable_part(dynamics::FrequencyResponse receptance, const TapReport& report,
                                        bool from_lowest);

}  // namespace stablecut::modal
