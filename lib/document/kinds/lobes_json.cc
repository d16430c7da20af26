#include "document/kinds/lobes_json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/units.h"
#include "document/text/data_error.h"
#include "document/text/node.h"

namespace stablecut::document {
namespace {

constexpr Bound kResolution{.least = 0, .most = 1e4, .words = "a number of points from 0 to 10000"};

const std::map<milling::Instability, const char*> kNames = {{milling::Instability::kHopf, "hopf"},
                                                            {milling::Instability::kFlip, "flip"},
                                                            {milling::Instability::kFold, "fold"}};

// How tables and their modes are named beside crossings: every row with the same fields.
struct Naming {
  bool with_table, with_labels;
  const std::vector<std::vector<std::string>>& mode_labels;  // [tables][modes]

  explicit Naming(const LobesDocument& lobes)
      : with_table(!lobes.tables.empty()), with_labels(false), mode_labels(lobes.mode_labels) {
    for (const auto& labels : mode_labels) {
      for (const std::string& own : labels) with_labels = with_labels || !own.empty();
    }
  }
  // Null where the mode has none.
  Json label(std::size_t table, std::size_t mode) const {
    const bool known = table < mode_labels.size() && mode < mode_labels[table].size();
    return known && !mode_labels[table][mode].empty() ? Json(mode_labels[table][mode]) : Json(nullptr);
  }
};

// How the cut chatters at a crossing; without one every field is null, so that all rows have the same.
void describe(Json& item, const milling::StabilityCrossing* crossing, const Naming& naming) {
  const auto field = [&](const char* name, const auto& value) {
    item[name] = crossing != nullptr ? Json(value(*crossing)) : Json(nullptr);
  };
  using Crossing = milling::StabilityCrossing;
  field("depth_mm", [](const Crossing& c) { return mm_from_metres(c.depth_m); });
  field("chatter_frequency_hz", [](const Crossing& c) { return c.chatter_frequency_hz; });
  field("kind", [](const Crossing& c) { return kNames.at(c.kind); });
  field("lobe", [](const Crossing& c) { return c.lobe; });
  field("mode", [](const Crossing& c) { return c.mode + 1; });
  if (naming.with_labels)
    field("mode_label", [&](const Crossing& c) { return naming.label(c.table, c.mode); });
  field("participation", [](const Crossing& c) { return c.participation; });
  if (naming.with_table) field("table", [](const Crossing& c) { return c.table + 1; });
}

// `failure`: why there is nothing to say of a speed; empty where there is, or of no speed.
Json limit_to_json(const std::vector<double>& speed_rpm,
                   const std::vector<std::vector<milling::StabilityCrossing>>& crossings,
                   const std::vector<std::string>& failure, const Naming& naming) {
  Json list = Json::array();
  for (std::size_t s = 0; s < speed_rpm.size(); ++s) {
    Json item = {{"speed_rpm", speed_rpm[s]}};
    describe(item, milling::limit_of(crossings[s]), naming);
    const bool failed = s < failure.size() && !failure[s].empty();
    item["not_resolved"] = failed ? Json(failure[s]) : Json(nullptr);
    list.push_back(std::move(item));
  }
  return list;
}

Json crossings_to_json(const std::vector<double>& speed_rpm,
                       const std::vector<std::vector<milling::StabilityCrossing>>& crossings,
                       const Naming& naming) {
  Json list = Json::array();
  for (std::size_t s = 0; s < speed_rpm.size(); ++s) {
    for (const milling::StabilityCrossing& crossing : crossings[s]) {
      Json item = {{"speed_rpm", speed_rpm[s]}};
      describe(item, &crossing, naming);
      item["above"] = crossing.unstable_above ? "unstable" : "stable";
      list.push_back(std::move(item));
    }
  }
  return list;
}

// The length that is written as so many millimetres: rounding may make it a neighbour of their thousandth.
double metres_written_as(double mm) {
  const double nearest = metres_from_mm(mm);
  for (const double towards : {0.0, 2 * nearest}) {
    double metres = nearest;
    for (int step = 0; step < 3; ++step) {
      if (mm_from_metres(metres) == mm) return metres;
      metres = std::nextafter(metres, towards);
    }
  }
  return nearest;
}

milling::StabilityCrossing crossing_from(const Node& item) {
  milling::StabilityCrossing crossing;
  crossing.depth_m = metres_written_as(item.at("depth_mm").number(kNotNegative));
  crossing.unstable_above = item.at("above").word({"unstable", "stable"}) == "unstable";
  const std::string kind = item.at("kind").word({"hopf", "flip", "fold"});
  for (const auto& [value, name] : kNames) {
    if (kind == name) crossing.kind = value;
  }
  crossing.chatter_frequency_hz = item.at("chatter_frequency_hz").number(kNotNegative);
  crossing.lobe = item.at("lobe").integer(0, std::numeric_limits<int>::max());
  crossing.mode = static_cast<std::size_t>(item.at("mode").integer(1, std::numeric_limits<int>::max()) - 1);
  crossing.participation = item.at("participation").number();
  return crossing;
}

Json rows_to_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (const auto& row : matrix.rowwise()) {
    Json items = Json::array();
    for (const double value : row) items.push_back(std::isnan(value) ? Json(nullptr) : Json(value));
    rows.push_back(std::move(items));
  }
  return rows;
}

Json point_to_json(const MeasuredCut& cut, const milling::JudgedCut& judged) {
  Json item = {{"depth_mm", cut.depth_mm},
               {"speed_rpm", cut.speed_rpm},
               {"spectral_radius", judged.spectral_radius},
               {"stable", judged.stable}};
  if (cut.observed_stable) item["observed"] = *cut.observed_stable ? "stable" : "chatter";
  if (judged.agrees) item["agrees"] = *judged.agrees;
  return item;
}

Json optional_mm(const std::optional<double>& metres) {
  return metres ? Json(mm_from_metres(*metres)) : Json(nullptr);
}

// The path's offset that cancels the mean deflection normal to the feed moves the wall by as much.
Json best_surface_to_json(const milling::SurfacePoint& surface) {
  const Eigen::Vector2d& mean = surface.mean_deflection_m;
  const auto um = [](std::optional<double> metres) { return metres ? Json(*metres * 1e6) : Json(nullptr); };
  return {{"location_error_um", um(surface.location_error_m)},
          {"peak_vibration_um", surface.peak_vibration_m * 1e6},
          {"mean_feed_um", mean.x() * 1e6},
          {"mean_normal_um", mean.y() * 1e6},
          {"offset_um", {-mean.x() * 1e6, -mean.y() * 1e6}},
          {"location_error_with_offset_um", um(surface.error_with_offset_m)}};
}

Json what_to_run_to_json(const milling::WhatToRun& what) {
  Json document = {{"depth_margin", what.limits.depth_share}, {"speed_margin", what.limits.speed_share}};
  document["unconditional"] = {{"depth_mm", nullptr}};
  if (what.unconditional) {
    document["unconditional"] = {
        {"depth_mm", mm_from_metres(*what.unconditional->depth_m)},
        {"speed_rpm", rpm_from_revolutions_per_s(what.unconditional->revolutions_per_s)}};
  }
  if (!what.between.empty()) {
    Json between = Json::array();
    for (const milling::LimitPoint& point : what.between) {
      if (point.known)
        between.push_back({{"speed_rpm", rpm_from_revolutions_per_s(point.revolutions_per_s)},
                           {"depth_mm", optional_mm(point.depth_m)}});
    }
    document["limit_between"] = std::move(between);
  }
  document["best"] = Json::array();
  for (std::size_t i = 0; i < what.best.size(); ++i) {
    const milling::OperatingPoint& point = what.best[i];
    const milling::OperatingPoint& first = what.best.front();
    Json item = {{"speed_rpm", rpm_from_revolutions_per_s(point.revolutions_per_s)},
                 {"depth_mm", mm_from_metres(point.depth_m)},
                 {"limit_mm", optional_mm(point.limit_m)},
                 {"slowest_rpm", rpm_from_revolutions_per_s(point.slowest)},
                 {"fastest_rpm", rpm_from_revolutions_per_s(point.fastest)},
                 {"removal_of_best",
                  point.depth_m * point.revolutions_per_s / (first.depth_m * first.revolutions_per_s)}};
    if (point.at_edge) item["at_chart_edge"] = true;
    if (!what.rates.empty()) {
      item["removal_cm3_per_min"] = cm3_per_min_from_m3_per_s(what.rates[i].removal_m3_per_s);
      item["power_w"] = what.rates[i].power_w;
      item["torque_n_m"] = what.rates[i].torque_n_m;
    }
    if (!what.surfaces.empty()) item["surface"] = best_surface_to_json(what.surfaces[i]);
    document["best"].push_back(std::move(item));
  }
  return document;
}

Json surface_to_json(const milling::SurfaceChart& surface) {
  const auto grid = [&](const auto& value) {
    Json rows = Json::array();
    for (const auto& points : surface) {
      Json row = Json::array();
      for (const auto& point : points) {
        const std::optional<double> metres = point ? value(*point) : std::nullopt;
        row.push_back(metres ? Json(*metres * 1e6) : Json(nullptr));
      }
      rows.push_back(std::move(row));
    }
    return rows;
  };
  using Point = milling::SurfacePoint;
  using Metres = std::optional<double>;
  return {{"location_error_um", grid([](const Point& p) { return p.location_error_m; })},
          {"peak_vibration_um", grid([](const Point& p) { return Metres(p.peak_vibration_m); })},
          {"rms_vibration_um", grid([](const Point& p) { return Metres(p.rms_vibration_m); })},
          {"mean_deflection_um", grid([](const Point& p) { return Metres(p.mean_deflection_m.norm()); })},
          {"mean_feed_um", grid([](const Point& p) { return Metres(p.mean_deflection_m.x()); })},
          {"mean_normal_um", grid([](const Point& p) { return Metres(p.mean_deflection_m.y()); })}};
}

// Grids [depth][speed] of a part into every Nth column.
void read_columns(const Node& rows, const Shard& shard, Eigen::MatrixXd& grid) {
  const auto items = rows.items();
  if (static_cast<Eigen::Index>(items.size()) != grid.rows())
    rows.fail("expected " + std::to_string(grid.rows()) + " rows, one for each depth");
  for (Eigen::Index d = 0; d < grid.rows(); ++d) {
    Eigen::Index column = shard.index - 1;
    for (const Node& item : items[d].items()) {
      if (column < grid.cols())
        grid(d, column) =
            item.is_null() ? std::numeric_limits<double>::quiet_NaN() : item.number(kNotNegative);
      column += shard.count;
    }
    if (column - shard.count >= grid.cols() || column < grid.cols())
      items[d].fail("expected a number for each speed");
  }
}

// Whether a part is of the whole's chart, as documents say it.
void check_part(const Node& root, const LobesDocument& whole, const Shard& shard, bool with_grid) {
  if (root.at("cut").json() != whole.cut) root.at("cut").fail("expected the cut and chart of this run");
  const bool spectral = whole.scheme.method == milling::StabilityMethod::kSpectral;
  if (root.at("method").text() != (spectral ? "spectral" : "sdm") ||
      (!spectral && root.at("intervals").json() != whole.scheme.intervals)) {
    root.at("method").fail("expected the method of this run");
  }
  if (root.at("speed_rpm").json() != Json(shard.part_of(whole.speed_rpm)))
    root.at("speed_rpm").fail("expected this part's speeds");
  if (root.at("depth_mm").json() != Json(whole.depth_mm))
    root.at("depth_mm").fail("expected the depths of this run");
  // A member that is missing has no place of its own: the document's.
  const auto member = [&](const char* name) { return root.has(name) ? root.at(name) : root; };
  if ((root.has("samples") ? root.at("samples").json() : Json(0)) != whole.samples)
    member("samples").fail("expected the number of samples of this run");
  if (root.has("spectral_radius") != with_grid)
    member("spectral_radius").fail("expected a grid as in this run");
}

// Puts a part's columns where they belong in the whole.
void take_part(const Node& root, const Shard& shard, bool with_grid, LobesDocument& whole) {
  milling::StabilityChart& chart = whole.chart;
  const std::vector<double> own = shard.part_of(whole.speed_rpm);
  const auto column = [&](std::size_t s) {
    return s * static_cast<std::size_t>(shard.count) + static_cast<std::size_t>(shard.index - 1);
  };
  if (with_grid) read_columns(root.at("spectral_radius"), shard, chart.spectral_radius);
  if (with_grid && whole.sampled)
    read_columns(root.at("probability_stable"), shard, whole.sampled->stable_share);
  const Eigen::VectorXd resolution = root.at("resolution").numbers(kResolution);
  const auto limits = root.at("limit").items();
  if (resolution.size() != static_cast<Eigen::Index>(own.size()) || limits.size() != own.size())
    root.at("limit").fail("expected an entry for each speed");
  for (std::size_t s = 0; s < own.size(); ++s) {
    chart.error[column(s)] = root.at("convergence").number(kNotNegative);
    chart.resolution[column(s)] = static_cast<int>(resolution[s]);
    if (const auto reason = limits[s].find("not_resolved"); reason && !reason->is_null())
      chart.failure[column(s)] = reason->text();
    if (!whole.sampled) continue;
    const auto interval = limits[s].at("interval_95_mm").items(2);
    for (std::size_t end = 0; end < 2; ++end) {
      if (!interval[end].is_null())
        whole.sampled->limit_95_m[column(s)][end] = metres_written_as(interval[end].number());
    }
  }
  for (const Node& item : root.at("crossings").items()) {
    const auto at = std::find(own.begin(), own.end(), item.at("speed_rpm").number());
    if (at == own.end()) item.at("speed_rpm").fail("expected one of this part's speeds");
    chart.crossings[column(at - own.begin())].push_back(crossing_from(item));
  }
}

}  // namespace

