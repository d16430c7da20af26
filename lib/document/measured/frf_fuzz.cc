// Random inputs to the readers of measurements: whatever the bytes, a reader returns or throws DataError.
// Built once for each form, by scripts/fuzz.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/error.h"
#include "document/kinds/frf_json.h"
#include "document/measured/frf_import.h"
#include "document/measured/frf_uff.h"
#include "document/measured/frf_uff_writer.h"
#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  Input input{{"f", std::string(reinterpret_cast<const char*>(bytes), size)}, nullptr};
  std::vector<Remark> remarks;
  try {
    const FrfForm form = FrfForm::STABLECUT_FUZZ_FORM;
    if (form == FrfForm::kJson) input.document = parse_json(input.source);
    FrfChoice choice;
    choice.form = form;
    const dynamics::FrequencyResponse frf = import_frf(input, choice, remarks);
    if (frf.entries.empty() || frf.frequency_hz.size() == 0) std::abort();
    for (const auto& entry : frf.entries) {
      if (entry.h.size() != frf.frequency_hz.size() || !entry.h.allFinite()) std::abort();
    }
    json_text(frf_to_json(frf));
    // What was read can be written and read again, to the last bit.
    const std::string binary = frf_to_universal_file(frf, UniversalForm::kBinary);
    const dynamics::FrequencyResponse again = frf_from_universal_file({"again", binary}, {}, remarks);
    if (again.frequency_hz != frf.frequency_hz || again.entries.size() != frf.entries.size()) std::abort();
    for (std::size_t e = 0; e < frf.entries.size(); ++e) {
      if (again.entries[e].h != frf.entries[e].h) std::abort();
    }
    frf_from_universal_file({"again", frf_to_universal_file(frf, UniversalForm::kText)}, {}, remarks);
  } catch (const DataError&) {
  } catch (const InvalidArgument&) {
    // A direction that a universal file does not know.
  }
  return 0;
}
