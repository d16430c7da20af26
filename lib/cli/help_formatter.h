// The text of --help, in lines of 80 columns.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace stablecut::cli {

/// The text with its words in lines of at most `width` characters (bytes); its own ends of lines stay. A
/// longer word has a line for itself.
std::string wrapped(const std::string& text, std::size_t width);

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace stablecut::cli
