#include "host/trace/record/compression.hpp"

#include <zstd.h>

#include "host/trace/record/mcap_format.hpp"

namespace verp::record::mcap {
namespace {

/// A walk of 20 s, 7.7 MB, chunks of 390 kB (November 2026): level 1 gives 1.47 MB in 12 ms, level
/// 3 1.40 MB in 17 ms, level 9 1.31 MB in 72 ms.
constexpr int kLevel = 1;

}  // namespace

std::string packed(std::string_view bytes) {
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size) != 0 || size >= bytes.size()) return {};
  frame.resize(size);
  return frame;
}

std::optional<std::string> unpacked(std::string_view compression, std::string_view frame,
                                    std::uint64_t size) {
  // Other writers may omit the content size.
  const std::uint64_t said = ZSTD_getFrameContentSize(frame.data(), frame.size());
  const bool fits = said == size || said == ZSTD_CONTENTSIZE_UNKNOWN;
  if (compression != kZstdName || !fits || size > kMostRecord) return std::nullopt;
  std::string bytes(size, '\0');
  const std::size_t got = ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size());
  if (ZSTD_isError(got) != 0 || got != size) return std::nullopt;
  return bytes;
}

}  // namespace verp::record::mcap
