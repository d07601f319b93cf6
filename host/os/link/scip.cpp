#include "host/os/link/scip.hpp"

#include <utility>

namespace verp::link::scip {
namespace {

constexpr char kFirst = '0';
constexpr std::uint32_t kSixBits = 0x3F;
// The longest scan: 1128 steps of 3 characters, plus 53 sums and line ends.
constexpr std::size_t kLongest = 8192;

/// The line without its checksum; nothing if the checksum is wrong.
std::optional<std::string_view> checked(std::string_view line) {
  if (line.empty()) return std::nullopt;
  const std::string_view data = line.substr(0, line.size() - 1);
  return sum_of(data) == line.back() ? std::optional(data) : std::nullopt;
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + 1);
  return line;
}

std::optional<Replies::Reply> parse(std::string_view text) {
  Replies::Reply reply;
  reply.echo = take_line(text);
  const auto status = checked(take_line(text));
  if (!status || status->size() != 2) return std::nullopt;
  reply.status = *status;
  while (!text.empty()) {
    const auto data = checked(take_line(text));
    if (!data) return std::nullopt;
    reply.data += *data;
  }
  return reply;
}

}  // namespace

char sum_of(std::string_view data) {
  std::uint32_t sum = 0;
  for (const char c : data) sum += static_cast<std::uint8_t>(c);
  return static_cast<char>((sum & kSixBits) + static_cast<std::uint32_t>(kFirst));
}

std::optional<std::uint32_t> decoded(std::string_view characters) {
  std::uint32_t value = 0;
  for (const char c : characters) {
    const auto six = static_cast<std::uint32_t>(static_cast<std::uint8_t>(c)) -
                     static_cast<std::uint32_t>(kFirst);
    if (six > kSixBits) return std::nullopt;
    value = value << 6 | six;
  }
  return value;
}

std::optional<Replies::Reply> Replies::next() {
  for (;;) {
    const std::size_t end = waiting_.find("\n\n");
    if (end == std::string::npos) {
      if (waiting_.size() <= kLongest) return std::nullopt;
      waiting_.clear();  // not this protocol
      ++damaged_;
      return std::nullopt;
    }
    auto reply = parse(std::string_view(waiting_).substr(0, end));
    waiting_.erase(0, end + 2);
    if (reply) return reply;
    ++damaged_;
  }
}

bool read_scan(const Replies::Reply& reply, std::uint16_t least_mm, hal::RangeScan& scan) {
  constexpr std::size_t kTime = 4, kRange = 3;
  if (!reply.echo.starts_with("MD") || reply.status != "99") return false;
  const std::string_view data = reply.data;
  if (data.size() <= kTime || (data.size() - kTime) % kRange != 0) return false;
  const std::size_t steps = (data.size() - kTime) / kRange;
  const auto time_ms = decoded(data.substr(0, kTime));
  if (!time_ms || steps > hal::kMostRangeSteps) return false;
  hal::RangeScan read;
  read.time_us = std::uint64_t{1000} * *time_ms;
  read.steps = steps;
  for (std::size_t i = 0; i < steps; ++i) {
    const auto range_mm = decoded(data.substr(kTime + kRange * i, kRange));
    if (!range_mm) return false;
    const bool good = *range_mm >= least_mm && *range_mm <= 0xFFFF;
    read.range_mm[i] = good ? static_cast<std::uint16_t>(*range_mm) : std::uint16_t{0};
  }
  scan = read;
  return true;
}

}  // namespace verp::link::scip
