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

/// Throws LoadError for a text that tinyxml2 could not read.
[[noreturn]] void refuse_malformed(const std::string& path, const std::string& text,
                                   const tinyxml2::XMLDocument& document);

/// Fills `document`. Throws LoadError for a file that cannot be read, is longer than
/// files::kMostBytes or is malformed.
void load_xml(const std::string& path, tinyxml2::XMLDocument& document);

}  // namespace verp::model
