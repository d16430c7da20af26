// What readers of documents refuse: a row for each check, with the whole message.
#include <catch2/catch.hpp>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>
#include <string>

#include "document/kinds/assembly_json.h"
#include "document/kinds/cut_json.h"
#include "document/kinds/frf_json.h"
#include "document/kinds/joint_stiffness_json.h"
#include "document/kinds/load_samples_json.h"
#include "document/kinds/modal_table_json.h"
#include "document/kinds/pose_json.h"
#include "document/kinds/robot_json.h"
#include "document/kinds/tool_joint_json.h"
#include "document/kinds/tool_path_json.h"
#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;

namespace {

std::string testdata(const char* name) {
  std::ifstream file(std::string(STABLECUT_TESTDATA) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

const robot::Robot& kr360() {
  static const robot::Robot robot = robot_from_json(Json::parse(testdata("kr360.json")), {"kr360.json", ""});
  return robot;
}

// A document that is read without a complaint, and its reader.
struct Kind {
  std::string good;
  std::function<void(const Json&, const Source&)> read;
};

const std::string kFrf =
    R"({"format": "stablecut/frf/1", "quantity": "receptance", "frequency_hz": [100, 200],
  "h": [{"response": "x", "reference": "x", "re": [1, 2], "im": [3, 4]}, {"response": "y", "reference": "x", "re": [1, 2], "im": [3, 4]}]})";
const std::string kTable =
    R"({"format": "stablecut/modal-table/1", "dofs": ["x", "y"], "modes": [
  {"frequency_hz": 100, "damping_ratio": 0.1, "psi_r": [[1, 0], [1, 0]], "psi_l": [[1, 0], [1, 0]], "label": "a"},
  {"frequency_hz": 200, "damping_ratio": 0.1, "psi_r": [[1, 0], [1, 0]], "psi_l": [[1, 0], [1, 0]]}]})";
const std::string kPose =
    R"({"format": "stablecut/pose/1", "best": {"compliance_um_per_n": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}})";
const std::string kSamples =
    R"({"format": "stablecut/load-samples/1", "samples": [
  {"joints_deg": [0, -90, 90, 0, 45, 0], "force_n": [1, 2, 3], "deflection_mm": [1, 2, 3], "std_mm": 0.1},
  {"joints_deg": [0, -90, 90, 0, 45, 0], "force_n": [1, 2, 3], "deflection_mm": [1, 2, 3], "std_mm": 0.1}]})";
const std::string kStiffness =
    R"({"format": "stablecut/joint-stiffness/1", "stiffness_n_m_per_rad": [6e6, 5e6, 4e6, 3e6, 2e6, null]})";
const std::string kJoint =
    R"({"format": "stablecut/tool-joint/1", "k1_n_per_m": 1e7, "c1_n_s_per_m": 10, "k2_n_m_per_rad": 1e5, "c2_n_m_s_per_rad": 1,
  "std": {"k1_n_per_m": 1e5, "c1_n_s_per_m": 1, "k2_n_m_per_rad": 1e3, "c2_n_m_s_per_rad": null},
  "identifiable": [true, true, true, false], "at_bound": [false, false, false, true]})";

