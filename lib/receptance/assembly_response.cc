#include "receptance/assembly_response.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"

namespace stablecut::receptance {

dynamics::FrequencyResponse assembly_response(const Assembly& assembly, const ResponseChoice& choice,
                                              int threads, const Progress& progress) {
  std::vector<std::pair<double, double>> places;  // response, reference
  for (const double a : choice.positions_m) {
    for (const double b : choice.positions_m) places.emplace_back(a, b);
  }
  const std::size_t lines = assembly.frequency_hz.size();
  const std::size_t pairs = std::max<std::size_t>(places.size(), 1);
  std::vector<Receptance<4>> value(lines * pairs);
  parallel_for(
      lines, threads,
      [&](std::size_t i) {
        const Eigen::Index line = i;
        if (places.empty()) value[i] = assembly.tip(line);
        for (std::size_t p = 0; p < places.size(); ++p)
          value[i * pairs + p] = assembly.along_tool(line, places[p].first, places[p].second);
      },
      progress);
  dynamics::FrequencyResponse frf;
  frf.frequency_hz = assembly.frequency_hz;
  const int step = choice.slopes ? 1 : 2;  // through kCoordinates
  for (std::size_t p = 0; p < pairs; ++p) {
    for (int a = 0; a < 4; a += step) {
      for (int b = 0; b < 4; b += step) {
        dynamics::FrequencyResponseEntry entry;
        entry.response = kCoordinates[a];
        entry.reference = kCoordinates[b];
        if (!places.empty()) {
          entry.response_position_m = places[p].first;
          entry.reference_position_m = places[p].second;
        }
        entry.h.resize(assembly.frequency_hz.size());
        for (std::size_t i = 0; i < lines; ++i) {
          const Eigen::Index line = i;
          entry.h[line] = value[i * pairs + p](a, b);
        }
        frf.entries.push_back(std::move(entry));
      }
    }
  }
  return frf;
}

}  // namespace stablecut::receptance
