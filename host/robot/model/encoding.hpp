#pragma once
#include <string>

/// Files of other makers as UTF-8, which all that reads and writes them expects.
namespace verp::model {

/// Converts ISO-8859-1, windows-1252 and UTF-16, and the name of the encoding in the text with
/// them; lines stay. Throws LoadError for other encodings.
std::string utf8_of(const std::string& path, std::string bytes);

/// Throws LoadError at the first line that is no UTF-8.
void require_utf8(const std::string& path, const std::string& text);

}  // namespace verp::model
