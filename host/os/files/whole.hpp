#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// Files that are read and written as a whole. What to tell a person of one that is not is the
/// caller's: he knows what the file is for.
namespace verp::files {

/// What is read as a whole is smaller: a device may go on for ever.
inline constexpr std::size_t kMostBytes = 128U << 20;

/// Nothing: it can't be opened, or is larger than kMostBytes; errno says why.
std::optional<std::string> read(const std::filesystem::path& file);

/// False: not all of it could be written.
bool write(const std::filesystem::path& file, std::string_view bytes);

/// The same under a name of its own, which is then the file's: a reader never sees half of it, two
/// writers never mix, and of what could not be written nothing stays. A link stays one, to the new
/// bytes; a device or a pipe is written to.
bool replace(const std::filesystem::path& file, std::string_view bytes);

}  // namespace verp::files
