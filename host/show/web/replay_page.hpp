#pragma once
#include <filesystem>
#include <string>

/// A run to turn and scrub in any browser, without a server.
namespace verp::web {

struct Replay {
  std::string html;  ///< a section with its style and scripts; may be empty
  std::string note;  ///< what is missing, in one line; may be empty
};

/// Throws TraceError. Returns a note if three.js is not installed.
Replay replay_of(const std::filesystem::path& trace);

std::string page_of(const std::string& title, const std::string& html);

}  // namespace verp::web
