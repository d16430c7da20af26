#include "cli/tool.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>
#include <thread>

#include "base/edit_distance.h"
#include "base/error.h"
#include "cli/completion.h"
#include "cli/exit_status.h"
#include "cli/help_formatter.h"
#include "cli/streams.h"
#include "cli/summary.h"
#include "document/text/data_error.h"
#include "document/text/flat_table.h"
#include "document/text/plain_text.h"

namespace stablecut::cli {
namespace {

// Larger tables are not for the eye: --as-table says how large they are.
constexpr document::TableSize kMostShown = {100, 24};

// One line, whatever the text was.
void say(const std::string& name, const std::string& text) {
  std::string line = document::printable(text);
  while (!line.empty() && line.back() == ' ') line.pop_back();
  std::fprintf(stderr, "%s: %s\n", name.c_str(), line.c_str());
}

bool looks_like_json(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // as Windows writes UTF-8
  const auto first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && (text[first] == '{' || text[first] == '[');
}

// The file that a path leads to, so that two spellings of one file are known as one. A path that cannot be
// followed (no permission, a name too long) stays as it is: writing to it will fail, and say why.
std::string file_of(const std::string& path) {
  std::error_code error;
  const auto whole = std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  return error ? path : whole.string();
}

template <typename T, typename Parse>
CLI::Option* add_parsed_option(CLI::App& app, const std::string& name, T& value,
                               const std::string& description, const std::string& type_name,
                               const std::string& expected, const Parse& parse) {
  return app
      .add_option_function<std::string>(
          name,
          [&value, name, expected, parse](const std::string& text) {
            value = parse(text);
            if (!value) throw WrongUsage(name + ": " + text + ": expected " + expected);
          },
          description)
      ->type_name(type_name);
}

// Matrices of some hundred kilobytes that come and go are not given back to the system each time: handing out
// and clearing their pages again took a sixth of the time of large inputs.
void keep_memory() {
#ifdef __GLIBC__
  constexpr int kMostUnused = 1 << 30, kAtOnce = 16 << 20;  // bytes
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, kMostUnused);
  mallopt(M_TOP_PAD, kAtOnce);
#endif
}

}  // namespace

void begin_group(CLI::App& app, const std::string& heading) { app.option_defaults()->group(heading); }

CLI::Option* add_range_option(CLI::App& app, const std::string& name, std::optional<Range>& value,
                              const std::string& description) {
  return add_parsed_option(
      app, name, value, description, "FROM:TO:COUNT",
      "FROM:TO:COUNT, increasing, or FROM:FROM:1; COUNT at most " + std::to_string(kMostInRange),
      parse_range);
}

CLI::Option* add_band_option(CLI::App& app, const std::string& name, std::optional<Range>& value,
                             const std::string& description) {
  return add_parsed_option(app, name, value, description, "LO:HI", "LO:HI, two increasing numbers",
                           parse_band);
}

CLI::Option* add_vector_option(CLI::App& app, const std::string& name,
                               std::optional<std::array<double, 3>>& value, const std::string& description) {
  return add_parsed_option(app, name, value, description, "X,Y,Z", "X,Y,Z, three numbers", parse_vector);
}

CLI::Option* add_repeated_option(CLI::App& app, const std::string& name, const std::string& type_name,
                                 const std::string& description,
                                 const std::function<void(const std::string&)>& take) {
  return app
      .add_option_function<std::vector<std::string>>(
          name,
          [take](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) take(text);
          },
          description)
      ->type_name(type_name)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

CLI::Option* add_number_option(CLI::App& app, const std::string& name, std::optional<double>& value,
                               const std::string& description, const std::string& expected,
                               bool (*inside)(double)) {
  return add_parsed_option(app, name, value, description, "NUMBER", expected,
                           [inside](const std::string& text) {
                             const auto number = parse_number(text);
                             return number && inside(*number) ? number : std::nullopt;
                           });
}

CLI::Option* add_integer_option(CLI::App& app, const std::string& name, std::optional<int>& value, int least,
                                const std::string& description, int most) {
  const std::string bounds = most < std::numeric_limits<int>::max()
                                 ? " from " + std::to_string(least) + " to " + std::to_string(most)
                                 : ", at least " + std::to_string(least);
  return add_parsed_option(app, name, value, description, "N", "a whole number" + bounds,
                           [least, most](const std::string& text) {
                             const auto number = parse_integer(text);
                             return number && *number >= least && *number <= most ? number : std::nullopt;
                           });
}

CLI::Option* add_choice_option(CLI::App& app, const std::string& name, std::string& value,
                               const std::string& words, const std::string& description) {
  return app
      .add_option_function<std::string>(
          name,
          [&value, name, words](const std::string& text) {
            if (text.empty() || text.find('|') != std::string::npos ||
                ("|" + words + "|").find("|" + text + "|") == std::string::npos) {
              throw WrongUsage(name + ": " + text + ": expected " + words);
            }
            value = text;
          },
          description)
      ->type_name(words);
}

