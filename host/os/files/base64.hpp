#pragma once
#include <string>
#include <string_view>

namespace verp::files {

/// Base64 text of `bytes` (RFC 4648), with padding.
std::string base64(std::string_view bytes);

}  // namespace verp::files
