#include "document/kinds/modal_table_json.h"

#include <algorithm>
#include <set>

#include "document/kinds/frf_json.h"
#include "document/text/data_error.h"
#include "document/text/node.h"
#include "dynamics/mode_comparison.h"

namespace stablecut::document {
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
  Eigen::VectorXcd psi(dofs);
  for (std::size_t i = 0; i < dofs; ++i) psi[i] = items[i].complex();
  return psi;
}

Json vector_to(const Eigen::VectorXcd& psi) {
  Json list = Json::array();
  for (const auto& value : psi) list.push_back(Json::array({value.real(), value.imag()}));
  return list;
}

// Names of a mode's parameters in the order of a covariance.
std::vector<std::string> parameter_names(std::size_t dofs) {
  std::vector<std::string> names = {"frequency_hz", "damping_ratio"};
  for (const char* vector : {"psi_r/", "psi_l/"}) {
    for (std::size_t i = 0; i < dofs; ++i) {
      for (const char* part : {"/re", "/im"}) names.push_back(vector + std::to_string(i) + part);
    }
  }
  return names;
}

// "/modes/0/psi_r/1/re" and the like, for all modes in the order of a covariance.
std::vector<std::string> parameter_pointers(const dynamics::ModalModel& model) {
  std::vector<std::string> pointers;
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    for (const std::string& name : parameter_names(model.dofs.size()))
      pointers.push_back("/modes/" + std::to_string(k) + "/" + name);
  }
  return pointers;
}

// For each parameter of a mode: -1 where it belongs to a dof that the document names with a minus, else 1.
Eigen::VectorXd parameter_signs(const std::vector<double>& of_dofs) {
  const Eigen::Index dofs = of_dofs.size();
  Eigen::VectorXd signs = Eigen::VectorXd::Ones(2 + 4 * dofs);
  for (Eigen::Index i = 0; i < 2 * dofs; ++i) signs.segment<2>(2 + 2 * i).setConstant(of_dofs[i % dofs]);
  return signs;
}

// Parameters that the document does not list are taken as exact.
Eigen::MatrixXd covariance_from(const Node& node, const dynamics::ModalModel& model,
                                const std::vector<double>& signs) {
  const std::vector<std::string> known = parameter_pointers(model);
  std::vector<Eigen::Index> at;
  for (const Node& item : node.at("parameters").items()) {
    const auto found = std::find(known.begin(), known.end(), item.text());
    const Eigen::Index index = found - known.begin();
    if (found == known.end() || std::find(at.begin(), at.end(), index) != at.end())
      item.fail("expected the pointer of a number in /modes, as /modes/0/psi_r/1/re, each once");
    at.push_back(index);
  }
  const Eigen::VectorXd sign = parameter_signs(signs).replicate(model.modes.size(), 1);
  const auto rows = node.at("matrix").items();
  const Eigen::Index size = at.size();
  if (rows.size() != at.size())
    node.at("matrix").fail("expected " + std::to_string(at.size()) + " rows, one for each of the parameters");
  const Eigen::Index count = known.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Eigen::VectorXd row = rows[i].numbers();
    if (row.size() != size)
      rows[i].fail("expected " + std::to_string(size) + " numbers, one for each parameter");
    if (row[i] < 0) rows[i].fail("expected a variance that is not negative");
    for (std::size_t j = 0; j < at.size(); ++j) matrix(at[i], at[j]) = row[j] * sign[at[i]] * sign[at[j]];
  }
  if (!matrix.isApprox(matrix.transpose(), 1e-9)) node.at("matrix").fail("expected a symmetric matrix");
  return matrix;
}

Json covariance_to(const dynamics::ModalModel& model) {
  Json rows = Json::array();
  for (const auto& row : model.covariance.rowwise())
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  return {{"parameters", parameter_pointers(model)}, {"matrix", std::move(rows)}};
}

