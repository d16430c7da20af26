#include "cli/help_formatter.h"

#include <sstream>

namespace stablecut::cli {
namespace {

constexpr std::size_t kColumns = 80;

}  // namespace

std::string wrapped(const std::string& text, std::size_t width) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!result.empty()) result += '\n';
    std::istringstream words(line);
    std::size_t column = 0;
    for (std::string word; words >> word;) {
      if (column > 0 && column + 1 + word.size() > width) {
        result += '\n';
        column = 0;
      }
      if (column > 0) result += ' ';
      result += word;
      column += (column > 0) + word.size();
    }
  }
  return result;
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped(app->get_description(), kColumns) + "\n";
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrapped(option->get_description(), kColumns - column_width_);
}

}  // namespace stablecut::cli
