#pragma once
#include <string>
#include <vector>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/shell_words.hpp"

namespace verp::cli {

/// Declares a command of another program, with its description, in `verp` and in that program.
CLI::App* declare_other(CLI::App& root, const std::string& word);

/// For `verp`: the command starts its program.
Subcommand add_other(CLI::App& root, const std::string& word);

/// Replaces this process by the command's program, with the same arguments. Throws ToolError.
[[noreturn]] void start_other(const std::string& word);

/// Runs the command's program with these words to its end. Empty: it ended well; else its last
/// words, or why it did not start.
std::string trouble_of_other(const std::string& word, const std::vector<std::string>& words);

/// The words that these programs print with kShellWords; without programs that are not built.
std::vector<ShellWords> words_of_others();

}  // namespace verp::cli
