#pragma once
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/app/bus_master.hpp"
#include "firmware/app/link_bus.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/system_clock.hpp"

namespace verp::bus {

/// A device that did not do what was asked: exit status 3. what() is one line with a remedy.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// It answered, and that it does not do it.
class RefusedError : public DeviceError {
 public:
  RefusedError(const std::string& line, dxl::Error error) : DeviceError(line), error_(error) {}
  dxl::Error error() const { return error_; }

 private:
  dxl::Error error_;
};

/// What a device says of itself when it is pinged.
struct Identity {
  std::uint8_t id = 0;
  std::uint16_t model = 0;
  std::uint8_t firmware = 0;
};

/// Dynamixel devices at the other end of a link, one request at a time. What gets no answer is
/// asked again; a reply that comes late does not say which request it answers, so that it is told
/// by its device and length, and waited for before something like it is asked. Throws DeviceError,
/// and LinkError from the constructor.
class Client {
 public:
  static constexpr int kAttempts = 3;  ///< of a request that got no answer

  /// `timeout_us` is what a reply may take beyond its own bytes.
  Client(const link::Endpoint& endpoint, std::uint32_t timeout_us);
  /// Over a link that stays the caller's, and outlives this; `endpoint` is what it was opened on.
  Client(link::Link& link, const link::Endpoint& endpoint, std::uint32_t timeout_us);

  /// Every device that answers a Ping to all, by id; waits as long as id 252 may take.
  std::vector<Identity> scan();
  std::optional<Identity> ping(std::uint8_t id, int attempts = kAttempts);
  std::vector<std::uint8_t> read(std::uint8_t id, std::uint16_t address, std::uint16_t length);
  void write(std::uint8_t id, std::uint16_t address, const std::vector<std::uint8_t>& data);

  /// One read without a second attempt; false if it failed.
  bool read_once(std::uint8_t id, std::uint16_t address, std::uint16_t length);

  /// The most times that one of the requests so far had to be made.
  int tries() const { return tries_; }
  const std::string& place() const { return text_; }
  const app::BusCounters& counters() const { return master_.counters(); }
  std::uint32_t crc_errors() const { return master_.crc_errors(); }
  hal::LinkErrors link_errors() const { return link_.errors(); }

 private:
  using Bus = app::LinkBus<link::Link, link::SystemClock>;
  struct Answer {
    std::uint8_t error = 0;
    std::vector<std::uint8_t> data;
  };
  /// Time a request may take: `bytes` on the wire in both directions, and the timeout.
  std::uint32_t patience_us(std::size_t bytes) const;
  /// Of `frame` bytes in the master's frame; `size`: the bytes of data a good answer has.
  std::optional<Answer> ask(std::uint8_t id, std::size_t frame, std::size_t size, int attempts);
  void drop_late();
  [[noreturn]] void silent(std::uint8_t id) const;
  void expect_good(std::uint8_t id, std::uint16_t address, const char* what,
                   const std::optional<Answer>& answer) const;

  void wait_for_somebody();

  /// Replies that are missing, and may still come.
  struct Owed {
    int replies = 0;
    std::uint8_t id = 0;
    std::size_t size = 0;
    std::uint32_t patience_us = 0;
  };

  std::string text_;    ///< of the endpoint
  std::uint32_t baud_;  ///< 0: the link has none
  std::uint32_t timeout_us_;
  link::SystemClock clock_;
  std::optional<link::Link> own_;
  link::Link& link_;
  Bus bus_;
  app::BusMaster<Bus> master_;
  Owed owed_;
  int tries_ = 0;
};

}  // namespace verp::bus
