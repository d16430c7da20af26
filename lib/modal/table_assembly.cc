#include "modal/table_assembly.h"

#include <algorithm>
#include <numeric>

namespace stablecut::modal {

void add_to_table(const FittedTable& group, const std::vector<std::string>& directions, double inflation,
                  dynamics::ModalModel& model) {
  const Eigen::Index before = model.covariance.rows(), whole = model.parameters_per_mode();
  const auto own = 2 + 4 * static_cast<Eigen::Index>(directions.size());
  std::vector<Eigen::Index> at;  // place of each of the group's parameters in the whole covariance
  for (std::size_t k = 0; k < group.modes.size(); ++k) {
    const dynamics::Mode& mode = group.modes[k];
    dynamics::Mode added = mode;
    added.psi_r = added.psi_l = Eigen::VectorXcd::Zero(model.dofs.size());
    const Eigen::Index first = before + static_cast<Eigen::Index>(k) * whole;
    for (Eigen::Index p = 0; p < own; ++p) at.push_back(first + p);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const Eigen::Index from = i;
      const Eigen::Index to = model.dof(directions[i]);
      added.psi_r[to] = mode.psi_r[from];
      added.psi_l[to] = mode.psi_l[from];
      for (Eigen::Index part = 0; part < 2; ++part) {
        const std::size_t block = k * static_cast<std::size_t>(own);
        at[block + static_cast<std::size_t>(2 + 2 * from + part)] = first + 2 + 2 * to + part;
        at[block + static_cast<std::size_t>(own / 2 + 1 + 2 * from + part)] =
            first + whole / 2 + 1 + 2 * to + part;
      }
    }
    model.modes.push_back(std::move(added));
  }
  const Eigen::Index size = before + static_cast<Eigen::Index>(group.modes.size()) * whole;
  model.covariance.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = 0; j < at.size(); ++j) {
      model.covariance(at[i], at[j]) = inflation * group.covariance(i, j);
    }
  }
}

dynamics::ModalModel sorted_by_frequency(const dynamics::ModalModel& model) {
  std::vector<std::size_t> order(model.modes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return model.modes[a].frequency_hz < model.modes[b].frequency_hz;
  });
  return dynamics::chosen_modes(model, order);
}

}  // namespace stablecut::modal
