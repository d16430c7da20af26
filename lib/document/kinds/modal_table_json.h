// Kind `modal-table`: non-symmetric complex modes at the tool tip.
#pragma once

#include "document/text/json_text.h"
#include "dynamics/modal_model.h"
#include "milling/structure.h"

namespace stablecut::document {

/// Reads the modes in any scale, from the document that stands at `pointer` in its source; a dof with a sign
/// ("-x") turns its components and loses it. Throws DataError.
dynamics::ModalModel modal_table_from_json(const Json& document, const Source& source,
                                           const std::string& pointer = "");

/// The structure of a table's modes; with z where the cut acts along the axis. Throws DataError where it has
/// none that can chatter.
milling::TipStructure tip_structure_of(const dynamics::ModalModel& model, const Source& source,
                                       bool is_axial);

/// The document without provenance. Modes are written as they are: a tool brings them to the contract's
/// normalisation first. Of `fit` only the covariance is written, if it is known.
Json modal_table_to_json(const dynamics::ModalModel& model);

}  // namespace stablecut::document
