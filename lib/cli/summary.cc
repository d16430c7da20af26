#include "cli/summary.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/number_text.h"

namespace stablecut::cli {
namespace {

using document::Json;

constexpr int kDigits = 3;

std::string short_text(const Json& number) { return number_text(number.get<double>(), kDigits); }

// `3 modes`, `1 mode`.
std::string count_text(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string frf_words(const Json& frf) {
  const Json& lines = frf.at("frequency_hz");
  return count_text(frf.at("h").size(), "curve") + ", " + count_text(lines.size(), "line") + ", " +
         number_text(lines.front()) + " to " + number_text(lines.back()) + " Hz";
}

std::string table_words(const Json& table) {
  std::vector<double> inside;
  for (const Json& mode : table.at("modes"))
    if (!mode.value("out_of_band", false)) inside.push_back(mode.at("frequency_hz"));
  std::string words = count_text(inside.size(), "mode");
  if (inside.empty()) return words;
  const auto [least, most] = std::minmax_element(inside.begin(), inside.end());
  words += ", " + number_text(*least, kDigits);
  return words + (least == most ? "" : " to " + number_text(*most, kDigits)) + " Hz";
}

std::string lobes_words(const Json& lobes) {
  if (!lobes.contains("what_to_run")) return "a part of a chart";
  const Json& run = lobes.at("what_to_run");
  std::string words;
  if (const auto depth = run.find("unconditional");
      depth != run.end() && depth->value("depth_mm", Json()).is_number())
    words = "stable at every speed of the chart below " + short_text(depth->at("depth_mm")) + " mm";
  if (const auto best = run.find("best"); best != run.end() && !best->empty())
    words += (words.empty() ? "" : "; ") + std::string("most removed at ") +
             short_text(best->front().at("depth_mm")) + " mm, " +
             number_text(best->front().at("speed_rpm"), 5) + " rpm";
  return words.empty() ? "no stable cut in the chart" : words;
}

std::string force_words(const Json& force) {
  return "mean force " + short_text(force.at("mean_force_n").at(0)) + ", " +
         short_text(force.at("mean_force_n").at(1)) + ", " + short_text(force.at("mean_force_n").at(2)) +
         " N, peak " + short_text(force.at("peak_force_n")) + " N";
}

std::string cut_words(const Json& cut) {
  return "Kt " + short_text(cut.at("kt_n_per_mm2")) + ", Kr " + short_text(cut.at("kr_n_per_mm2")) + " N/mm2";
}

std::string stiffness_words(const Json& stiffness) {
  const Json& told = stiffness.at("identifiable");
  const auto count = std::count(told.begin(), told.end(), Json(true));
  return std::to_string(count) + " of " + count_text(told.size(), "joint") + " identified, residual " +
         short_text(stiffness.at("residual_rms_um")) + " um RMS";
}

std::string score_text(const Json& document, const Json& score) {
  return document.at("index").at("name").get<std::string>() + " " + short_text(score) + " " +
         document.at("index").at("unit").get<std::string>();
}

std::string pose_words(const Json& pose) {
  if (pose.contains("evaluated")) return count_text(pose.at("evaluated").size(), "pose") + " evaluated";
  std::string joints;
  for (const Json& angle : pose.at("best").at("joints_deg"))
    joints += (joints.empty() ? "" : ", ") + short_text(angle);
  return score_text(pose, pose.at("best").at("score")) + " at " + joints + " deg";
}

std::string path_words(const Json& path) {
  return count_text(path.at("points").size(), "point") + ", the worst " +
         score_text(path, path.at("worst").at("score"));
}

std::string joint_words(const Json& document) {
  const auto values = [](const Json& joint) {
    return "k1 " + short_text(joint.at("k1_n_per_m")) + " N/m, k2 " + short_text(joint.at("k2_n_m_per_rad")) +
           " N m/rad";
  };
  if (!document.contains("x")) return values(document);
  return "x: " + values(document.at("x")) + "; y: " + values(document.at("y"));
}

constexpr std::array<std::pair<std::string_view, std::string (*)(const Json&)>, 9> kWords = {{
    {"frf", frf_words},
    {"modal-table", table_words},
    {"lobes", lobes_words},
    {"cut-force", force_words},
    {"cut", cut_words},
    {"joint-stiffness", stiffness_words},
    {"pose", pose_words},
    {"pose-path", path_words},
    {"tool-joint", joint_words},
}};

}  // namespace

std::string summary(const Json& document) {
  const std::string format = document.at("format");
  const auto slash = format.find('/');
  const std::string kind = format.substr(slash + 1, format.rfind('/') - slash - 1);
  for (const auto& [name, words] : kWords)
    if (name == kind) return words(document);
  return kind;
}

}  // namespace stablecut::cli
