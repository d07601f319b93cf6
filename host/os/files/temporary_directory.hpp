#pragma once
#include <filesystem>
#include <stdexcept>

namespace verp::files {

/// No file could be made; what() is one line with the remedy.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A new directory of our own, removed with all it holds: below TMPDIR, or below /tmp when that is
/// of no use. Throws FileError when neither will do.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace verp::files
