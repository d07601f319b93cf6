#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hal/contract/range_finder.hpp"

/// SCIP 2.0, the text protocol of Hokuyo's laser range finders ("Communication Protocol
/// Specification for SCIP2.0 Standard", C-42-03320B, 2006). A request is a line. A reply is the
/// request's echo, a status, data lines with a checksum each, and an empty line.
namespace verp::link::scip {

/// Checksum character of a line: the low six bits of the sum of its bytes, plus '0' (section 7).
char sum_of(std::string_view data);
/// Decodes a number from characters of six bits each, offset '0', highest first (section 6).
/// Nothing if a character is invalid.
std::optional<std::uint32_t> decoded(std::string_view characters);

/// Extracts replies from a byte stream. Skips damaged data to the next empty line.
class Replies {
 public:
  struct Reply {
    std::string echo;    ///< the request; for a scan with the remaining count
    std::string status;  ///< two characters: 00 good, 99 a scan, else an error
    std::string data;    ///< all further lines without checksums and line ends; for a scan, its
                         ///< time first
  };

  void add(const std::uint8_t* bytes, std::size_t size) {
    waiting_.append(reinterpret_cast<const char*>(bytes), size);
  }
  /// Next complete reply; nothing if more bytes are needed.
  std::optional<Reply> next();
  std::uint32_t damaged() const { return damaged_; }

 private:
  std::string waiting_;
  std::uint32_t damaged_ = 0;
};

/// Reads time and ranges from a reply to MD with status 99. False: not such a scan; `scan` is
/// unchanged. Ranges below `least_mm` are errors of single steps (section 8) and become 0.
bool read_scan(const Replies::Reply& reply, std::uint16_t least_mm, hal::RangeScan& scan);

}  // namespace verp::link::scip