const std::map<std::string, Kind>& kinds() {
  static const std::map<std::string, Kind> kinds = {
      {"assembly",
       {testdata("liu-assembly.json"),
        [](const Json& document, const Source& source) {
          const Eigen::VectorXd lines = assembly_frequencies(document, source);
          assembly_from_json(document, source, lines.head(2), [](const std::string& path) {
            return Input{{path, "1,2,3\n"}, Json()};
          });
        }}},
      {"cut",
       {testdata("thesis-cut.json"),
        [](const Json& document, const Source& source) { cut_from_json(document, source); }}},
      {"frf", {kFrf, [](const Json& document, const Source& source) { frf_from_json(document, source); }}},
      {"joint-stiffness",
       {kStiffness, [](const Json& document,
                       const Source& source) { joint_stiffness_from_json(document, source, kr360()); }}},
      {"load-samples",
       {kSamples,
        [](const Json& document, const Source& source) {
          load_samples_from_json(document, source, kr360(), {true, true, true});
        }}},
      {"modal-table",
       {kTable,
        [](const Json& document, const Source& source) {
          tip_structure_of(modal_table_from_json(document, source), source, false);
        }}},
      {"pose",
       {kPose, [](const Json& document, const Source& source) { tool_compliance(document, source); }}},
      {"robot",
       {testdata("kr360.json"),
        [](const Json& document, const Source& source) { robot_from_json(document, source); }}},
      {"tool-joint",
       {kJoint, [](const Json& document, const Source& source) { tool_joints_from_json(document, source); }}},
      {"tool-path",
       {testdata("zigzag-path.json"),
        [](const Json& document, const Source& source) { tool_path_from_json(document, source, {}); }}},
  };
  return kinds;
}

std::string complaint(const Kind& kind, const Json& document) {
  try {
    kind.read(document, {"f", ""});
  } catch (const DataError& error) {
    return error.what();
  }
  return "read";
}

// Frequency responses inside an assembly, by the word that stands for them.
std::string with_responses(std::string text) {
  const auto put = [&](const std::string& word, const char* patch) {
    Json document = Json::parse(kFrf);
    document.merge_patch(Json::parse(patch));
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word))
      text.replace(at, word.size(), document.dump());
  };
  put("TAP", "{}");
  put("MOBILITY", R"({"quantity": "mobility"})");
  put("SHIFTED", R"({"frequency_hz": [100, 201]})");
  put("WINDOWED", R"({"window_decay_per_s": 2})");
  return text;
}

// A row for each: place | patch | message. What stands at the place is replaced or, where both are objects,
// gets these members (null: loses them); no place is the whole document.
void check_refusals(const std::string& name, const std::string& rows) {
  const Kind& kind = kinds().at(name);
  const Json good = Json::parse(kind.good);
  CHECK(complaint(kind, good) == "read");
  std::istringstream lines(rows);
  std::string row;
  std::getline(lines, row);
  int count = 0;
  for (; std::getline(lines, row); ++count) {
    INFO(name << ": " << row);
    const auto first = row.find(" | "), second = row.find(" | ", first + 3);
    REQUIRE(second != std::string::npos);
    const Json patch = Json::parse(with_responses(row.substr(first + 3, second - first - 3)));
    Json bad = good;
    bad[Json::json_pointer(row.substr(0, first))].merge_patch(patch);
    CHECK(complaint(kind, bad) == "f: " + row.substr(second + 3));
  }
  CHECK(count > 0);
}

}  // namespace

