#pragma once
#include <string>
#include <string_view>

namespace verp::files {

/// Text as one CSV field (RFC 4180). A text with a comma, quote or line break is quoted, with inner
/// quotes doubled; joint names from a file may contain these.
std::string csv_field(std::string_view text);

}  // namespace verp::files
