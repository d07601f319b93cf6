#pragma once
#include <string>

#include "host/apps/cli/command.hpp"
#include "host/author/edit/document.hpp"

namespace verp::edit {

cli::Subcommand add_edit(CLI::App& root);

/// The parts below an element, one a line, with values as PATH=VALUE.
std::string show(const Document& document, int element);

}  // namespace verp::edit
