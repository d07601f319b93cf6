#pragma once
#include <string>
#include <string_view>

namespace verp::files {

/// The text as one field of a CSV file, RFC 4180: in quotes, its own quotes doubled, when it holds
/// a comma, a quote or a line break; else as it is. Names of joints come from a file, and may.
std::string csv_field(std::string_view text);

}  // namespace verp::files
