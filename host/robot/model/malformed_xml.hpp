#pragma once
#include <tinyxml2.h>

#include <string>

namespace verp::model {

/// Where and why a text is no well-formed XML, as a person would say it. tinyxml2 names the line of
/// the element that something is missing in: of a whole robot, its first.
struct Malformed {
  int line = 0;  ///< 0: nothing is wrong with its tags
  std::string why;
};
Malformed find_malformed(const std::string& text);

/// Throws a LoadError for a text that tinyxml2 could not read into `document`.
[[noreturn]] void refuse_malformed(const std::string& path, const std::string& text,
                                   const tinyxml2::XMLDocument& document);

}  // namespace verp::model
