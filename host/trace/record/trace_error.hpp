#pragma once
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace verp::record {

/// what() is one line: file, byte offset if known, problem, remedy.
class TraceError : public std::runtime_error {
 public:
  TraceError(const std::filesystem::path& file, std::uint64_t offset, const std::string& problem,
             const std::string& remedy)
      : std::runtime_error(file.string() + ": byte " + std::to_string(offset) + ": " + problem +
                           "; " + remedy),
        file_(file),
        offset_(offset) {}
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
