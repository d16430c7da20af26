// --identify: cutting coefficients from measured forces.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "document/kinds/cut_json.h"
#include "document/kinds/identified_cut_json.h"
#include "document/measured/measured_forces.h"

namespace stablecut {

struct IdentifyRequest {
  bool edges_of_cut = false;  ///< edge forces are those of the cut, or 0
  bool on_workpiece = false;  ///< the forces are those on the workpiece
};

/// The coefficients that explain the forces; those that would be below 0 are held at 0. Throws NoAnswer where
/// Kt or Kr cannot be found.
document::IdentifiedCut identified_cut(const document::Json& document, const document::CutDocument& cut,
                                       std::vector<document::MeasuredForceRow> rows,
                                       const IdentifyRequest& request);

}  // namespace stablecut
