#include "fuzz_targets.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <stdexcept>

#include "assumed_stiffness.h"
#include "base/error.h"
#include "base/range.h"
#include "cli/exit_status.h"
#include "cli/provenance.h"
#include "document/kinds/assembly_json.h"
#include "document/kinds/cut_json.h"
#include "document/kinds/frf_json.h"
#include "document/kinds/joint_stiffness_json.h"
#include "document/kinds/load_samples_json.h"
#include "document/kinds/modal_table_json.h"
#include "document/kinds/mode_labels.h"
#include "document/kinds/pose_json.h"
#include "document/kinds/pose_list_json.h"
#include "document/kinds/robot_json.h"
#include "document/kinds/tool_joint_json.h"
#include "document/kinds/tool_path_json.h"
#include "document/measured/frf_import.h"
#include "document/measured/frf_uff.h"
#include "document/measured/frf_uff_writer.h"
#include "document/measured/given_poles.h"
#include "document/measured/load_samples_csv.h"
#include "document/measured/measured_cuts.h"
#include "document/measured/measured_forces.h"
#include "document/measured/tap_records.h"
#include "document/measured/tool_path_text.h"
#include "document/text/data_error.h"
#include "document/text/flat_table.h"
#include "fit_values.h"
#include "lobe_values.h"
#include "option_values.h"
#include "pose_values.h"

