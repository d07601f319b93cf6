#pragma once
#include <string>
#include <string_view>

namespace verp::files {

/// One CSV field (RFC 4180), quoted if it has a comma, quote or line break.
std::string csv_field(std::string_view text);

}  // namespace verp::files
