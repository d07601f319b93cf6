#pragma once
#include <string>
#include <string_view>

namespace verp::files {

/// Bytes as text (RFC 4648), with its padding.
std::string base64(std::string_view bytes);

}  // namespace verp::files