double as_written(double metres) { return metres_written_as(mm_from_metres(metres)); }

double LobesDocument::convergence() const {
  double error = 0;
  for (const double of_speed : chart.error) error = std::max(error, of_speed);
  for (const milling::JudgedCut& judged : judged_cuts) error = std::max(error, judged.error);
  return error;
}

Json lobes_to_json(const LobesDocument& lobes) {
  const milling::StabilityChart& chart = lobes.chart;
  const bool spectral = lobes.scheme.method == milling::StabilityMethod::kSpectral;
  Json document = {{"format", "stablecut/lobes/1"},
                   {"cut", lobes.cut},
                   {"method", spectral ? "spectral" : "sdm"},
                   {"convergence", lobes.convergence()}};
  if (spectral) {
    std::vector<int> points = chart.resolution;
    std::erase(points, 0);  // speeds without an answer
    const auto [least, largest] = std::minmax_element(points.begin(), points.end());
    document["points_per_arc"] = {{"least", *least}, {"largest", *largest}};
  } else {
    document["intervals"] = lobes.scheme.intervals;
  }
  if (lobes.shard) {
    document["shard"] = {
        {"index", lobes.shard->index}, {"count", lobes.shard->count}, {"of", lobes.shard->of}};
    document["resolution"] = chart.resolution;
  }
  const Naming naming(lobes);
  if (naming.with_table) document["tables"] = lobes.tables;
  document["speed_rpm"] = lobes.speed_rpm;
  document["depth_mm"] = lobes.depth_mm;
  if (chart.spectral_radius.size() > 0) document["spectral_radius"] = rows_to_json(chart.spectral_radius);
  if (!lobes.surface.empty()) document["surface"] = surface_to_json(lobes.surface);
  document["limit"] = limit_to_json(lobes.speed_rpm, chart.crossings, chart.failure, naming);
  document["crossings"] = crossings_to_json(lobes.speed_rpm, chart.crossings, naming);
  if (lobes.sampled) {
    document["samples"] = lobes.samples;
    if (lobes.sampled->stable_share.size() > 0)
      document["probability_stable"] = rows_to_json(lobes.sampled->stable_share);
    for (std::size_t s = 0; s < lobes.speed_rpm.size(); ++s) {
      const auto& interval = lobes.sampled->limit_95_m[s];
      document["limit"][s]["interval_95_mm"] = {optional_mm(interval[0]), optional_mm(interval[1])};
    }
  }
  if (lobes.what_to_run) document["what_to_run"] = what_to_run_to_json(*lobes.what_to_run);
  if (!lobes.per_mode.empty()) {
    Json list = Json::array();
    for (const milling::ModeLimit& limit : lobes.per_mode) {
      Json item = {{"mode", limit.mode + 1}};
      if (naming.with_labels) item["mode_label"] = naming.label(0, limit.mode);
      item["limit"] = limit_to_json(lobes.speed_rpm, limit.crossings, {}, naming);
      list.push_back(std::move(item));
    }
    document["per_mode"] = std::move(list);
  }
  if (!lobes.judged_cuts.empty()) {
    Json list = Json::array();
    for (std::size_t i = 0; i < lobes.judged_cuts.size(); ++i)
      list.push_back(point_to_json(lobes.measured_cuts[i], lobes.judged_cuts[i]));
    document["points"] = std::move(list);
  }
  return document;
}

