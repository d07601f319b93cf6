#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hal/contract/range_finder.hpp"

/// SCIP 2.0 of Hokuyo's lasers ("Communication Protocol Specification for SCIP2.0 Standard",
/// C-42-03320B, 2006). A request is a line. A reply is the request's echo, a status, data lines
/// with a checksum each, and an empty line.
namespace verp::link::scip {

/// Low six bits of the bytes' sum, plus '0' (section 7).
char sum_of(std::string_view data);
/// Decodes six bits a character, offset '0', highest first (section 6).
std::optional<std::uint32_t> decoded(std::string_view characters);

/// Skips damage to the next empty line.
class Replies {
 public:
  struct Reply {
    std::string echo;    ///< request; a scan's has the remaining count
    std::string status;  ///< 00 good, 99 a scan, else an error
    std::string data;    ///< without checksums and line ends; a scan's time is first
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

/// Reads a reply to MD with status 99. False: another reply; `scan` is unchanged. Ranges below
/// `least_mm` are errors (section 8) and become 0.
bool read_scan(const Replies::Reply& reply, std::uint16_t least_mm, hal::RangeScan& scan);

}  // namespace verp::link::scip
