#include "cli/completion.h"

#include <algorithm>
#include <vector>

namespace stablecut::cli {
namespace {

// An option as a shell sees it.
struct Completed {
  std::vector<std::string> names;  // with their dashes
  std::string words;               // what may follow it, by blanks; none: a file, or what only the user knows
  bool takes_value = false;
  bool takes_file = false;
  std::string description;
};

std::vector<Completed> options_of(const CLI::App& app) {
  std::vector<Completed> result;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) continue;
    Completed completed;
    for (const std::string& name : option->get_snames()) completed.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) completed.names.push_back("--" + name);
    completed.takes_value = option->get_expected_max() > 0;
    const std::string type = option->get_type_name();
    completed.takes_file = type == "FILE";
    if (completed.takes_value && type.find('|') != std::string::npos) {
      completed.words = type;
      std::replace(completed.words.begin(), completed.words.end(), '|', ' ');
    }
    completed.description = option->get_description();
    result.push_back(std::move(completed));
  }
  return result;
}

std::string joined(const std::vector<std::string>& parts, const char* separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

std::string bash_text(const std::vector<Completed>& options, const std::string& tool) {
  std::string function = "_" + tool, all, cases;
  std::replace(function.begin(), function.end(), '-', '_');
  for (const Completed& option : options) {
    all += (all.empty() ? "" : " ") + joined(option.names, " ");
    if (!option.takes_value) continue;
    const std::string reply = option.words.empty() ? (option.takes_file ? "compgen -f -- \"$word\"" : "true")
                                                   : "compgen -W '" + option.words + "' -- \"$word\"";
    cases += "    " + joined(option.names, "|") + ") mapfile -t COMPREPLY < <(" + reply + "); return ;;\n";
  }
  return "# bash completion for " + tool + ".\n" + function +
         "() {\n  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
         // --option=value is three words.
         "  if [[ $word == = ]]; then word=; elif [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD - "
         "2]}; fi\n"
         "  case $before in\n" +
         cases + "  esac\n  if [[ $word == -* ]]; then\n    mapfile -t COMPREPLY < <(compgen -W '" + all +
         "' -- \"$word\")\n  else\n    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n  fi\n}\n"
         "complete -o filenames -F " +
         function + " " + tool + "\n";
}

// A description within an argument of _arguments, within single quotes.
std::string zsh_quoted(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'')
      result += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      result += std::string("\\") + c;
    else
      result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string zsh_text(const std::vector<Completed>& options, const std::string& tool) {
  std::string text = "#compdef " + tool + "\n_arguments -s \\\n";
  for (const Completed& option : options) {
    const std::string value = !option.takes_value     ? ""
                              : !option.words.empty() ? ":word:(" + option.words + ")"
                              : option.takes_file     ? ":file:_files"
                                                      : ":value:";
    for (const std::string& name : option.names) {
      const bool may_be_joined = option.takes_value && name.starts_with("--");
      text += "  '*" + name + (may_be_joined ? "=" : "") + "[" + zsh_quoted(option.description) + "]" +
              value + "' \\\n";
    }
  }
  return text + "  '*:input:_files'\n";
}

}  // namespace

std::string completion_text(const CLI::App& app, const std::string& tool, const std::string& shell) {
  const std::vector<Completed> options = options_of(app);
  return shell == "zsh" ? zsh_text(options, tool) : bash_text(options, tool);
}

}  // namespace stablecut::cli
