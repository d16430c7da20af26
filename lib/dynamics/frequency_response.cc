#include "dynamics/frequency_response.h"

#include <cmath>
#include <complex>

#include "base/error.h"
#include "base/units.h"

namespace stablecut {

const FrequencyResponseEntry* FrequencyResponse::find(std::string_view response,
                                                      std::string_view reference) const {
  for (const auto& entry : entries) {
    if (entry.response == response && entry.reference == reference) return &entry;
  }
  return nullptr;
}

FrequencyResponse to_receptance(FrequencyResponse frf) {
  const int order = static_cast<int>(frf.quantity);
  if (order == 0) return frf;
  if (frf.frequency_hz.size() > 0 && frf.frequency_hz.minCoeff() <= 0) {
    throw InvalidArgument("frequency 0 Hz: expected lines above 0 Hz to convert to a receptance");
  }
  for (Eigen::Index line = 0; line < frf.frequency_hz.size(); ++line) {
    const double omega = rad_per_s_from_hz(frf.frequency_hz[line]);
    const std::complex<double> divisor =
        order == 1 ? std::complex<double>(0, omega) : std::complex<double>(-omega * omega, 0);
    for (auto& entry : frf.entries) {
      entry.h[line] /= divisor;
      if (entry.variance.size() > 0) entry.variance[line] /= std::norm(divisor);
    }
  }
  frf.quantity = Quantity::kReceptance;
  return frf;
}

FrequencyResponse within_band(const FrequencyResponse& frf, double lo_hz, double hi_hz) {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
  for (Eigen::Index line = 0; line < frf.frequency_hz.size(); ++line) {
    if (frf.frequency_hz[line] < lo_hz) first = line + 1;
    if (frf.frequency_hz[line] >= lo_hz && frf.frequency_hz[line] <= hi_hz) ++count;
  }
  FrequencyResponse part = frf;
  part.frequency_hz = frf.frequency_hz.segment(first, count).eval();
  for (auto& entry : part.entries) {
    entry.h = entry.h.segment(first, count).eval();
    if (entry.variance.size() > 0) entry.variance = entry.variance.segment(first, count).eval();
    if (entry.coherence.size() > 0) entry.coherence = entry.coherence.segment(first, count).eval();
  }
  return part;
}

}  // namespace stablecut
