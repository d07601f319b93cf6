#pragma once
#include "host/tool/command.hpp"
#include "host/tool/walk_options.hpp"

namespace verp::tool {

/// `verp view` as both programs take it: this one, which hands it to the window's, and that.
CLI::App* declare_view(CLI::App& root, WalkOptions& options);

}  // namespace verp::tool
