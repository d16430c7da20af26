// The modes of independent groups of directions in one table.
#pragma once

#include <string>
#include <vector>

#include "dynamics/modal_model.h"
#include "modal/fitted_table.h"

namespace stablecut::modal {

/// Adds a group's modes to the table of all directions (`model.dofs`): exact zeros in directions that are not
/// among the group's, and a covariance that is `inflation` times the group's own. Groups are independent of
/// each other.
void add_to_table(const FittedTable& group, const std::vector<std::string>& directions, double inflation,
                  dynamics::ModalModel& model);

/// The same table with its modes by frequency.
dynamics::ModalModel sorted_by_frequency(const dynamics::ModalModel& model);

}  // namespace stablecut::modal
