#pragma once
#include <tinyxml2.h>

#include <string>

namespace verp::model {

/// Place and reason for the user. tinyxml2 names a missing end by the enclosing element's line: for
/// a robot, the first.
struct Malformed {
  int line = 0;  ///< 0: tags are correct
  std::string why;
};
Malformed find_malformed(const std::string& text);

/// Fills `document`, and returns the text as UTF-8 (encoding.hpp). Throws LoadError for a text that
/// is malformed, empty or in another encoding.
std::string parse_xml(const std::string& path, const std::string& bytes,
                      tinyxml2::XMLDocument& document);

/// Fills `document`. Throws LoadError for a file that cannot be read, is longer than
/// files::kMostBytes or is refused by parse_xml().
void load_xml(const std::string& path, tinyxml2::XMLDocument& document);

}  // namespace verp::model
