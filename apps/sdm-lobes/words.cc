#include "words.h"

#include <algorithm>

#include "base/number_text.h"
#include "milling/period.h"

namespace stablecut {
namespace {

// An estimated error of the spectral radius from which on there is a warning.
constexpr double kSuspectError = 2e-5;

}  // namespace

std::vector<std::string> convergence_warnings(const document::LobesDocument& lobes,
                                              const std::string& advice) {
  std::vector<std::string> lines;
  const std::vector<std::string>& failure = lobes.chart.failure;
  const auto failed = [](const std::string& reason) { return !reason.empty(); };
  const auto first = std::find_if(failure.begin(), failure.end(), failed);
  if (first != failure.end())
    lines.push_back(*first + advice + "; speeds without a limit: " +
                    std::to_string(std::count_if(first, failure.end(), failed)));
  const std::string error = number_text(lobes.convergence()) + " of max(1, radius) (see /convergence)";
  const bool spectral = lobes.scheme.method == milling::StabilityMethod::kSpectral;
  if (spectral && lobes.convergence() > kSuspectError)
    lines.push_back("the spectral radius has converged only to " + error);
  if (!spectral && lobes.convergence() > milling::kUseless)
    lines.push_back("the semi-discretization is off by up to " + error + ": more --intervals");
  if (const std::size_t doubtful = lobes.chart.doubtful(); doubtful > 0)
    lines.push_back("spectral radii that are null, since their error leaves open whether they are above 1: " +
                    std::to_string(doubtful) + "; lower the largest depth");
  return lines;
}

}  // namespace stablecut