CLI::Option* add_unit_option(CLI::App& app, std::optional<document::FrfUnit>& value,
                             const std::string& description) {
  return add_parsed_option(app, "--unit", value, description, "UNIT",
                           "a unit of a response over a force, as um/N or g/lbf",
                           [](const std::string& text) { return document::frf_unit(text); });
}

Tool::Tool(std::string name, std::string purpose, const std::string& example, std::string main_kind)
    : name_(std::move(name)),
      main_kind_(std::move(main_kind)),
      app_(std::move(purpose) + "\n\nExample: " + example, name_) {
  app_.formatter(std::make_shared<HelpFormatter>());
}

std::string Tool::advice(Remedy remedy) const {
  const std::string option = option_for(remedy);
  return option.empty() ? "" : " (" + option + ")";
}

CLI::Option* Tool::add_file_option(CLI::App& app, const std::string& name, std::string& path,
                                   const std::string& description) {
  CLI::Option* option = app.add_option(name, path, description)->type_name("FILE");
  not_in_provenance(option);
  return option;
}

document::Input Tool::read_part(const std::string& path) {
  document::Input input = read_input(path, InputForm::kJson);
  inputs_.pop_back();
  return input;
}

document::Input Tool::read_input(const std::string& path, InputForm form) {
  if (path == "-") {
    if (standard_input_taken_) throw WrongUsage("-: expected standard input for one input only");
    standard_input_taken_ = true;
    if (isatty(STDIN_FILENO) == 1) warn("reading standard input from the terminal: Ctrl-D ends it");
  }
  document::Input input{read_source(path), nullptr};
  const bool is_json =
      form == InputForm::kByContent ? looks_like_json(input.source.text) : form == InputForm::kJson;
  if (is_json) input.document = document::parse_json(input.source);
  inputs_.push_back(provenance_input(input.source, input.document));
  return input;
}

document::Input Tool::read_reference(const std::string& path, InputForm form) {
  document::Input input = read_input(path, form);
  inputs_.back().label.clear();
  return input;
}

std::string Tool::table_text(const document::Json& document) const {
  const std::vector<document::FlatTable> tables = document::flat_tables(document);
  if (csv_.empty()) return document::aligned_text(tables, kMostShown);
  std::string names;
  for (const document::FlatTable& table : tables) {
    if (table.name == csv_) return document::csv_text(table);
    names += (names.empty() ? "" : ", ") + table.name;
  }
  throw WrongUsage("--csv: " + csv_ + ": expected a table of this document: " + names);
}

void Tool::write_document(const std::string& path, document::Json document) {
  const std::string label = !label_.empty()              ? label_
                            : document.contains("label") ? ""
                                                         : inherited_label(inputs_);
  if (!label.empty()) document["label"] = label;
  // For who sees no document.
  if (path == output_ && output_ != "-" && !quiet_ && isatty(STDERR_FILENO) == 1)
    said_at_end_ = summary(document);
  if (as_table() && path == output_) {
    add_output(path, table_text(document));
    return;
  }
  if (!without_provenance_) {
    document["provenance"] = provenance(name_, STABLECUT_VERSION, result_arguments(), inputs_);
  }
  add_output(path, document::json_text(document));
}

void Tool::write_text(const std::string& path, std::string text) {
  if (as_table() && path == output_)
    throw WrongUsage(std::string(table_ ? "--as-table" : "--csv") +
                     ": expected an output that is a document");
  add_output(path, std::move(text));
}

void Tool::add_output(const std::string& path, std::string text) {
  const std::string whole = path == "-" ? path : file_of(path);
  if (std::find(output_paths_.begin(), output_paths_.end(), whole) != output_paths_.end()) {
    throw WrongUsage(path + ": expected another output for each document");
  }
  output_paths_.push_back(whole);
  outputs_.add(path, std::move(text));
}

void Tool::warn(const std::string& text) const {
  if (!quiet_) say(name_, "warning: " + text);
}

std::vector<std::string> Tool::result_arguments() const {
  std::vector<std::string> arguments;
  for (const CLI::Option* option : app_.get_options()) {
    if (option->count() == 0 || option->get_positional() ||
        std::find(silent_options_.begin(), silent_options_.end(), option) != silent_options_.end()) {
      continue;
    }
    arguments.push_back(option->get_name());
    if (option->get_expected_min() > 0) {
      for (const auto& text : option->results()) arguments.push_back(text);
    }
  }
  return arguments;
}

