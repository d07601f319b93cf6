#pragma once
#include <string>

#include "host/apps/cli/command.hpp"
#include "host/author/edit/document.hpp"

namespace verp::edit {

cli::Subcommand add_edit(CLI::App& root);

/// Parts below one, a line each, with what can be set of them: PATH=VALUE.
std::string show(const Document& document, int element);

}  // namespace verp::edit
