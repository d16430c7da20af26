#include "document/modal_table.h"

#include <algorithm>

#include "document/frf.h"
#include "document/node.h"

namespace stablecut {
namespace {

constexpr Bound kDampingRatio{.least = 0,
                              .most = 1,
                              .open_least = true,
                              .open_most = true,
                              .words = "a damping ratio above 0 and below 1"};
constexpr Bound kFrequency{.least = 0, .open_least = true, .words = "a frequency above 0 Hz"};

Eigen::VectorXcd vector_from(const Node& node, std::size_t dofs) {
  const auto items = node.items();
  if (items.size() != dofs)
    node.fail("expected " + std::to_string(dofs) + " complex numbers, one for each of /dofs");
  Eigen::VectorXcd psi(static_cast<Eigen::Index>(dofs));
  for (std::size_t i = 0; i < dofs; ++i) psi[static_cast<Eigen::Index>(i)] = items[i].complex();
  return psi;
}

Json vector_to(const Eigen::VectorXcd& psi) {
  Json list = Json::array();
  for (const auto& value : psi) list.push_back(Json::array({value.real(), value.imag()}));
  return list;
}

}  // namespace

ModalModel modal_table_from_json(const Json& document, const Source& source, const std::string& pointer) {
  const Node root = document_root(document, source, "modal-table", pointer);
  root.check_names({"format", "dofs", "modes", "fit", "provenance"});
  ModalModel model;
  std::vector<double> sign;  // of "-x"
  for (const Node& dof : root.at("dofs").items(1)) {
    std::string name = dof.text();
    sign.push_back(take_sign(name));
    if (name.empty() || model.dof(name) >= 0) dof.fail("expected direction names, each once");
    model.dofs.push_back(name);
  }
  for (const Node& item : root.at("modes").items(1)) {
    item.check_names({"frequency_hz", "damping_ratio", "psi_r", "psi_l", "out_of_band", "std"});
    Mode mode;
    mode.frequency_hz = item.at("frequency_hz").number(kFrequency);
    mode.damping_ratio = item.at("damping_ratio").number(kDampingRatio);
    mode.psi_r = vector_from(item.at("psi_r"), model.dofs.size());
    mode.psi_l = vector_from(item.at("psi_l"), model.dofs.size());
    for (std::size_t i = 0; i < sign.size(); ++i) {
      mode.psi_r[static_cast<Eigen::Index>(i)] *= sign[i];
      mode.psi_l[static_cast<Eigen::Index>(i)] *= sign[i];
    }
    if (const auto out = item.find("out_of_band")) mode.out_of_band = out->boolean();
    if (const auto std_node = item.find("std")) {
      std_node->check_names({"frequency_hz", "damping_ratio", "psi_r", "psi_l"});
      if (std_node->has("frequency_hz") && std_node->has("damping_ratio")) {
        mode.deviation = {std_node->at("frequency_hz").number(kNotNegative),
                          std_node->at("damping_ratio").number(kNotNegative)};
      }
    }
    model.modes.push_back(std::move(mode));
  }
  return model;
}

Json modal_table_to_json(const ModalModel& model) {
  Json modes = Json::array();
  for (const Mode& given : model.modes) {
    const Mode mode = normalised(given);
    Json item = {{"frequency_hz", mode.frequency_hz},
                 {"damping_ratio", mode.damping_ratio},
                 {"psi_r", vector_to(mode.psi_r)},
                 {"psi_l", vector_to(mode.psi_l)}};
    if (mode.out_of_band) item["out_of_band"] = true;
    if (mode.deviation) {
      item["std"] = {{"frequency_hz", mode.deviation->frequency_hz},
                     {"damping_ratio", mode.deviation->damping_ratio}};
    }
    modes.push_back(std::move(item));
  }
  return {{"format", "stablecut/modal-table/1"}, {"dofs", model.dofs}, {"modes", std::move(modes)}};
}

}  // namespace stablecut