TEST_CASE("what is refused in an assembly") {
  check_refusals("assembly", R"(
/frequency_hz | [] | /frequency_hz: a list of 0: expected at least one frequency
/frequency_hz | [1, 3, 3] | /frequency_hz/2: 3: expected increasing frequencies
/frequency_hz | {"count": 1} | /frequency_hz/to: 5000: expected the same number as from, since count is 1
/frequency_hz | {"to": 1} | /frequency_hz/to: 1: expected a number above from
/materials | [] | /materials: a list of 0: expected an object of materials by name
/tool/segments | [] | /tool/segments: a list of 0: expected a list of at least 1
/tool/segments | 3 | /tool/segments: 3: expected a list
/tool/segments/0/material | "brass" | /tool/segments/0/material: "brass": expected one of /materials
/tool/segments/0 | {"inner_diameter_mm": 12} | /tool/segments/0/inner_diameter_mm: 12: expected less than outer_diameter_mm
/tool/segments/0 | {"equivalent_diameter_mm": 13} | /tool/segments/0/equivalent_diameter_mm: 13: expected at most outer_diameter_mm
/tool/segments/0 | {"flutes": 2, "inner_diameter_mm": 10} | /tool/segments/0/inner_diameter_mm: 10: expected less than the equivalent diameter of the flutes, 9.6 mm
/joint | "soft" | /joint: "soft": expected "rigid"
/joint | {"k1_n_per_m": 0} | /joint/k1_n_per_m: 0: expected a number above 0
/holder | {"modal_table": {}} | /holder/segments: a list of 1: expected either segments and an end, which may hold modal_table or receptances, or one of these alone
/holder | {"sensor_mass_g": 3} | /holder/sensor_mass_g: 3: expected only beside receptances
/holder | {"end": "loose"} | /holder/end: "loose": expected "fixed" or "free"
/holder | {"segments": null, "end": null, "modal_table": {}, "receptances": {}} | /holder/receptances: an object: expected modal_table or receptances, not both
/holder | {"segments": null, "end": null, "modal_table": {}, "artefact": {}} | /holder/artefact: an object: expected only beside receptances
/holder | {"segments": null, "end": null, "receptances": {"file": ""}} | /holder/receptances/file: "": expected the path of a file
/holder | {"segments": null, "end": null, "receptances": {"file": "t", "unit": "pears"}} | /holder/receptances/unit: "pears": expected a unit of a response over a force, as um/N
/holder | {"segments": null, "end": null, "receptances": [TAP, MOBILITY]} | /holder/receptances/1: an object: expected the same quantity as in the first item of the list
/holder | {"segments": null, "end": null, "receptances": [TAP, SHIFTED]} | /holder/receptances/1: an object: expected the same lines as in the first item of the list
/holder | {"segments": null, "end": null, "receptances": [TAP, TAP]} | /holder/receptances/1: an object: xx at these places is in the list already: expected each entry once
/holder | {"segments": null, "end": null, "receptances": WINDOWED} | /holder/receptances/window_decay_per_s: 2: expected responses without an exponential window, or the table that fit-modes makes of them
)");
}

TEST_CASE("what is refused in a cut") {
  check_refusals("cut", R"(
 | {"teeth": 1001} | /teeth: 1001: expected a whole number from 1 to 1000
 | {"kt_n_per_mm2": 1e101} | /kt_n_per_mm2: 1e+101: expected a number of at most 1e100 in size
 | {"kt_n_per_mm2": 1e-101} | /kt_n_per_mm2: 1e-101: expected a number of at least 1e-100
 | {"kr_n_per_mm2": 1e-101} | /kr_n_per_mm2: 1e-101: expected 0 or a number of at least 1e-100
 | {"entry_deg": 0} | /radial_immersion: 0.25: expected either radial_immersion with milling or entry_deg with exit_deg
 | {"radial_immersion": null} | /radial_immersion: missing: expected this field
 | {"radial_immersion": null, "entry_deg": 90, "exit_deg": 90} | /exit_deg: 90: expected an angle above entry_deg
 | {"corner_radius_mm": 7} | /corner_radius_mm: 7: expected at most half of diameter_mm
 | {"pitch_deg": [360]} | /pitch_deg: a list of 1: expected 2 angles, one for each tooth
 | {"pitch_deg": [180, 181]} | /pitch_deg: a list of 2: expected angles that sum to 360 degrees
 | {"helix_deg": 30, "diameter_mm": null} | /helix_deg: 30: expected diameter_mm beside a helix angle
 | {"helix_deg": [30]} | /helix_deg: a list of 1: expected 2 angles, one for each tooth
 | {"helix_deg": 89.99} | /helix_deg: 89.99: expected an edge that turns by less than 100 rad in a mm of depth
 | {"helix_deg": [30, 40], "runout_um": [0, 1]} | /helix_deg: a list of 2: expected one angle where there is runout_um
 | {"process_damping_n_per_m": 1, "diameter_mm": null} | /process_damping_n_per_m: 1: expected diameter_mm beside process damping
 | {"process_damping_friction": 0.3} | /process_damping_friction: 0.3: expected process_damping_n_per_m beside it
 | {"feed_per_tooth_mm": 0.1, "diameter_mm": null} | /feed_per_tooth_mm: 0.1: expected diameter_mm beside it
 | {"runout_um": [1]} | /runout_um: a list of 1: expected 2 numbers, one for each tooth
/chart/speed_rpm | {"count": 1} | /chart/speed_rpm/to: 20000: expected the same number as from, since count is 1
/chart/depth_mm | {"to": 0} | /chart/depth_mm/to: 0: expected a number above from
)");
}

