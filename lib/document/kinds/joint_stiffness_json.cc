#include "document/kinds/joint_stiffness_json.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "document/kinds/joints_json.h"

namespace stablecut::document {
namespace {

constexpr Bound kStiffness{.least = 0, .open_least = true, .words = "a stiffness above 0 N m/rad, or null"};
constexpr Bound kCompliance{.least = 0, .words = "a compliance not below 0, or null"};
constexpr double kCovarianceRounding = 1e-6;  // of a correlation

// Six items, each null or what `read` makes of it.
template <typename Read>
void for_each_known(const Node& node, const Read& read) {
  const auto items = node.items();
  if (items.size() != robot::kJoints) node.fail("expected 6 numbers, null where unknown");
  for (std::size_t j = 0; j < robot::kJoints; ++j) {
    if (!items[j].is_null()) read(j, items[j]);
  }
}

// The stiffness of another robot is none of this one's.
void check_joint_names(const Node& joints, const robot::Robot& robot) {
  const auto items = joints.items();
  if (items.size() != robot::kJoints) joints.fail("expected 6 names of joints");
  for (std::size_t j = 0; j < robot::kJoints; ++j) {
    const std::string& name = robot.joints[j].name;
    if (items[j].text() != name)
      items[j].fail("expected \"" + name + "\", as in the robot document: is it this robot's?");
  }
}

robot::Spring spring_from(const Node& name, const robot::Robot& robot, robot::Spring::Kind least_kind) {
  const std::string text = name.text();
  for (int axis = 0; axis < 3; ++axis) {
    const robot::Spring base{robot::Spring::Kind::kBase, 0, axis};
    if (text == spring_name(base, robot)) return base;
    for (int j = 0; j < robot::kJoints; ++j) {
      const robot::Spring turn{axis == 2 ? robot::Spring::Kind::kJoint : robot::Spring::Kind::kBearing, j,
                               axis};
      if (text == spring_name(turn, robot) && turn.kind >= least_kind) return turn;
    }
  }
  name.fail("expected base.x, base.y, base.z, or a joint's name with .x or .y" +
            std::string(least_kind == robot::Spring::Kind::kJoint ? " or .z" : ""));
}

// Where a spring stands among the joints and the others; the size of all where it does not.
Eigen::Index place_of(const robot::JointStiffness& joints, const robot::Spring& spring) {
  if (spring.kind == robot::Spring::Kind::kJoint) return spring.joint;
  return robot::kJoints +
         (std::find(joints.others.begin(), joints.others.end(), spring) - joints.others.begin());
}

Eigen::Index size_of(const robot::JointStiffness& joints) {
  return robot::kJoints + static_cast<Eigen::Index>(joints.others.size());
}

bool is_known(const robot::JointStiffness& joints, Eigen::Index spring) {
  return spring < robot::kJoints ? joints.stiffness[spring].has_value()
                                 : joints.other_compliance[spring - robot::kJoints].has_value();
}

// The springs after the joints, with their deviations in the diagonal of `deviations`.
void read_springs(const Node& root, const robot::Robot& robot, robot::JointStiffness& joints,
                  std::vector<std::optional<double>>& deviations) {
  std::string model = "three-axis";
  const auto stated = root.find("model");
  if (stated) model = stated->word({"joints", "base", "three-axis"});
  const auto list = root.find("springs");
  if (!list) {
    if (model != "joints" && stated) static_cast<void>(root.at("springs"));
    return;
  }
  const auto items = list->items();
  for (const Node& item : items) {
    item.check_names({"name", "compliance_m_per_n", "compliance_rad_per_n_m", "std_m_per_n",
                      "std_rad_per_n_m", "interval_95_m_per_n", "interval_95_rad_per_n_m", "identifiable",
                      "reason"});
    const Node name = item.at("name");
    const robot::Spring spring = spring_from(name, robot, robot::Spring::Kind::kBearing);
    const bool of_base = spring.kind == robot::Spring::Kind::kBase;
    if (model == "joints" || (model == "base" && !of_base))
      name.fail("expected no such spring in the model " + model);
    if (place_of(joints, spring) != size_of(joints)) name.fail("expected each spring once");
    const char* other = of_base ? "compliance_rad_per_n_m" : "compliance_m_per_n";
    if (item.has(other))
      item.at(other).fail(of_base ? "expected compliance_m_per_n for a spring of the base"
                                  : "expected compliance_rad_per_n_m for a bearing");
    const Node compliance = item.at(of_base ? "compliance_m_per_n" : "compliance_rad_per_n_m");
    joints.others.push_back(spring);
    joints.other_compliance.push_back(compliance.is_null() ? std::nullopt
                                                           : std::optional(compliance.number(kCompliance)));
    const auto std = item.find(of_base ? "std_m_per_n" : "std_rad_per_n_m");
    deviations.push_back(std && !std->is_null() ? std::optional(std->number(kNotNegative)) : std::nullopt);
  }
}

// Numbers into the rows and columns that `places` names; nothing where a number or a spring is not known.
void read_matrix(const Node& node, const std::vector<Eigen::Index>& places,
                 const robot::JointStiffness& joints, Eigen::MatrixXd& covariance) {
  const std::string count = std::to_string(places.size());
  const auto rows = node.items();
  if (rows.size() != places.size()) node.fail("expected " + count + " rows");
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (rows[i].is_null()) continue;
    const auto items = rows[i].items();
    if (items.size() != places.size())
      rows[i].fail("expected " + count + " numbers, or null for a row that is not known");
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (items[k].is_null()) continue;
      const double value = items[k].number();
      if (is_known(joints, places[i]) && is_known(joints, places[k]))
        covariance(places[i], places[k]) = value;
    }
  }
  // Springs differ by orders of magnitude and in unit: judged as correlations.
  const Eigen::VectorXd scale = covariance.diagonal().unaryExpr([](double v) {
    return v > 0 ? 1 / std::sqrt(v) : v == 0 ? 1.0 : -1.0;
  });
  const Eigen::MatrixXd correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  if ((correlation - correlation.transpose()).cwiseAbs().maxCoeff() > kCovarianceRounding ||
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(correlation, Eigen::EigenvaluesOnly).eigenvalues()[0] <
          -kCovarianceRounding) {
    node.fail("expected a covariance matrix: symmetric, without negative eigenvalues");
  }
}

