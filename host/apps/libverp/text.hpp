#pragma once
#include <algorithm>
#include <cstddef>
#include <string_view>

namespace verp::abi {

/// Copies as much as fits, with a final zero.
template <std::size_t kSize>
void put_text(std::string_view from, char (&to)[kSize]) {
  const std::size_t length = std::min(from.size(), kSize - 1);
  std::copy_n(from.data(), length, to);
  to[length] = '\0';
}

}  // namespace verp::abi