TEST_CASE("what is refused in frequency responses") {
  check_refusals("frf", R"(
/quantity | "compliance" | /quantity: "compliance": expected "receptance" or "mobility" or "accelerance"
/frequency_hz | [] | /frequency_hz: a list of 0: expected at least one frequency
/frequency_hz | [100, 100] | /frequency_hz/1: 100: expected increasing frequencies
/h/0/response | "-" | /h/0/response: "-": expected a direction, such as x
/h/0/reference | "" | /h/0/reference: "": expected a direction, such as x
/h/0/re | 3 | /h/0/re: 3: expected a list of numbers
/h/0/re | [1] | /h/0/re: a list of 1: expected 2 numbers, one for each of /frequency_hz
/h/0 | {"coherence": [1, 1]} | /h/0/averages: missing: expected this field
/h/1/response | "-x" | /h/1: xx: expected each pair of directions once
 | {"covariances": [{"response": "x", "other": "z", "reference": "x", "re": [1, 2], "im": [3, 4]}]} | /covariances/0/other: "z": expected the response of an entry with that reference
 | {"covariances": [{"response": "x", "other": "x", "reference": "x", "re": [1, 2], "im": [3, 4]}]} | /covariances/0: an object: expected two responses
 | {"covariances": [{"response": "x", "other": "y", "reference": "x", "re": [1, 2], "im": [3, 4]}, {"response": "x", "other": "y", "reference": "x", "re": [1, 2], "im": [3, 4]}]} | /covariances/1: an object: expected each pair of responses once
)");
}

TEST_CASE("what is refused in a modal table") {
  check_refusals("modal-table", R"(
/dofs | ["x", "-x"] | /dofs/1: "-x": expected direction names, each once
/dofs | ["u", "v"] | /dofs: ["u","v"]: expected x, y or both
/modes | [{"frequency_hz": 100, "damping_ratio": 0.1, "psi_r": [[0, 0], [0, 0]], "psi_l": [[1, 0], [1, 0]]}] | /modes: expected at least one mode that a force in x or y drives and that moves x or y
/modes/1 | {"label": "a"} | /modes/1/label: "a": expected a name, each once, or no label
/modes/0/damping_ratio | 1 | /modes/0/damping_ratio: 1: expected a damping ratio above 0 and below 1
/modes/0/psi_r | [[1, 0]] | /modes/0/psi_r: a list of 1: expected 2 complex numbers, one for each of /dofs
/modes/0/psi_r/0 | [1] | /modes/0/psi_r/0: a list of 1: expected a complex number [re, im]
 | {"fit": {"covariance": {"parameters": ["/modes/0/frequency"], "matrix": [[1]]}}} | /fit/covariance/parameters/0: "/modes/0/frequency": expected the pointer of a number in /modes, as /modes/0/psi_r/1/re, each once
 | {"fit": {"covariance": {"parameters": ["/modes/0/frequency_hz", "/modes/0/psi_r/1/re"], "matrix": [[1, 0]]}}} | /fit/covariance/matrix: a list of 1: expected 2 rows, one for each of the parameters
 | {"fit": {"covariance": {"parameters": ["/modes/0/frequency_hz", "/modes/0/psi_r/1/re"], "matrix": [[1, 0], [1]]}}} | /fit/covariance/matrix/1: a list of 1: expected 2 numbers, one for each parameter
 | {"fit": {"covariance": {"parameters": ["/modes/0/frequency_hz", "/modes/0/psi_r/1/re"], "matrix": [[1, 0], [0, -1]]}}} | /fit/covariance/matrix/1: a list of 2: expected a variance that is not negative
 | {"fit": {"covariance": {"parameters": ["/modes/0/frequency_hz", "/modes/0/psi_r/1/re"], "matrix": [[1, 0.5], [0, 1]]}}} | /fit/covariance/matrix: a list of 2: expected a symmetric matrix
)");
}

