#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// Reads and writes whole files. The caller reports errors, because it knows the file's purpose.
namespace verp::files {

/// Limit for reads, because a device may never end.
inline constexpr std::size_t kMostBytes = 128U << 20;

/// Nothing if the file cannot be opened or exceeds kMostBytes; errno gives the reason.
std::optional<std::string> read(const std::filesystem::path& file);

bool write(const std::filesystem::path& file, std::string_view bytes);

/// Like write(), but through a temporary file that is then renamed. So a reader never sees half a
/// file, two writers never mix, and a failed write leaves nothing. A link stays a link, to the new
/// bytes; a device or pipe is written directly.
bool replace(const std::filesystem::path& file, std::string_view bytes);

}  // namespace verp::files
