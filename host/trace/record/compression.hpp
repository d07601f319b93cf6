#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Compressed chunks, as MCAP defines them.
namespace verp::record::mcap {

inline constexpr std::string_view kZstdName = "zstd";

/// One zstd frame, or empty if it is not shorter.
std::string packed(std::string_view bytes);

/// nullopt: damaged, another size, or not zstd.
std::optional<std::string> unpacked(std::string_view compression, std::string_view frame,
                                    std::uint64_t size);

}  // namespace verp::record::mcap