TEST_CASE("what is refused in a joint between tool and holder") {
  check_refusals("tool-joint", R"(
/identifiable | [true] | /identifiable: a list of 1: expected a list of 4: of k1, c1, k2, c2
/at_bound/2 | 1 | /at_bound/2: 1: expected true or false
/std/k1_n_per_m | -1 | /std/k1_n_per_m: -1: expected a number not below 0
/k2_n_m_per_rad | 0 | /k2_n_m_per_rad: 0: expected a number above 0
 | {"direction": "z"} | /direction: "z": expected "x" or "y"
)");
}

TEST_CASE("what is refused in a robot and where it stands") {
  check_refusals("robot", R"(
/joints | [] | /joints: a list of 0: expected 6 joints
/joints/1/name | "A1" | /joints/1/name: "A1": expected names that differ
/joints/0/theta_sign | 2 | /joints/0/theta_sign: 2: expected 1 or -1
/joints/0/max_deg | -185 | /joints/0/max_deg: -185: expected an angle above min_deg
/joints/0 | {"mass_kg": 3} | /joints/0: an object: expected center_mm with mass_kg
/joints/0 | {"center_mm": [1, 2, 3]} | /joints/0: an object: expected mass_kg with center_mm
/joints/2 | {"coupled_min_deg": 10, "coupled_max_deg": 10} | /joints/2/coupled_max_deg: 10: expected an angle above coupled_min_deg
/joints/2 | {"coupled_min_deg": 10} | /joints/2/coupled_min_deg: 10: expected with an entry for A3 in coupling only
 | {"coupling": [{"joint": "A7", "follows": "A2", "ratio": -1}]} | /coupling/0/joint: "A7": expected one of A1, A2, A3, A4, A5, A6
 | {"coupling": [{"joint": "A3", "follows": "A4", "ratio": -1}]} | /coupling/0/follows: "A4": expected one of A1, A2
 | {"coupling": [{"joint": "A1", "follows": "A2", "ratio": -1}]} | /coupling/0/joint: "A1": expected a joint after the first
 | {"coupling": [{"joint": "A3", "follows": "A1", "ratio": 0.5}]} | /coupling/0/ratio: 0.5: expected a whole number, since A1 has more than a full turn
 | {"coupling": [{"joint": "A3", "follows": "A2", "ratio": -1}, {"joint": "A3", "follows": "A2", "ratio": -1}]} | /coupling/1/joint: "A3": expected each joint once
/flange/translation_mm | [1, 2] | /flange/translation_mm: a list of 2: expected 3 numbers
/flange/rotation | [[1, 0, 0]] | /flange/rotation: a list of 1: expected 3 rows
/tool/rotation | [[1, 0, 0], [0, 1, 0], [0, 0, -1]] | /tool/rotation: a list of 3: expected a rotation matrix: rows of length 1 at right angles, right-handed
)");
}

