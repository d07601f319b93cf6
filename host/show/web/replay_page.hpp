#pragma once
#include <filesystem>
#include <string>

/// A run to turn and scrub in any browser. The page holds all data and needs no server.
namespace verp::web {

struct Replay {
  std::string html;  ///< a section with its style and scripts; may be empty
  std::string note;  ///< one line that says what is missing; may be empty
};

/// The replay of a trace. Throws TraceError. Returns a note if three.js is not installed.
Replay replay_of(const std::filesystem::path& trace);

/// Wraps a section into a whole page.
std::string page_of(const std::string& title, const std::string& html);

}  // namespace verp::web