namespace stablecut {
namespace {

using namespace document;

void expect(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

Source source_of(const std::string& bytes) { return {"f", bytes}; }

Input bundled(const std::string& name) {
  std::ifstream file(STABLECUT_TESTDATA "/" + name, std::ios::binary);
  Input input{{name, std::string(std::istreambuf_iterator<char>(file), {})}, nullptr};
  input.document = parse_json(input.source);
  return input;
}

const robot::Robot& bundled_robot() {
  static const robot::Robot robot = [] {
    const Input input = bundled("kr360.json");
    return robot_from_json(input.document, input.source);
  }();
  return robot;
}

void check_frf(const dynamics::FrequencyResponse& frf) {
  expect(!frf.entries.empty() && frf.frequency_hz.size() > 0, "an frf without lines or entries");
  for (const auto& entry : frf.entries)
    expect(entry.h.size() == frf.frequency_hz.size() && entry.h.allFinite(), "a curve with other lines");
  json_text(frf_to_json(frf));
  // What was read can be written and read again, to the last bit.
  std::vector<Remark> remarks;
  const std::string binary = frf_to_universal_file(frf, UniversalForm::kBinary);
  const dynamics::FrequencyResponse again = frf_from_universal_file({"again", binary}, {}, remarks);
  expect(again.frequency_hz == frf.frequency_hz && again.entries.size() == frf.entries.size(),
         "other lines or entries when read again");
  for (std::size_t e = 0; e < frf.entries.size(); ++e)
    expect(again.entries[e].h == frf.entries[e].h, "another curve when read again");
  frf_from_universal_file({"again", frf_to_universal_file(frf, UniversalForm::kText)}, {}, remarks);
}

template <FrfForm form>
void take_frf(const std::string& bytes) {
  Input input{source_of(bytes), nullptr};
  if (form == FrfForm::kJson) input.document = parse_json(input.source);
  FrfChoice choice;
  choice.form = form;
  std::vector<Remark> remarks;
  check_frf(import_frf(input, choice, remarks));
}

void take_taps(const std::string& bytes) {
  TapRecordChoice choice;
  if (bytes.size() % 2 == 1) choice.sample_rate_hz = 2048;
  std::vector<Remark> remarks;
  const TapRecords read = tap_records({source_of(bytes), nullptr}, "x", choice, remarks);
  expect(!read.records.empty() && !read.responses.empty(), "taps without records");
}

// `read` gets the parsed document and its source.
template <typename Read>
void take_document(const std::string& bytes, const Read& read) {
  const Source source = source_of(bytes);
  read(parse_json(source), source);
}

void take_json(const std::string& bytes) {
  take_document(bytes, [](const Json& document, const Source& source) {
    const std::string text = json_text(document);
    expect(parse_json({"again", text}) == document, "another document when read again");
    cli::provenance_input(source, document);
    // Tables are made of the documents of tools, whose format is a text.
    if (!document.is_object() || (document.contains("format") && !document["format"].is_string())) return;
    const std::vector<FlatTable> tables = flat_tables(document);
    for (const FlatTable& table : tables) {
      for (const auto& row : table.rows)
        expect(row.size() == table.columns.size(), "a row with other columns");
      csv_text(table);
    }
    aligned_text(tables, {100, 24});
  });
}

void take_modal_table(const std::string& bytes) {
  take_document(bytes, [](const Json& document, const Source& source) {
    const dynamics::ModalModel model = modal_table_from_json(document, source);
    expect(mode_labels(document).size() == model.modes.size(), "labels of other modes");
    for (const dynamics::Mode& mode : model.modes)
      expect(
          mode.psi_r.size() == mode.psi_l.size() && std::size(model.dofs) == std::size_t(mode.psi_r.size()),
          "a shape with other directions");
  });
}

void take_cut(const std::string& bytes) {
  take_document(bytes, [](const Json& document, const Source& source) {
    const CutDocument cut = cut_from_json(document, source);
    expect(cut.cutter.teeth > 0 && cut.cutter.kt_n_per_m2 > 0, "a cut without teeth");
  });
}

void take_assembly(const std::string& bytes) {
  take_document(bytes, [](const Json& document, const Source& source) {
    const Eigen::VectorXd frequency_hz = assembly_frequencies(document, source);
    expect(frequency_hz.size() > 0, "an assembly without frequencies");
    // Few of them: what is computed on each is no matter of the reader.
    assembly_from_json(document, source, frequency_hz.head(std::min<Eigen::Index>(frequency_hz.size(), 20)),
                       [](const std::string& path) -> Input { throw DataError(path, "", "", "no file"); });
  });
}

void take_robot(const std::string& bytes) {
  take_document(bytes, [](const Json& document, const Source& source) { robot_from_json(document, source); });
}

void take_load_samples(const std::string& bytes) {
  take_document(bytes, [](const Json& document, const Source& source) {
    const auto read = load_samples_from_json(document, source, bundled_robot(), {true, true, true});
    expect(read.places.size() == read.samples.size(), "samples without places");
  });
}

void take_load_table(const std::string& bytes) {
  const auto read = load_samples_from_csv(source_of(bytes), bundled_robot(), {true, true, true});
  expect(read.places.size() == read.samples.size() && !read.samples.empty(), "samples without places");
}

void take_joint_stiffness(const std::string& bytes) {
  take_document(bytes, [](const Json& document, const Source& source) {
    joint_stiffness_from_json(document, source, bundled_robot());
  });
}

void take_pose_list(const std::string& bytes) {
  take_document(bytes,
                [](const Json& document, const Source& source) { pose_list_from_json(document, source); });
}

void take_pose(const std::string& bytes) {
  take_document(bytes, [](const Json& document, const Source& source) {
    expect(tool_compliance(document, source).allFinite(), "a compliance that is not finite");
  });
}

void take_tool_joint(const std::string& bytes) {
  take_document(bytes,
                [](const Json& document, const Source& source) { tool_joints_from_json(document, source); });
}

void check_path(const ToolPathDocument& read) {
  for (const robot::ToolPathPoint& point : read.path)
    expect(point.position.allFinite() && point.speed > 0, "a point that is not finite");
}

void take_tool_path(const std::string& bytes) {
  take_document(bytes, [](const Json& document, const Source& source) {
    check_path(tool_path_from_json(document, source, {}));
  });
}

void take_path_text(const std::string& bytes) {
  check_path(tool_path_from_text(source_of(bytes), {.frame = {}, .speed = 0.1}));
}

void take_tested_cuts(const std::string& bytes) {
  const Source source = source_of(bytes);
  const bool is_json = !bytes.empty() && (bytes[0] == '[' || bytes[0] == '{');
  for (const MeasuredCut& cut : measured_cuts(source, is_json ? parse_json(source) : Json()))
    expect(cut.depth_mm >= 0 && cut.speed_rpm > 0, "a tested cut without depth or speed");
}

void take_forces(const std::string& bytes) {
  static const CutDocument cut = [] {
    const Input input = bundled("slotting-tool.json");
    return cut_from_json(input.document, input.source, CoefficientsNeeded::kNone);
  }();
  measured_forces(source_of(bytes), cut);
}

void take_force_record(const std::string& bytes) { mean_of_record(source_of(bytes), 6000); }

void take_given_poles(const std::string& bytes) {
  for (const modal::GivenPole& given : given_poles({source_of(bytes), nullptr}))
    expect(given.pole.real() < 0 && given.pole.imag() > 0 && std::isfinite(std::abs(given.pole)),
           "a pole that is not damped");
}

// `takers` get each line, as the text of an option; each may refuse it.
void take_lines(const std::string& bytes,
                std::initializer_list<std::function<void(const std::string&)>> takers) {
  for (const std::string_view line : split(bytes, '\n')) {
    for (const auto& take : takers) {
      try {
        take(std::string(line));
      } catch (const cli::WrongUsage&) {
      }
    }
  }
}

void take_options(const std::string& bytes) {
  const auto forms_of = [](const std::string& text) {
    if (const auto range = parse_range(text)) {
      expect(range->count >= 1 && range->at(0) == range->from && range->at(range->count - 1) == range->to,
             "a range without its ends");
      expect(std::isfinite(range->at(range->count / 2)), "a range with a value that is not finite");
    }
    if (const auto band = parse_band(text)) expect(band->from < band->to, "a band that does not increase");
    if (const auto list = parse_index_list(text))
      expect(!list->empty() && list->front() >= 1 && std::is_sorted(list->begin(), list->end()),
             "indices that do not increase");
    parse_vector(text);
    parse_integer(text);
    frf_unit(text);
    frequency_unit(text);
    sensitivity_named(text);
    frf_part_named(text);
  };
  const auto positions_of = [](const std::string& text) {
    std::vector<double> positions_m;
    add_positions(text, positions_m);
  };
  const auto bounds_of = [](const std::string& text) {
    receptance::JointBounds bounds;
    set_bounds(text, bounds);
  };
  take_lines(bytes, {forms_of, positions_of, bounds_of});
}

void take_pose_options(const std::string& bytes) {
  const auto box_of = [](const std::string& text) {
    const robot::Box box = parse_box(text);
    expect((box.least_m.array() <= box.most_m.array()).all() && box.most_m.allFinite(), "a box inside out");
  };
  const auto grid_of = [](const std::string& text) {
    const robot::PlaceGrid grid = place_grid(text);
    for (const Range& range : {grid.x, grid.y, grid.z, grid.turn})
      expect(range.count >= 1 && range.from <= range.to && std::isfinite(range.to - range.from),
             "places without an order");
  };
  const auto speeds_of = [](const std::string& text) {
    expect((joint_speeds(text, bundled_robot()).array() > 0).all(), "a joint that stands");
  };
  const auto assumed_of = [](const std::string& text) {
    const double stiffness = parse_assumed(text).second;
    expect(stiffness > 0 && std::isfinite(1 / stiffness), "a joint without stiffness");
  };
  take_lines(bytes, {box_of, grid_of, speeds_of, assumed_of});
}

void take_fit_options(const std::string& bytes) {
  const auto decay_of = [](const std::string& text) {
    const auto decay = parse_decay(text);
    expect(!decay || (*decay > 0 && std::isfinite(*decay)), "a decay that is none");
  };
  const auto bands_of = [](const std::string& text) {
    std::vector<Range> bands;
    add_bands(text, bands);
    expect(!bands.empty(), "an exclusion of nothing");
  };
  const auto correction_of = [](const std::string& text) {
    parse_correction("--delay", text);
    expect(parse_correction("--scale", text).factor != 0, "a factor of zero");
  };
  const auto taps_of = [](const std::string& text) {
    std::vector<TapFile> files;
    add_taps(text, files);
    expect(!files.empty(), "a direction without files");
  };
  take_lines(bytes, {decay_of, bands_of, correction_of, taps_of});
}

void take_lobe_options(const std::string& bytes) {
  const auto modes_of = [](const std::string& text) {
    const ModeList list = parse_modes(text);
    expect(list.indices.has_value() == list.labels.empty(), "a list of no modes");
  };
  const auto shard_of = [](const std::string& text) {
    const document::Shard shard = parse_shard(text);
    expect(shard.index >= 1 && shard.index <= shard.count, "a part of another chart");
  };
  take_lines(bytes, {modes_of, shard_of});
}

}  // namespace

const std::vector<FuzzTarget>& fuzz_targets() {
  static const std::vector<FuzzTarget> targets = {
      {"universal-file", take_frf<FrfForm::kUniversalFile>},
      {"columns", take_frf<FrfForm::kColumns>},
      {"cutpro", take_frf<FrfForm::kCutPro>},
      {"frf", take_frf<FrfForm::kJson>},
      {"taps", take_taps},
      {"json", take_json},
      {"modal-table", take_modal_table},
      {"cut", take_cut},
      {"assembly", take_assembly},
      {"robot", take_robot},
      {"load-samples", take_load_samples},
      {"load-table", take_load_table},
      {"joint-stiffness", take_joint_stiffness},
      {"pose-list", take_pose_list},
      {"pose", take_pose},
      {"tool-joint", take_tool_joint},
      {"tool-path", take_tool_path},
      {"path-text", take_path_text},
      {"tested-cuts", take_tested_cuts},
      {"forces", take_forces},
      {"force-record", take_force_record},
      {"given-poles", take_given_poles},
      {"options", take_options},
      {"pose-options", take_pose_options},
      {"fit-options", take_fit_options},
      {"lobe-options", take_lobe_options},
  };
  return targets;
}

void feed(const FuzzTarget& target, const std::string& bytes) {
  try {
    target.take(bytes);
  } catch (const DataError&) {
  } catch (const InvalidArgument&) {
  } catch (const NoAnswer&) {
  } catch (const cli::WrongUsage&) {
  }
}

}  // namespace stablecut
