#include "table_options.h"

#include "cli/exit_status.h"
#include "document/kinds/modal_table_json.h"
#include "document/kinds/mode_comparison_json.h"
#include "document/kinds/mode_labels.h"
#include "document/text/data_error.h"
#include "dynamics/mode_comparison.h"

namespace stablecut {

void TableOptions::declare(CLI::App& app) {
  declared_ = {
      app.add_option("--compare", compared_path_,
                     "Read a modal table, and write how it compares with this one: pairs, differences, "
                     "assurance criteria")
          ->type_name("FILE"),
      app.add_option("--track", reference_path_,
                     "Read a modal table, and write it with the labels of this one's modes")
          ->type_name("FILE")};
}

void TableOptions::check() const {
  cli::refuse_if(!compared_path_.empty() && !reference_path_.empty(), "--track: expected without --compare");
}

document::Json TableOptions::result(const document::Input& table, const document::Input& other) const {
  const dynamics::ModalModel own = document::modal_table_from_json(table.document, table.source);
  const dynamics::ModalModel second = document::modal_table_from_json(other.document, other.source);
  try {
    if (!compared_path_.empty())
      return document::mode_comparison_to_json(dynamics::compare_modes(own, second),
                                               {own, document::mode_labels(table.document)},
                                               {second, document::mode_labels(other.document)});
    document::Json labelled =
        document::with_labels_of(other.document, table.document, dynamics::compare_modes(second, own));
    labelled.erase("provenance");
    return labelled;
  } catch (const InvalidArgument& error) {
    throw document::DataError(other.source.name, "/dofs", "", error.what());
  }
}

}  // namespace stablecut
