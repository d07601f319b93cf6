#pragma once
#include <filesystem>
#include <string>

/// A run to turn and to scrub, in any browser, without a server: all is in the page.
namespace verp::web {

struct Replay {
  std::string html;  ///< a section of a page, with its style and scripts; empty: there is none
  std::string note;  ///< one line for people, of what is missing; empty: nothing
};

/// Of a trace. Throws TraceError. Without three.js on this PC there is a note instead.
Replay replay_of(const std::filesystem::path& trace);

/// A whole page around a section.
std::string page_of(const std::string& title, const std::string& html);

}  // namespace verp::web