TEST_CASE("what is refused in loads, stiffness, poses and paths") {
  check_refusals("load-samples", R"(
/samples/0/joints_deg | [1, 2] | /samples/0/joints_deg: a list of 2: expected 6 joint angles in degrees
/samples/0/deflection_mm | [1, 2] | /samples/0/deflection_mm: a list of 2: expected 3 numbers
/samples/1 | {"std_mm": null} | /samples/1/std_mm: expected std_mm in all samples or in none
/samples/1 | {"rotation_rad": [0, 0, 0]} | /samples/1/std_rad: expected std_rad with std_mm where rotations are measured, or neither
)");
  check_refusals("joint-stiffness", R"(
/stiffness_n_m_per_rad | [1, 2] | /stiffness_n_m_per_rad: a list of 2: expected 6 numbers, null where unknown
 | {"joints": ["A1"]} | /joints: a list of 1: expected 6 names of joints
 | {"joints": ["A1", "A2", "A3", "A4", "A5", "B6"]} | /joints/5: "B6": expected "A6", as in the robot document: is it this robot's?
 | {"interval_95_n_m_per_rad": [null, null, null, null, null, [1]]} | /interval_95_n_m_per_rad/5: a list of 1: expected two numbers, null for an end that is open
 | {"springs": [{"name": "A9.x", "compliance_rad_per_n_m": 1}]} | /springs/0/name: "A9.x": expected base.x, base.y, base.z, or a joint's name with .x or .y
 | {"model": "base", "springs": [{"name": "A2.x", "compliance_rad_per_n_m": 1}]} | /springs/0/name: "A2.x": expected no such spring in the model base
 | {"springs": [{"name": "A2.x", "compliance_rad_per_n_m": 1}, {"name": "A2.x", "compliance_rad_per_n_m": 1}]} | /springs/1/name: "A2.x": expected each spring once
 | {"springs": [{"name": "A2.x", "compliance_m_per_n": 1}]} | /springs/0/compliance_m_per_n: 1: expected compliance_rad_per_n_m for a bearing
 | {"springs": [{"name": "base.x", "compliance_rad_per_n_m": 1}]} | /springs/0/compliance_rad_per_n_m: 1: expected compliance_m_per_n for a spring of the base
 | {"spring_covariance": {"springs": ["base.x"], "matrix": [[1]]}} | /spring_covariance/springs/0: "base.x": expected a spring of this document
 | {"spring_covariance": {"springs": ["A1.z", "A1.z"], "matrix": [[1]]}} | /spring_covariance/springs/1: "A1.z": expected each spring once
 | {"spring_covariance": {"springs": ["A1.z"], "matrix": []}} | /spring_covariance/matrix: a list of 0: expected 1 rows
 | {"spring_covariance": {"springs": ["A1.z"], "matrix": [[1, 2]]}} | /spring_covariance/matrix/0: a list of 2: expected 1 numbers, or null for a row that is not known
 | {"spring_covariance": {"springs": ["A1.z"], "matrix": [[-1]]}} | /spring_covariance/matrix: a list of 1: expected a covariance matrix: symmetric, without negative eigenvalues
)");
  check_refusals("pose", R"(
/best/compliance_um_per_n | [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]] | /best/compliance_um_per_n: a list of 4: expected 3 rows of 3 numbers
/best/compliance_um_per_n/1 | [1, 0] | /best/compliance_um_per_n/1: a list of 2: expected 3 numbers
 | {"evaluated": [{}, {}]} | /evaluated: a list of 2: expected one pose
)");
  check_refusals("tool-path", R"(
/points | [] | /points: a list of 0: expected a list of at least 1
/points/1/axis | [0, 0, 0] | /points/1/axis: a list of 3: expected a direction
 | {"speed_mm_per_s": null} | /points/0: an object: expected speed_mm_per_s here or beside points
)");
  // A frame that the command gives, too.
  const Json path = Json::parse(testdata("zigzag-path.json"));
  CHECK_THROWS_WITH(
      tool_path_from_json(path, {"f", ""}, {.frame = Eigen::Isometry3d::Identity(), .speed = {}}),
      "f: /frame: an object: expected the workpiece's frame from one place only");
}