void merge_parts(LobesDocument& whole, bool with_grid, const Json& whole_of,
                 const std::vector<Input>& parts) {
  const std::size_t speeds = whole.speed_rpm.size();
  const auto count = static_cast<int>(parts.size());
  const Eigen::Index columns = speeds, depths = whole.depth_mm.size();
  milling::StabilityChart& chart = whole.chart;
  if (with_grid) chart.spectral_radius.resize(depths, columns);
  chart.crossings.assign(speeds, {});
  chart.error.assign(speeds, 0.0);
  chart.resolution.assign(speeds, 0);
  chart.failure.assign(speeds, "");
  if (whole.samples > 0) {
    whole.sampled.emplace();
    if (with_grid) whole.sampled->stable_share.resize(depths, columns);
    whole.sampled->limit_95_m.resize(speeds);
  }
  std::vector<bool> seen(parts.size(), false);
  for (const Input& part : parts) {
    const Node root = document_root(part.document, part.source, "lobes");
    const Node of = root.at("shard");
    if (of.at("count").json() != count)
      of.at("count").fail("expected " + std::to_string(count) + ", the number of parts given");
    const Shard shard{of.at("index").integer(1, count), count, {}};
    if (of.at("of").json() != whole_of) of.at("of").fail("expected the inputs and options of this run");
    if (seen[shard.index - 1]) of.at("index").fail("expected each part once");
    seen[shard.index - 1] = true;
    check_part(root, whole, shard, with_grid);
    take_part(root, shard, with_grid, whole);
  }
}

}  // namespace stablecut::document
