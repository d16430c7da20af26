#include "taps/hit_search.h"

#include <algorithm>
#include <cmath>

#include "taps/overload.h"

namespace stablecut::taps {
namespace {

constexpr double kWeakShare = 0.2;       // of the others' force: 1/25 of their weight in an average
constexpr double kDoubleShare = 0.5;     // of the length: a second blow that comes sooner is part of the hit
constexpr double kDeliberate = 0.2;      // s: nobody strikes twice on purpose within
constexpr Eigen::Index kPreReaches = 2;  // of a pulse, before it: what the force window keeps

using Index = Eigen::Index;

// A pulse with what is free of other pulses from its part's beginning on.
struct Candidate {
  std::size_t record;
  Pulse pulse;
  Index from;  // of its part
  Index room;  // samples until the next pulse and what filters ring before it, or the record's end
};

std::vector<Candidate> candidates_of(const std::vector<Record>& records,
                                     const std::vector<ForcePulses>& found, const HitChoice& choice) {
  std::vector<Candidate> candidates;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const auto& pulses = found[r].pulses;
    for (std::size_t p = 0; p < pulses.size(); ++p) {
      const Index wanted =
          choice.pre_trigger_s
              ? static_cast<Index>(std::lround(*choice.pre_trigger_s * records[r].sample_rate_hz))
              : kPreReaches * pulses[p].reach();
      const Index before = p == 0 ? 0 : pulses[p - 1].to;
      const Index from = std::max(before, pulses[p].from - wanted);
      const Index next = p + 1 < pulses.size() ? pulses[p + 1].from - kPreReaches * pulses[p + 1].reach()
                                               : records[r].samples();
      candidates.push_back({r, pulses[p], from, next - from});
    }
  }
  return candidates;
}

// Pulses of one hit: each sooner than `near` samples after the one before.
std::vector<std::vector<Candidate>> hits_of(const std::vector<Candidate>& candidates, double near) {
  std::vector<std::vector<Candidate>> hits;
  bool goes_on = false;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!goes_on) hits.emplace_back();
    hits.back().push_back(candidates[i]);
    goes_on = i + 1 < candidates.size() && candidates[i + 1].record == candidates[i].record &&
              static_cast<double>(candidates[i].room) < near;
  }
  return hits;
}

// The length with which most of the samples are used: the largest product with the number of hits that have
// it. Room beyond the middle one's does not count, so that a long silence outweighs no hits.
Index best_length(const std::vector<std::vector<Candidate>>& hits) {
  std::vector<Index> rooms;
  rooms.reserve(hits.size());
  for (const auto& together : hits) rooms.push_back(together.back().room);
  std::sort(rooms.begin(), rooms.end(), std::greater<>());
  const Index middle = rooms[rooms.size() / 2];
  Index best = 0;
  double most = 0;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const Index room = std::min(rooms[i], middle);
    const double used = static_cast<double>(i + 1) * static_cast<double>(room);
    if (!(used > most)) continue;
    most = used;
    best = room;
  }
  return best;
}

// The force above which half of all force squared lies: small bumps, however many, do not move it.
double usual_force(const std::vector<Candidate>& candidates) {
  std::vector<double> forces;
  double all = 0;
  for (const Candidate& candidate : candidates) {
    forces.push_back(std::abs(candidate.pulse.force_n));
    all += forces.back() * forces.back();
  }
  std::sort(forces.begin(), forces.end(), std::greater<>());
  double sum = 0;
  for (const double force : forces) {
    sum += force * force;
    if (sum >= all / 2) return force;
  }
  return 0;
}

// Pulses that belong together, as one hit: its largest pulse.
Hit hit_of(const std::vector<Candidate>& together, double rate) {
  const auto by_force = [](const Candidate& a, const Candidate& b) {
    return std::abs(a.pulse.force_n) < std::abs(b.pulse.force_n);
  };
  const auto main = std::max_element(together.begin(), together.end(), by_force);
  Hit hit{main->record, main->pulse, main->from};
  hit.seconds = static_cast<double>(together.back().room) / rate;
  if (together.size() == 1) return hit;
  hit.fault = HitFault::kDouble;
  const auto other = main == together.begin() ? main + 1 : main - 1;
  hit.seconds = static_cast<double>(std::abs(other->pulse.peak - main->pulse.peak)) / rate;
  return hit;
}

// [records][channels], the force first.
std::vector<std::vector<ChannelRange>> ranges_of(const std::vector<Record>& records) {
  std::vector<std::vector<ChannelRange>> ranges;
  for (const Record& record : records) {
    auto& own = ranges.emplace_back();
    if (record.samples() == 0) continue;
    own.push_back(range_of(record.force));
    for (const Eigen::VectorXd& response : record.responses) own.push_back(range_of(response));
  }
  return ranges;
}

void judge(Hit& hit, const Record& record, const std::vector<ChannelRange>& ranges, double usual,
           Index length) {
  if (hit.fault != HitFault::kNone) return;
  const Index end = std::min(record.samples(), hit.from + length);
  for (std::size_t c = 0; c <= record.responses.size(); ++c) {
    const Eigen::VectorXd& channel = c == 0 ? record.force : record.responses[c - 1];
    if (!overloaded(channel, ranges[c], hit.from, end)) continue;
    hit.fault = HitFault::kOverload;
    hit.channel = c;
    return;
  }
  if (std::abs(hit.pulse.force_n) < kWeakShare * usual)
    hit.fault = HitFault::kWeak;
  else if (hit.seconds * record.sample_rate_hz + 0.5 < static_cast<double>(length))
    hit.fault = HitFault::kShort;
}

}  // namespace

HitSearch find_hits(const std::vector<Record>& records, const HitChoice& choice) {
  HitSearch search;
  std::vector<ForcePulses> found;
  for (const Record& record : records) {
    found.push_back(force_pulses(record.force, choice.trigger_n.value_or(0)));
    search.noise_n.push_back(found.back().noise_n);
    search.offset_n.push_back(found.back().offset_n);
  }
  const std::vector<Candidate> candidates = candidates_of(records, found, choice);
  if (candidates.empty()) return search;
  const double rate = records.front().sample_rate_hz;
  const double at_once = choice.length_s ? 0 : kDeliberate * rate;
  search.length = choice.length_s ? static_cast<Index>(std::lround(*choice.length_s * rate))
                                  : best_length(hits_of(candidates, at_once));
  const double usual = usual_force(candidates);
  const auto ranges = ranges_of(records);
  const double near = std::max(at_once, kDoubleShare * static_cast<double>(search.length));
  for (const auto& together : hits_of(candidates, near)) {
    search.hits.push_back(hit_of(together, rate));
    const std::size_t record = together.front().record;
    judge(search.hits.back(), records[record], ranges[record], usual, search.length);
  }
  return search;
}

}  // namespace stablecut::taps
