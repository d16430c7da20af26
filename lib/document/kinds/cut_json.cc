#include "document/kinds/cut_json.h"

#include <cmath>

#include "base/units.h"
#include "document/text/data_error.h"
#include "document/text/node.h"

namespace stablecut::document {
namespace {

constexpr int kMostTeeth = 1000;
constexpr int kMostPoints = 1'000'000;
constexpr double kSameDegrees = 1e-6;
constexpr double kMostLag = 1e5;  // rad/m
constexpr Bound kImmersion{
    .least = 0, .most = 1, .open_least = true, .words = "a radial immersion ae/D above 0 and at most 1"};
constexpr Bound kEngagementAngle{.least = 0, .most = 180, .words = "an angle from 0 to 180 degrees"};
constexpr Bound kLead{
    .least = 0,
    .most = 90,
    .open_least = true,
    .words = "a lead angle above 0 and at most 90 degrees, from the plane normal to the axis"};
constexpr Bound kDepth{.least = 0, .most = kMostDepthMm, .words = "a depth from 0 to 10000 mm"};
constexpr Bound kDiameter{
    .least = 0, .most = kMostDepthMm, .open_least = true, .words = "a diameter above 0, of at most 10000 mm"};
constexpr Bound kCorrelation{.least = -1, .most = 1, .words = "a correlation from -1 to 1"};
constexpr Bound kHelix{.least = -90,
                       .most = 90,
                       .open_least = true,
                       .open_most = true,
                       .words = "a helix angle between -90 and 90 degrees"};

Range chart_range(const Node& node, const Bound& bound) {
  node.check_names({"from", "to", "count"});
  Range range{node.at("from").number(bound), node.at("to").number(bound), kDefaultChartCount};
  if (const auto count = node.find("count"))
    range.count = count->integer(1, kMostPoints);
  else if (range.from == range.to)
    range.count = 1;
  if (range.count == 1 ? range.from != range.to : !(range.from < range.to)) {
    node.at("to").fail(range.count == 1 ? "expected the same number as from, since count is 1"
                                        : "expected a number above from");
  }
  return range;
}

void read_engagement(const Node& root, milling::Cutter& cutter) {
  if (root.has("radial_immersion")) {
    if (root.has("entry_deg") || root.has("exit_deg")) {
      root.at("radial_immersion")
          .fail("expected either radial_immersion with milling or entry_deg with exit_deg");
    }
    const bool up = root.at("milling").word({"up", "down"}) == "up";
    milling::set_immersion(cutter, up, root.at("radial_immersion").number(kImmersion));
    return;
  }
  if (!root.has("entry_deg") && !root.has("exit_deg")) root.at("radial_immersion");
  if (const auto milling = root.find("milling")) milling->word({"up", "down"});
  const double entry = root.at("entry_deg").number(kEngagementAngle);
  const double exit = root.at("exit_deg").number(kEngagementAngle);
  if (!(entry < exit)) root.at("exit_deg").fail("expected an angle above entry_deg");
  cutter.entry_rad = radians_from_degrees(entry);
  cutter.exit_rad = radians_from_degrees(exit);
}

// One angle, or one for each tooth.
void read_helix(const Node& helix, const Node& root, milling::Cutter& cutter) {
  const Eigen::VectorXd angles =
      helix.json().is_array() ? helix.numbers(kHelix) : Eigen::VectorXd::Constant(1, helix.number(kHelix));
  if (helix.json().is_array() && angles.size() != cutter.teeth)
    helix.fail("expected " + std::to_string(cutter.teeth) + " angles, one for each tooth");
  if (angles.isZero(0)) return;
  if (!root.has("diameter_mm")) helix.fail("expected diameter_mm beside a helix angle");
  std::vector<double> lags;
  for (const double angle : angles) {
    lags.push_back(2 * std::tan(radians_from_degrees(angle)) / cutter.diameter_m);
    if (std::abs(lags.back()) > kMostLag)
      helix.fail("expected an edge that turns by less than 100 rad in a mm of depth");
  }
  if ((angles.array() == angles[0]).all()) {
    cutter.lag_rad_per_m = lags[0];
    return;
  }
  for (const char* other : {"corner_radius_mm", "runout_um"})
    if (root.has(other)) helix.fail(std::string("expected one angle where there is ") + other);
  cutter.tooth_lag_rad_per_m = lags;
  if (cutter.equal_pitch()) cutter.pitch_rad.assign(lags.size(), cutter.mean_pitch_rad());
}

// Pitches that are equal need no schedule for each tooth.
void read_edges(const Node& root, milling::Cutter& cutter) {
  if (const auto lead = root.find("lead_angle_deg"); lead && lead->number(kLead) != 90)
    cutter.lead_rad = radians_from_degrees(lead->number(kLead));
  if (const auto corner = root.find("corner_radius_mm")) {
    cutter.corner_radius_m = metres_from_mm(corner->number(kNotNegative));
    if (root.has("diameter_mm") && cutter.corner_radius_m > cutter.diameter_m / 2)
      corner->fail("expected at most half of diameter_mm");
  }
  if (const auto pitch = root.find("pitch_deg")) {
    const Eigen::VectorXd angles = pitch->numbers(kPositive);
    if (angles.size() != cutter.teeth)
      pitch->fail("expected " + std::to_string(cutter.teeth) + " angles, one for each tooth");
    if (std::abs(angles.sum() - 360) > kSameDegrees) pitch->fail("expected angles that sum to 360 degrees");
    if ((angles.array() - 360.0 / cutter.teeth).abs().maxCoeff() > kSameDegrees) {
      // Their sum must be one turn to the last digit.
      for (const double angle : angles) cutter.pitch_rad.push_back(kTwoPi * angle / angles.sum());
    }
  }
  if (const auto helix = root.find("helix_deg")) read_helix(*helix, root, cutter);
}

void read_process_damping(const Node& root, milling::Cutter& cutter) {
  const auto damping = root.find("process_damping_n_per_m");
  const auto friction = root.find("process_damping_friction");
  if (damping) {
    cutter.damping_n_per_m = damping->number(kNotNegative);
    if (cutter.damping_n_per_m > 0 && !root.has("diameter_mm"))
      damping->fail("expected diameter_mm beside process damping");
  }
  if (friction) {
    if (!damping) friction->fail("expected process_damping_n_per_m beside it");
    cutter.damping_friction = friction->number(kNotNegative);
  }
}

void read_load(const Node& root, CutDocument& cut) {
  if (const auto feed = root.find("feed_per_tooth_mm")) {
    cut.feed_per_tooth_m = metres_from_mm(feed->number(kPositive));
    if (!root.has("diameter_mm")) feed->fail("expected diameter_mm beside it");
    cut.load.feed_per_tooth_m = *cut.feed_per_tooth_m;
  }
  const auto coefficient = [&](const char* name) {
    const auto node = root.find(name);
    return node ? node->number(kNotNegative) : 0;
  };
  cut.cutter.ka_n_per_m2 = n_per_m2_from_n_per_mm2(coefficient("ka_n_per_mm2"));
  cut.load.kte_n_per_m = n_per_m_from_n_per_mm(coefficient("kte_n_per_mm"));
  cut.load.kre_n_per_m = n_per_m_from_n_per_mm(coefficient("kre_n_per_mm"));
  cut.load.kae_n_per_m = n_per_m_from_n_per_mm(coefficient("kae_n_per_mm"));
  if (const auto runout = root.find("runout_um")) {
    const Eigen::VectorXd radii = runout->numbers();
    if (radii.size() != cut.cutter.teeth)
      runout->fail("expected " + std::to_string(cut.cutter.teeth) + " numbers, one for each tooth");
    if ((radii.array() != radii[0]).any())
      for (const double radius : radii) cut.load.runout_m.push_back(radius * 1e-6);
  }
}

void read_deviations(const Node& root, CutDocument& cut) {
  const auto deviation = [&](const char* name) {
    const auto node = root.find(name);
    return node ? node->number(kNotNegative) : 0;
  };
  cut.deviations.kt_n_per_m2 = n_per_m2_from_n_per_mm2(deviation("kt_std_n_per_mm2"));
  cut.deviations.kr_n_per_m2 = n_per_m2_from_n_per_mm2(deviation("kr_std_n_per_mm2"));
  for (const char* name : {"ka_std_n_per_mm2", "kte_std_n_per_mm", "kre_std_n_per_mm", "kae_std_n_per_mm"})
    deviation(name);  // of the force, not of stability
  if (const auto correlation = root.find("kt_kr_correlation"))
    cut.deviations.correlation = correlation->number(kCorrelation);
}

}  // namespace

CutDocument cut_from_json(const Json& document, const Source& source, CoefficientsNeeded needed) {
  const Node root = document_root(document, source, "cut");
  root.check_document_names({"teeth",
                             "kt_n_per_mm2",
                             "kr_n_per_mm2",
                             "milling",
                             "radial_immersion",
                             "entry_deg",
                             "exit_deg",
                             "feed_angle_deg",
                             "pitch_deg",
                             "helix_deg",
                             "diameter_mm",
                             "chart",
                             "feed_per_tooth_mm",
                             "process_damping_n_per_m",
                             "process_damping_friction",
                             "kt_std_n_per_mm2",
                             "kr_std_n_per_mm2",
                             "ka_n_per_mm2",
                             "lead_angle_deg",
                             "corner_radius_mm",
                             "kte_n_per_mm",
                             "kre_n_per_mm",
                             "kae_n_per_mm",
                             "runout_um",
                             "ka_std_n_per_mm2",
                             "kte_std_n_per_mm",
                             "kre_std_n_per_mm",
                             "kae_std_n_per_mm",
                             "kt_kr_correlation",
                             "identification",
                             "posterior"});
  CutDocument cut;
  cut.cutter.teeth = root.at("teeth").integer(1, kMostTeeth);
  const bool all = needed == CoefficientsNeeded::kAll;
  if (all || root.has("kt_n_per_mm2"))
    cut.cutter.kt_n_per_m2 = n_per_m2_from_n_per_mm2(root.at("kt_n_per_mm2").number(kPositive));
  if (all || root.has("kr_n_per_mm2"))
    cut.cutter.kr_n_per_m2 = n_per_m2_from_n_per_mm2(root.at("kr_n_per_mm2").number(kNotNegative));
  read_engagement(root, cut.cutter);
  if (const auto feed = root.find("feed_angle_deg")) {
    cut.cutter.feed_angle_rad = radians_from_degrees(feed->number());
  }
  if (const auto diameter = root.find("diameter_mm"))
    cut.cutter.diameter_m = metres_from_mm(diameter->number(kDiameter));
  read_edges(root, cut.cutter);
  read_process_damping(root, cut.cutter);
  read_load(root, cut);
  read_deviations(root, cut);
  if (const auto chart = root.find("chart")) {
    chart->check_names({"speed_rpm", "depth_mm"});
    if (const auto speed = chart->find("speed_rpm")) cut.speed_rpm = chart_range(*speed, kPositive);
    if (const auto depth = chart->find("depth_mm")) cut.depth_mm = chart_range(*depth, kDepth);
  }
  return cut;
}

}  // namespace stablecut::document