// Of all springs, else of the joints with the others' deviations, else deviations alone.
void read_covariance(const Node& root, const robot::Robot& robot,
                     const std::vector<std::optional<double>>& deviations, robot::JointStiffness& joints) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size_of(joints), size_of(joints));
  std::vector<Eigen::Index> places;
  if (const auto all = root.find("spring_covariance"); all && !all->is_null()) {
    for (const Node& name : all->at("springs").items()) {
      const Eigen::Index place = place_of(joints, spring_from(name, robot, robot::Spring::Kind::kJoint));
      if (place == size_of(joints)) name.fail("expected a spring of this document");
      if (std::find(places.begin(), places.end(), place) != places.end())
        name.fail("expected each spring once");
      places.push_back(place);
    }
    read_matrix(all->at("matrix"), places, joints, covariance);
    joints.errors.covariance = covariance;
    return;
  }
  bool known = false;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    if (!deviations[i] || !joints.other_compliance[i]) continue;
    const auto place = robot::kJoints + static_cast<Eigen::Index>(i);
    covariance(place, place) = *deviations[i] * *deviations[i];
    known = true;
  }
  if (const auto matrix = root.find("covariance_compliance"); matrix && !matrix->is_null()) {
    for (int j = 0; j < robot::kJoints; ++j) places.push_back(j);
    read_matrix(*matrix, places, joints, covariance);
    known = true;
  } else if (const auto std = root.find("std_n_m_per_rad"); std && !std->is_null()) {
    for_each_known(*std, [&](std::size_t j, const Node& value) {
      const double deviation = value.number(kNotNegative);
      if (joints.stiffness[j]) covariance(j, j) = std::pow(deviation / std::pow(*joints.stiffness[j], 2), 2);
    });
    known = true;
  }
  if (known) joints.errors.covariance = covariance;
}

robot::Discrepancy discrepancy_from(const Node& node) {
  node.check_names({"relative", "absolute_um", "force_n"});
  robot::Discrepancy discrepancy;
  discrepancy.relative = node.at("relative").number(kNotNegative);
  discrepancy.absolute_m = node.at("absolute_um").number(kNotNegative) * 1e-6;
  if (const auto force = node.find("force_n")) discrepancy.force_n = force->number(kNotNegative);
  return discrepancy;
}

// The ends of the intervals of joints that have no stiffness.
void read_least_stiffness(const Node& intervals, robot::JointStiffness& joints) {
  for_each_known(intervals, [&](std::size_t j, const Node& interval) {
    if (joints.stiffness[j]) return;
    const auto ends = interval.items();
    if (ends.size() != 2) interval.fail("expected two numbers, null for an end that is open");
    if (!ends[0].is_null()) joints.least[j] = ends[0].number(kNotNegative);
  });
}

}  // namespace

std::string spring_name(const robot::Spring& spring, const robot::Robot& robot) {
  const std::string axis = std::string(".") + "xyz"[spring.axis];
  return (spring.kind == robot::Spring::Kind::kBase ? "base" : robot.joints[spring.joint].name) + axis;
}

const char* model_name(robot::ElasticModel model) {
  switch (model) {
    case robot::ElasticModel::kJointsOnly:
      return "joints";
    case robot::ElasticModel::kBase:
      return "base";
    case robot::ElasticModel::kThreeAxis:
      break;
  }
  return "three-axis";
}

robot::JointStiffness joint_stiffness_from_json(const Json& document, const Source& source,
                                                const robot::Robot& robot) {
  const Node root = document_root(document, source, "joint-stiffness");
  root.check_document_names({"joints",
                             "model",
                             "stiffness_n_m_per_rad",
                             "interval_95_n_m_per_rad",
                             "std_n_m_per_rad",
                             "identifiable",
                             "reasons",
                             "springs",
                             "spring_covariance",
                             "models",
                             "rank",
                             "condition_number",
                             "residual_rms_um",
                             "residual_rms_rad",
                             "covariance_compliance",
                             "discrepancy",
                             "model_error",
                             "cross_validation",
                             "degrees_of_freedom",
                             "chi_square_per_dof",
                             "loss",
                             "components",
                             "samples",
                             "outliers",
                             "applied",
                             "hypotheses"});
  if (const auto names = root.find("joints")) check_joint_names(*names, robot);
  robot::JointStiffness joints;
  for_each_known(root.at("stiffness_n_m_per_rad"),
                 [&](std::size_t j, const Node& value) { joints.stiffness[j] = value.number(kStiffness); });
  if (const auto intervals = root.find("interval_95_n_m_per_rad"); intervals && !intervals->is_null())
    read_least_stiffness(*intervals, joints);
  std::vector<std::optional<double>> deviations;
  read_springs(root, robot, joints, deviations);
  read_covariance(root, robot, deviations, joints);
  if (const auto discrepancy = root.find("discrepancy"); discrepancy && !discrepancy->is_null())
    joints.errors.discrepancy = discrepancy_from(*discrepancy);
  return joints;
}

}  // namespace stablecut::document
