#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// The caller reports errors, because it knows the file's purpose.
namespace verp::files {

/// Limit for reads, because a device may never end.
inline constexpr std::size_t kMostBytes = 128U << 20;

/// Nothing if it cannot be opened or exceeds kMostBytes; errno has the reason.
std::optional<std::string> read(const std::filesystem::path& file);

bool write(const std::filesystem::path& file, std::string_view bytes);

/// Writes through a temporary file that is then renamed: a reader never sees half a file, and a
/// failed write leaves nothing. A link stays a link, to the new bytes; a device or pipe is written
/// directly.
bool replace(const std::filesystem::path& file, std::string_view bytes);

}  // namespace verp::files
