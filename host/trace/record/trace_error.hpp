#pragma once
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace verp::record {

/// A trace that cannot be read or written. what() is one line: file, byte offset if it is about
/// one, what is wrong, how to fix it.
class TraceError : public std::runtime_error {
 public:
  TraceError(const std::filesystem::path& file, std::uint64_t offset, const std::string& problem,
             const std::string& remedy)
      : std::runtime_error(file.string() + ": byte " + std::to_string(offset) + ": " + problem +
                           "; " + remedy),
        file_(file),
        offset_(offset) {}
  /// Of the file itself: no byte of it is to blame.
  TraceError(const std::filesystem::path& file, const std::string& problem,
             const std::string& remedy)
      : std::runtime_error(file.string() + ": " + problem + "; " + remedy), file_(file) {}

  const std::filesystem::path& file() const { return file_; }
  std::uint64_t offset() const { return offset_; }

 private:
  std::filesystem::path file_;
  std::uint64_t offset_ = 0;
};

}  // namespace verp::record
