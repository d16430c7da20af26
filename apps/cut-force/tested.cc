#include "tested.h"

#include "base/error.h"
#include "document/kinds/modal_table_json.h"
#include "words.h"

namespace stablecut {
namespace {

// Cuts as improbable as that are refused.
constexpr double kContradiction = 1e-3;

}  // namespace

void learn_from_tested_cuts(const dynamics::ModalModel& model, const document::Source& source, int threads,
                            const Progress& progress, document::TestedCutDocument& document) {
  const milling::Cutter& cutter = document.prior.cutter;
  const milling::SampledCut mean{document::tip_structure_of(model, source, cutter.is_axial()), cutter};
  const std::vector<milling::TestedCut> cuts = document::tested_cuts(document.cuts);
  std::vector<bool> observed;
  for (const milling::TestedCut& cut : cuts) observed.push_back(*cut.observed_stable);
  // The samples are judged in two halves.
  double done = 0;
  const auto judge = [&](const std::vector<milling::SampledCut>& samples) {
    milling::Verdicts verdicts =
        milling::verdicts_of(samples, mean, cuts, threads, [&](double share) { progress(done + share / 2); });
    done = 0.5;
    return verdicts;
  };
  document.posterior = milling::coefficient_posterior(model, cutter, document.prior.deviations, observed,
                                                      judge, document.request);
  if (document.posterior.as_unlikely_share < kContradiction)
    throw NoAnswer(contradiction_text(document.posterior, document.request, observed.size()));
}

}  // namespace stablecut