Json deviation_to(const Eigen::VectorXd& deviation, Eigen::Index dofs) {
  const auto vector = [&](Eigen::Index first) {
    Json list = Json::array();
    for (Eigen::Index i = 0; i < dofs; ++i)
      list.push_back({deviation[first + 2 * i], deviation[first + 2 * i + 1]});
    return list;
  };
  return {{"frequency_hz", deviation[0]},
          {"damping_ratio", deviation[1]},
          {"psi_r", vector(2)},
          {"psi_l", vector(2 + 2 * dofs)}};
}

}  // namespace

dynamics::ModalModel modal_table_from_json(const Json& document, const Source& source,
                                           const std::string& pointer) {
  const Node root = document_root(document, source, "modal-table", pointer);
  root.check_document_names({"dofs", "modes", "fit"});
  dynamics::ModalModel model;
  std::vector<double> sign;  // of "-x"
  for (const Node& dof : root.at("dofs").items(1)) {
    std::string name = dof.text();
    sign.push_back(take_sign(name));
    if (name.empty() || model.dof(name) >= 0) dof.fail("expected direction names, each once");
    model.dofs.push_back(name);
  }
  std::set<std::string> labels;
  for (const Node& item : root.at("modes").items(1)) {
    item.check_names({"frequency_hz", "damping_ratio", "psi_r", "psi_l", "out_of_band", "std", "label",
                      "phase_collinearity", "complexity"});
    if (const auto label = item.find("label")) {
      if (label->text().empty() || !labels.insert(label->text()).second)
        label->fail("expected a name, each once, or no label");
    }
    dynamics::Mode mode;
    mode.frequency_hz = item.at("frequency_hz").number(kFrequency);
    mode.damping_ratio = item.at("damping_ratio").number(kDampingRatio);
    mode.psi_r = vector_from(item.at("psi_r"), model.dofs.size());
    mode.psi_l = vector_from(item.at("psi_l"), model.dofs.size());
    for (std::size_t i = 0; i < sign.size(); ++i) {
      mode.psi_r[i] *= sign[i];
      mode.psi_l[i] *= sign[i];
    }
    if (const auto out = item.find("out_of_band")) mode.out_of_band = out->boolean();
    if (const auto deviation = item.find("std"))
      deviation->check_names({"frequency_hz", "damping_ratio", "psi_r", "psi_l"});
    model.modes.push_back(std::move(mode));
  }
  if (const auto fit = root.find("fit")) {
    if (const auto covariance = fit->find("covariance"))
      model.covariance = covariance_from(*covariance, model, sign);
  }
  return model;
}

milling::TipStructure tip_structure_of(const dynamics::ModalModel& model, const Source& source,
                                       bool is_axial) {
  if (model.dof("x") < 0 && model.dof("y") < 0)
    throw DataError(source.name, "/dofs", Json(model.dofs).dump(), "expected x, y or both");
  milling::TipStructure structure = milling::tip_structure(model, is_axial);
  if (structure.modes() == 0)
    throw DataError(source.name, "/modes", "",
                    "expected at least one mode that a force in x or y drives and that moves x or y");
  return structure;
}

Json modal_table_to_json(const dynamics::ModalModel& model) {
  Json modes = Json::array();
  for (const dynamics::Mode& mode : model.modes) {
    Json item = {{"frequency_hz", mode.frequency_hz},
                 {"damping_ratio", mode.damping_ratio},
                 {"psi_r", vector_to(mode.psi_r)},
                 {"psi_l", vector_to(mode.psi_l)}};
    if (mode.out_of_band) {
      item["out_of_band"] = true;
    } else if (mode.psi_r.size() > 1 && mode.psi_r.norm() > 0) {
      item["phase_collinearity"] = dynamics::phase_collinearity(mode.psi_r);
      item["complexity"] = dynamics::complexity(mode.psi_r);
    }
    if (model.covariance.size() > 0) {
      item["std"] = deviation_to(model.deviation(modes.size()), static_cast<Eigen::Index>(model.dofs.size()));
    }
    modes.push_back(std::move(item));
  }
  Json document = {{"format", "stablecut/modal-table/1"}, {"dofs", model.dofs}, {"modes", std::move(modes)}};
  if (model.covariance.size() > 0) document["fit"]["covariance"] = covariance_to(model);
  return document;
}

}  // namespace stablecut::document
