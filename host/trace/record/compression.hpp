#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Chunks of MCAP files, compressed as its specification has it.
namespace verp::record::mcap {

inline constexpr std::string_view kZstdName = "zstd";

/// As one zstd frame; empty where that is no shorter.
std::string packed(std::string_view bytes);

/// The `size` bytes that a frame of that compression holds; nothing when it is damaged, of another
/// size, or of another compression than zstd.
std::optional<std::string> unpacked(std::string_view compression, std::string_view frame,
                                    std::uint64_t size);

}  // namespace verp::record::mcap
