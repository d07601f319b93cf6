#pragma once
#include <concepts>
#include <cstdint>
#include <string>

#include "host/os/link/link.hpp"
#include "host/os/link/scip.hpp"
#include "host/os/link/system_clock.hpp"

namespace verp::link {

/// A Hokuyo as hal/contract/range_finder.hpp. Endless scans, requested again after a silence. Now:
/// ns.
template <std::derived_from<hal::ByteLink> Line, std::uint64_t (*Now)() = monotonic_ns>
class ScipRangeFinder {
 public:
  struct Steps {
    int first = 44, last = 725;     ///< URG-04LX: 240 degrees, right to left
    std::uint16_t least_mm = 20;    ///< DMIN of PP; smaller values are errors
    std::uint32_t silent_ms = 500;  ///< scan: 100 ms; start: two scans
  };

  ScipRangeFinder(Line& line, Steps steps) : line_(line), steps_(steps) {}

  // RangeFinder
  hal::RangeStatus read(hal::RangeScan& scan) {
    take_bytes();
    hal::RangeStatus status = hal::RangeStatus::kStale;
    while (auto reply = replies_.next()) {
      if (scip::read_scan(*reply, steps_.least_mm, scan)) {
        heard_ns_ = Now();
        status = hal::RangeStatus::kFresh;
      } else if (is_ill(*reply)) {
        asked_ = false;
      }
    }
    if (status == hal::RangeStatus::kFresh) return status;
    if (asked_ && Now() - heard_ns_ < std::uint64_t{1'000'000} * steps_.silent_ms) return status;
    const bool first = heard_ns_ == 0;
    ask();
    if (first) return status;
    ++faults_;
    return hal::RangeStatus::kFault;
  }
  std::uint32_t faults() const { return faults_; }

  const std::string& last_complaint() const { return complaint_; }
  std::uint32_t damaged() const { return replies_.damaged(); }

  void stop() { send("QT\n"); }

 private:
  void take_bytes() {
    std::uint8_t bytes[4096];
    std::size_t size = 0;
    while ((size = line_.read(bytes, sizeof bytes, 0)) > 0) replies_.add(bytes, size);
  }
  bool is_ill(const scip::Replies::Reply& reply) {
    // Status 02: the laser is already on.
    if (reply.status == "00" || reply.status == "99" ||
        (reply.echo.starts_with("BM") && reply.status == "02"))
      return false;
    complaint_ = reply.echo + " " + reply.status;
    return reply.echo.starts_with("MD");
  }
  /// Switches from SCIP 1.1 to 2.0, laser on, endless scans of single steps.
  void ask() {
    const auto digits = [](int value) {
      const std::string text = std::to_string(value);
      return std::string(text.size() < 4 ? 4 - text.size() : 0, '0') + text;
    };
    send("SCIP2.0\nBM\nMD" + digits(steps_.first) + digits(steps_.last) + "01000\n");
    asked_ = true;
    heard_ns_ = Now();
  }
  void send(const std::string& text) {
    line_.write(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), 0);
  }

  Line& line_;
  const Steps steps_;
  scip::Replies replies_;
  std::string complaint_;
  std::uint64_t heard_ns_ = 0;
  std::uint32_t faults_ = 0;
  bool asked_ = false;
};

static_assert(hal::RangeFinder<ScipRangeFinder<Link>>);

}  // namespace verp::link
