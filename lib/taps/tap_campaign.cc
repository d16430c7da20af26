#include "taps/tap_campaign.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "taps/exponential_window.h"
#include "taps/force_disturbance.h"

namespace stablecut::taps {
namespace {

constexpr double kHighestLine = 1 / 2.56;  // of the rate: what filters before a converter let pass
constexpr Eigen::Index kLeastLines = 8;    // that are of any use

using Index = Eigen::Index;

double common_rate(const std::vector<TapColumn>& columns) {
  const double rate = columns.front().records.front().sample_rate_hz;
  for (const TapColumn& column : columns) {
    for (const Record& record : column.records) {
      if (record.sample_rate_hz != rate)
        throw InvalidArgument(number_text(record.sample_rate_hz) + " samples a second: expected " +
                              number_text(rate) + ", as in the first record");
    }
  }
  return rate;
}

std::vector<Hit> used_of(const HitSearch& search) {
  std::vector<Hit> used;
  for (const Hit& hit : search.hits) {
    if (hit.fault == HitFault::kNone) used.push_back(hit);
  }
  return used;
}

// All columns with parts of one length: the shortest of theirs.
std::vector<HitSearch> search_all(const std::vector<TapColumn>& columns, HitChoice choice, double rate) {
  std::vector<HitSearch> searches;
  Index least = 0;
  for (const TapColumn& column : columns) {
    searches.push_back(find_hits(column.records, choice));
    const Index length = searches.back().length;
    if (length > 0 && (least == 0 || length < least)) least = length;
  }
  if (choice.length_s) return searches;
  choice.length_s = static_cast<double>(least) / rate;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (searches[c].length > least) searches[c] = find_hits(columns[c].records, choice);
  }
  return searches;
}

std::vector<HitSpectrum> spectra_of(const TapColumn& column, const HitSearch& search, Index length,
                                    Index lines, const Windows& windows) {
  std::vector<HitSpectrum> spectra;
  for (const Hit& hit : used_of(search)) {
    spectra.push_back(hit_spectrum(column.records[hit.record], hit, length, lines,
                                   search.offset_n[hit.record], search.noise_n[hit.record], windows));
  }
  return spectra;
}

void add_column(dynamics::FrequencyResponse& frf, const TapColumn& column, const AveragedColumn& averaged,
                double hits, Index lines) {
  for (std::size_t c = 0; c < column.responses.size(); ++c) {
    dynamics::FrequencyResponseEntry entry;
    entry.response = column.responses[c];
    entry.reference = column.reference;
    entry.h = averaged.h[c].head(lines);
    if (hits > 1) {
      entry.variance = averaged.covariance[AveragedColumn::pair(c, c)].real().head(lines);
      entry.coherence = averaged.coherence[c].head(lines);
      entry.averages = hits;
      for (std::size_t b = 0; b < c; ++b) {
        frf.covariances.push_back({column.responses[c], column.responses[b], column.reference,
                                   averaged.covariance[AveragedColumn::pair(c, b)].head(lines)});
      }
    }
    frf.entries.push_back(std::move(entry));
  }
}

}  // namespace

TapCampaign responses_of(const std::vector<TapColumn>& columns, dynamics::Quantity quantity,
                         const TapChoice& choice, std::vector<std::vector<Hit>>* found) {
  const double rate = common_rate(columns);
  const std::vector<HitSearch> searches = search_all(columns, choice.hits, rate);
  TapCampaign campaign;
  for (const HitSearch& search : searches) campaign.hits.push_back(search.hits);
  if (found) *found = campaign.hits;
  Index length = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (used_of(searches[c]).empty())
      throw NoAnswer("force along " + columns[c].reference + ": no hit that can be used");
    length = searches[c].length;
  }
  length = transform_length(length);
  Index lines = static_cast<Index>(std::floor(kHighestLine * static_cast<double>(length)));
  campaign.force_window = choice.force_window.value_or(false);
  for (std::size_t c = 0; c < columns.size() && !choice.force_window; ++c)
    campaign.force_window =
        campaign.force_window || force_disturbed(columns[c].records, searches[c], length, lines);
  Windows windows{choice.decay_per_s.value_or(0),
                  campaign.force_window ? ForceWindow::kPulse : ForceWindow::kNone};
  if (!choice.decay_per_s) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      windows.decay_per_s =
          std::max(windows.decay_per_s, needed_decay(columns[c].records, used_of(searches[c]), length));
  }
  std::vector<std::vector<HitSpectrum>> spectra;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    spectra.push_back(spectra_of(columns[c], searches[c], length, lines, windows));
    const Index with_force = lines_with_force(spectra.back());
    campaign.ends_with_force = campaign.ends_with_force || with_force < lines;
    lines = std::min(lines, with_force);
  }
  if (lines < kLeastLines) throw NoAnswer("the hits' force does not stand out of its noise");
  campaign.length_s = static_cast<double>(length) / rate;
  campaign.frf.quantity = quantity;
  campaign.frf.window_decay_per_s = windows.decay_per_s;
  campaign.frf.frequency_hz =
      Eigen::ArrayXd::LinSpaced(lines, 1, static_cast<double>(lines)) * (rate / static_cast<double>(length));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    campaign.used.push_back(static_cast<double>(spectra[c].size()));
    add_column(campaign.frf, columns[c], average(spectra[c], choice.estimator), campaign.used.back(), lines);
  }
  return campaign;
}

}  // namespace stablecut::taps
