#pragma once
#include <tinyxml2.h>

#include <string>

namespace verp::model {

/// Place and reason of malformed XML, in a user's terms. For a missing end, tinyxml2 names the line
/// of the enclosing element: for a robot, the first line.
struct Malformed {
  int line = 0;  ///< 0: the tags are correct
  std::string why;
};
Malformed find_malformed(const std::string& text);

/// Throws a LoadError for a text that tinyxml2 could not read into `document`.
[[noreturn]] void refuse_malformed(const std::string& path, const std::string& text,
                                   const tinyxml2::XMLDocument& document);

}  // namespace verp::model
