#pragma once
#include <string>

#include "host/apps/cli/command.hpp"
#include "host/apps/tool/walk_options.hpp"

namespace verp::tool {

struct ViewOptions {
  WalkOptions walk;
  std::string link, gamepad = "/dev/input/js0";
};

/// Declared for this program and the window's.
CLI::App* declare_view(CLI::App& root, ViewOptions& options);

}  // namespace verp::tool
