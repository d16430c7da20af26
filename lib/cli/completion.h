// Completion of a command line in a shell, from the options themselves.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace stablecut::cli {

/// A script for `shell`, "bash" or "zsh", that completes the tool's options, words of options that take one
/// of several, and files.
std::string completion_text(const CLI::App& app, const std::string& tool, const std::string& shell);

}  // namespace stablecut::cli
