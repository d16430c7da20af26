// What every tool shares: options, inputs, outputs, provenance, the catch ladder.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/range.h"
#include "cli/output.h"
#include "cli/provenance.h"
#include "document/kinds/schemas.h"
#include "document/measured/frf_unit.h"

namespace stablecut::cli {

/// How an input is read. By content: a text that begins with { or [ is JSON.
enum class InputForm { kByContent, kJson, kText };

/// One executable. A tool declares its options in setup(), which opens nothing, and works in run(), which
/// throws on failure; outputs are written after run() has returned.
class Tool {
 public:
  /// `example` is a command that --help shows first; `main_kind` the document kind that --print-schema prints
  /// by default.
  Tool(std::string name, std::string purpose, const std::string& example, std::string main_kind);
  virtual ~Tool() = default;

  /// Parses, runs, writes; the exit status. Every failure is one line on standard error; so is the summary of
  /// a document that went into a file, where standard error is a terminal.
  int main(int argc, char** argv);

 protected:
  virtual void setup(CLI::App& app) = 0;
  virtual void run() = 0;
  /// This tool's option for what an error suggests, such as `--band`; empty where it has none.
  virtual std::string option_for(Remedy) const { return ""; }
  /// The same in brackets behind a space, to be put after a message; empty where there is none.
  std::string advice(Remedy remedy) const;

  /// The main input (INPUT, standard input by default) or another; remembered for the provenance.
  document::Input read_main_input(InputForm form) { return read_input(input_, form); }
  document::Input read_input(const std::string& path, InputForm form);
  const std::string& main_input() const { return input_; }
  /// A part of the tool's own result: not an input of the document.
  document::Input read_part(const std::string& path);
  /// What the main input is compared with: its label does not become the result's.
  document::Input read_reference(const std::string& path, InputForm form = InputForm::kJson);

  /// Adds label and provenance and takes the document as an output; "-" is standard output. The main output
  /// as a table where --as-table or --csv asks for it.
  void write_document(const std::string& path, document::Json document);
  /// Takes a text that is no document, without provenance, as an output.
  void write_text(const std::string& path, std::string text);
  const std::string& main_output() const { return output_; }

  void warn(const std::string& text) const;
  int threads() const { return threads_; }
  bool quiet() const { return quiet_; }

  /// Marks an option as one that does not change the result (where outputs go, names of inputs), so that it
  /// stays out of the provenance.
  void not_in_provenance(const CLI::Option* option) { silent_options_.push_back(option); }

  /// An option whose value is a file's path; not in the provenance, which names inputs by themselves.
  CLI::Option* add_file_option(CLI::App& app, const std::string& name, std::string& path,
                               const std::string& description);

 private:
  int parse(int argc, char** argv);
  void refuse_unknown() const;
  std::vector<std::string> result_arguments() const;
  bool as_table() const { return table_ || !csv_.empty(); }
  std::string table_text(const document::Json& document) const;
  void add_output(const std::string& path, std::string text);

  std::string name_;
  std::string main_kind_;
  CLI::App app_;
  std::string input_ = "-";
  std::string output_ = "-";
  std::string schema_;
  bool quiet_ = false;
  bool without_provenance_ = false;
  bool table_ = false;
  std::string csv_;
  std::string label_;
  std::string said_at_end_;
  int threads_ = 0;
  CLI::Option* schema_option_ = nullptr;
  std::vector<const CLI::Option*> silent_options_;
  bool standard_input_taken_ = false;
  std::vector<ProvenanceInput> inputs_;
  std::vector<std::string> output_paths_;
  OutputSet outputs_;
};

/// The options that are added after this stand under that heading in --help.
void begin_group(CLI::App& app, const std::string& heading);

/// An option whose text must be FROM:TO:COUNT.
CLI::Option* add_range_option(CLI::App& app, const std::string& name, std::optional<Range>& value,
                              const std::string& description);
/// An option whose text must be LO:HI.
CLI::Option* add_band_option(CLI::App& app, const std::string& name, std::optional<Range>& value,
                             const std::string& description);
/// An option whose text must be a finite number for which `inside` holds; `expected` says so in words.
CLI::Option* add_number_option(CLI::App& app, const std::string& name, std::optional<double>& value,
                               const std::string& description, const std::string& expected,
                               bool (*inside)(double));
/// An option whose text must be X,Y,Z.
CLI::Option* add_vector_option(CLI::App& app, const std::string& name,
                               std::optional<std::array<double, 3>>& value, const std::string& description);
/// An option that may be given again: `take` gets each text, and throws WrongUsage for a wrong one.
CLI::Option* add_repeated_option(CLI::App& app, const std::string& name, const std::string& type_name,
                                 const std::string& description,
                                 const std::function<void(const std::string&)>& take);
/// An option whose text must be a whole number from `least` on, up to `most`.
CLI::Option* add_integer_option(CLI::App& app, const std::string& name, std::optional<int>& value, int least,
                                const std::string& description, int most = std::numeric_limits<int>::max());

/// --unit: a displacement, velocity or acceleration over a force.
CLI::Option* add_unit_option(CLI::App& app, std::optional<document::FrfUnit>& value,
                             const std::string& description);

/// An option whose text must be one of the words, separated by | in `words`.
CLI::Option* add_choice_option(CLI::App& app, const std::string& name, std::string& value,
                               const std::string& words, const std::string& description);

}  // namespace stablecut::cli