// Options that the tool does not have, and inputs that it does not take.
void Tool::refuse_unknown() const {
  const std::vector<std::string> unknown = app_.remaining();
  const auto option = std::find_if(unknown.begin(), unknown.end(),
                                   [](const std::string& text) { return text.size() > 1 && text[0] == '-'; });
  if (option == unknown.end()) {
    if (!unknown.empty())
      throw WrongUsage(unknown.front() + ": expected one input, " + input_ + " is another");
    return;
  }
  const std::string name = option->substr(0, option->find('='));
  std::string nearest;
  for (const CLI::Option* known : app_.get_options()) {
    for (const std::string& other : known->get_lnames()) {
      if (nearest.empty() || edits_between(name, "--" + other) < edits_between(name, nearest))
        nearest = "--" + other;
    }
  }
  const bool near = 2 * edits_between(name, nearest) < name.size();
  throw WrongUsage(name + ": unknown option" + (near ? ": expected " + nearest : ""));
}

int Tool::parse(int argc, char** argv) {
  app_.set_version_flag("--version", name_ + " " STABLECUT_VERSION, "Print the version and exit");
  app_.set_help_flag("-h,--help", "Print this help and exit");
  app_.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  app_.add_option("INPUT", input_, "Input file, - for standard input")->capture_default_str();
  add_file_option(app_, "-o,--output", output_, "Output file, - for standard output")->capture_default_str();
  setup(app_);
  begin_group(app_, "Every tool");
  app_.add_option("--label", label_, "What pictures call the result (default: the labels of the inputs)")
      ->type_name("TEXT");
  not_in_provenance(app_.add_flag("--quiet", quiet_, "No warnings, no progress bar, no summary"));
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  threads_ = static_cast<int>(cores);
  std::optional<int> threads;
  not_in_provenance(
      add_integer_option(app_, "--threads", threads, 1, "Threads to work with (default: all cores)"));
  not_in_provenance(app_.add_flag("--no-provenance", without_provenance_, "Leave the provenance out"));
  // cut-force has a --table of its own.
  const std::string names = app_.get_option_no_throw("--table") != nullptr ? "" : "--table,";
  CLI::Option* table = app_.add_flag(names + "--as-table", table_,
                                     "Write aligned text, to be read, in the place of the document");
  CLI::Option* csv =
      app_.add_option("--csv", csv_, "Write one table of the document as CSV in its place, such as limit")
          ->type_name("TABLE")
          ->excludes(table);
  not_in_provenance(table);
  not_in_provenance(csv);
  schema_option_ =
      app_.add_option("--print-schema", schema_,
                      "Print the JSON Schema of a document kind and exit (default: what the tool writes)")
          ->type_name("KIND")
          ->expected(0, 1);
  std::string shell;
  add_choice_option(app_, "--print-completion", shell, "bash|zsh",
                    "Print a script that completes this command in a shell and exit");
  app_.allow_extras();
  try {
    app_.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    outputs_.add("-", app_.help());
    return 1;
  } catch (const CLI::CallForVersion& version) {
    outputs_.add("-", std::string(version.what()) + "\n");
    return 1;
  } catch (const CLI::ParseError& error) {
    throw WrongUsage(error.what());
  }
  refuse_unknown();
  for (const CLI::Option* option : app_.get_options()) {
    const auto& texts = option->results();
    if (option != schema_option_ && std::find(texts.begin(), texts.end(), "") != texts.end()) {
      throw WrongUsage(option->get_name() + ": empty: expected a value");
    }
  }
  if (threads) threads_ = *threads;
  if (!shell.empty()) {
    outputs_.add("-", completion_text(app_, name_, shell));
    return 1;
  }
  if (schema_option_->count() > 0) {
    const std::string kind = schema_.empty() ? main_kind_ : schema_;
    const auto schema = document::schema_text(kind);
    if (!schema) {
      throw WrongUsage("--print-schema: " + kind + ": expected one of " + document::schema_kinds());
    }
    outputs_.add("-", std::string(*schema));
    return 1;
  }
  return 0;
}

int Tool::main(int argc, char** argv) {
  keep_memory();
  install_signal_handlers();
  install_memory_handler(name_);
  const auto end = [this](ExitStatus status, const std::string& text) {
    if (!text.empty()) say(name_, text);
    return static_cast<int>(status);
  };
  try {
    if (parse(argc, argv) == 0) run();
    outputs_.commit();
    if (!said_at_end_.empty()) say(name_, output_ + ": " + said_at_end_);
    return static_cast<int>(ExitStatus::kDone);
  } catch (const WrongUsage& wrong) {
    return end(wrong.status(), std::string(wrong.what()) + " (see " + name_ + " --help)");
  } catch (const Failure& failure) {
    return end(failure.status(), failure.what());
  } catch (const document::DataError& error) {
    return end(ExitStatus::kData, error.what() + advice(error.remedy()));
  } catch (const InvalidArgument& error) {
    return end(ExitStatus::kData, error.what());
  } catch (const NoAnswer& answer) {
    return end(ExitStatus::kNoAnswer, answer.what() + advice(answer.remedy()));
  } catch (const std::bad_alloc&) {
    return end(ExitStatus::kInternal, "out of memory");
  } catch (const std::exception& error) {
    return end(ExitStatus::kInternal, std::string("internal error: ") + error.what());
  }
}

}  // namespace stablecut::cli
