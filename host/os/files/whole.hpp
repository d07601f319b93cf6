#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// How all of host/ reads and writes files; the rules for users are in host/guide/quick-start.md.
namespace verp::files {

/// Limit for reads, because a device may never end.
inline constexpr std::size_t kMostBytes = 128U << 20;

/// Nothing if it cannot be opened or exceeds kMostBytes; errno has the reason.
std::optional<std::string> read(const std::filesystem::path& file);

/// The result of a write: success, or an error with its remedy.
class [[nodiscard]] Trouble {
 public:
  Trouble() = default;
  explicit Trouble(int error) : error_(error) {}  ///< of errno

  bool any() const { return error_ != 0; }
  int error() const { return error_; }
  std::string what() const;  ///< "cannot be written: No space left on device"
  std::string fix() const;
  std::string text() const { return what() + "; " + fix(); }  ///< after "FILE: "

 private:
  int error_ = 0;
};

/// Makes a new file; never follows a link. A failed write leaves nothing.
Trouble create(const std::filesystem::path& file, std::string_view bytes);

/// The old or the new bytes are whole after a failure, a crash and a power cut; on return the new
/// ones are on the disk. A link stays a link, to the new bytes; a device or pipe is written
/// directly.
Trouble replace(const std::filesystem::path& file, std::string_view bytes);

/// A file on its way, for writers that have not all bytes at once: replace() in steps.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& file);
  ~NewFile();  ///< without keep(): nothing remains
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Success: part() can be written.
  Trouble trouble() const { return trouble_; }
  /// Write here; FILE.PID-N.part, or FILE itself if it is a device or a pipe.
  const std::filesystem::path& part() const { return part_; }
  bool is_direct() const { return direct_; }
  /// Call it when nobody writes to part() any more.
  Trouble keep();

 private:
  std::filesystem::path file_, part_;
  Trouble trouble_;
  int descriptor_ = -1;
  bool direct_ = false;
};

/// The file that a name stands for: follows links, unless another user could have put them there;
/// then nothing, and errno has the reason.
std::optional<std::filesystem::path> target_of(const std::filesystem::path& file);
/// Makes FILE.PID-N.part, new; -1: errno has the reason.
int open_part(const std::filesystem::path& file, std::filesystem::path& part);
/// Syncs the part, renames it, and syncs the folder. False: errno has the reason.
bool take_name(int part, const std::filesystem::path& from, const std::filesystem::path& file);

}  // namespace verp::files
