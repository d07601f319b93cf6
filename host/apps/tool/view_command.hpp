#pragma once
#include <string>

#include "host/apps/cli/command.hpp"
#include "host/apps/tool/walk_options.hpp"

namespace verp::tool {

/// The command line of `verp view`.
struct ViewOptions {
  WalkOptions walk;
  std::string link, gamepad = "/dev/input/js0";
};

/// `verp view` as both programs take it: this one, which hands it to the window's, and that.
CLI::App* declare_view(CLI::App& root, ViewOptions& options);

}  // namespace verp::tool
