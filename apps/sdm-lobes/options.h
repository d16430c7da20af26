// The options of sdm-lobes that belong together: the cut, the modes, what to run, parts of a chart.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/tool.h"
#include "document/kinds/cut_json.h"
#include "document/kinds/lobes_json.h"
#include "milling/lobes.h"
#include "milling/what_to_run.h"

namespace stablecut {

/// The cut: a document, and the options that stand in the place of its fields or of all of it.
class CutOptions {
 public:
  using Reader = std::function<document::Input(const std::string& path, cli::InputForm form)>;

  std::string path;  ///< of --cut; empty where it is not given

  /// Declares --teeth, --kt, --kr, --milling and --immersion; the object must stay where it is until they
  /// have been parsed.
  void declare(CLI::App& app);
  /// Reads --cut and puts the options in it, or makes the document of the options alone. Throws WrongUsage
  /// where one of them is missing then or its value is wrong, DataError for what a file holds.
  void read(const Reader& read_input);

  /// Throws WrongUsage where the method is not one for this cutter; warns of coefficients in another form.
  void check(const std::string& method, const std::function<void(const std::string&)>& warn) const;
  const document::CutDocument& cut() const { return cut_; }
  /// The document with the chart that is computed in its place, without format and provenance. Throws
  /// NoAnswer where edges meet within it.
  document::Json as_used(const Range& speed_rpm, const Range& depth_mm) const;

 private:
  document::Json read_document(const Reader& read_input);
  /// Puts what options give in the place of the cut's own fields.
  void put_options(document::Json& cut) const;

  std::optional<int> teeth_;
  std::optional<double> kt_, kr_, immersion_;
  std::string milling_;
  std::vector<CLI::Option*> declared_;
  document::Source source_;
  document::Json document_;
  document::CutDocument cut_;
};

/// --modes: which modes of the table are used.
class ModeOptions {
 public:
  void declare(CLI::App& app);
  bool given() const { return listed_ || !labels_.empty(); }
  /// Labels of the table's modes, empty where they have none; finds those that were chosen by them. Throws
  /// WrongUsage for one that the table does not have.
  std::vector<std::string> find_labels(const document::Input& table);
  /// 1-based; empty: all.
  std::vector<int> listed() const { return listed_.value_or(std::vector<int>{}); }
  /// Indices in the table. Throws WrongUsage for one that it does not have.
  std::vector<std::size_t> chosen(const dynamics::ModalModel& table, const std::string& name) const;
  /// The table with the chosen modes only.
  dynamics::ModalModel model(const dynamics::ModalModel& table, const std::string& name) const;
  /// Gives crossings of a chart of the chosen modes their indices in the table.
  void name_as_in_table(milling::StabilityChart& chart) const;

 private:
  std::optional<std::vector<int>> listed_;
  std::vector<std::string> labels_;
};

/// A chart's speeds and depths in the units of the numeric rooms.
struct ChartAxes {
  std::vector<double> revolutions_per_s, depths_m;
  explicit ChartAxes(const document::LobesDocument& lobes);
};

/// The input, if it is JSON. The measured file in the place of its modal table is a likely slip: throws
/// DataError.
document::Input modal_table(document::Input input);

/// The structure of a table's modes; with z where the cut acts along the axis. Throws DataError where it has
/// none that can chatter; `warn` gets what is left out.
milling::TipStructure structure_of(const dynamics::ModalModel& model, const document::Source& source,
                                   bool is_axial, const std::function<void(const std::string&)>& warn);

/// The limits as the document has them: a chart put together from parts has only these.
milling::LimitCurve written_limits(const document::LobesDocument& lobes, const ChartAxes& axes);

/// What is asked of the best points.
class RunOptions {
 public:
  void declare(CLI::App& app);
  /// Throws WrongUsage where a limit needs a feed that the cut does not have.
  milling::RunRequest request(const document::CutDocument& cut) const;

 private:
  std::optional<int> count_;
  std::optional<double> depth_margin_, speed_margin_, largest_power_, largest_torque_;
};

/// A chart computed in parts.
class PartOptions {
 public:
  std::optional<document::Shard> shard;  ///< of --shard
  std::vector<std::string> paths;        ///< of --merge

  bool used() const { return shard || !paths.empty(); }

  /// The options, which do not change the result.
  std::vector<const CLI::Option*> declare(CLI::App& app);
  /// Leaves the part of --shard of the document's speeds; `of` is what it belongs to. Throws WrongUsage where
  /// there are fewer speeds than parts.
  void take_part(const document::Json& of, document::LobesDocument& lobes) const;
};

/// Throws WrongUsage where a chart is more than one run computes; `merged`: its parts are computed already.
void check_size(const document::LobesDocument& lobes, std::size_t tables, bool merged);

}  // namespace stablecut
