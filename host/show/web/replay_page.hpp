#pragma once
#include <filesystem>
#include <string>

#include "host/robot/model/entity.hpp"

namespace verp::web {

struct Replay {
  std::string html;  ///< with style and scripts; may be empty
  std::string note;  ///< missing parts; may be empty
};

/// Throws TraceError. A note: three.js is missing. Null: the robot of the trace.
Replay replay_of(const std::filesystem::path& trace, const model::Entity* robot = nullptr);

std::string page_of(const std::string& title, const std::string& html);

}  // namespace verp::web
