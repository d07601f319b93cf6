#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hal/contract/range_finder.hpp"

/// SCIP 2.0, the text protocol of Hokuyo's laser range finders: "Communication Protocol
/// Specification for SCIP2.0 Standard", C-42-03320B, 2006. A request is a line; a reply is the
/// request's echo, a status, lines of data, each with a sum, and an empty line.
namespace verp::link::scip {

/// The character after a line's data: its bytes' sum, six bits of it, from '0' on (section 7).
char sum_of(std::string_view data);
/// A number in characters of six bits each, from '0' on, the highest first (section 6). None: a
/// character is none of these.
std::optional<std::uint32_t> decoded(std::string_view characters);

/// Finds replies in bytes as they come. What is damaged is left out to the next empty line.
class Replies {
 public:
  struct Reply {
    std::string echo;    ///< the request, of a scan with how many are left
    std::string status;  ///< two characters: 00 good, 99 a scan, else what is wrong
    std::string data;    ///< of all further lines, without sums and ends; of a scan first its time
  };

  void add(const std::uint8_t* bytes, std::size_t size) {
    waiting_.append(reinterpret_cast<const char*>(bytes), size);
  }
  /// The next whole one. None: it takes more bytes.
  std::optional<Reply> next();
  std::uint32_t damaged() const { return damaged_; }

 private:
  std::string waiting_;
  std::uint32_t damaged_ = 0;
};

/// Of a reply to MD with status 99: time and ranges. False: that is no such scan, and `scan` is as
/// it was. Ranges below `least_mm` are errors of single steps (section 8) and become 0.
bool read_scan(const Replies::Reply& reply, std::uint16_t least_mm, hal::RangeScan& scan);

}  // namespace verp::link::scip
