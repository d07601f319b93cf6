#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/link_bus.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/twin/bus/client_words.hpp"

namespace verp::bus {

/// Exit status 3. what() is one line with a remedy.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class RefusedError : public DeviceError {
 public:
  RefusedError(const std::string& line, dxl::Error error) : DeviceError(line), error_(error) {}
  dxl::Error error() const { return error_; }

 private:
  dxl::Error error_;
};

struct Identity {
  std::uint8_t id = 0;
  std::uint16_t model = 0;
  std::uint8_t firmware = 0;
};

/// Client for the devices of a serial protocol; one request at a time. A late reply does not name
/// its request: the client knows it by device and length, and waits for it before a similar
/// request. Methods throw DeviceError; the constructor throws LinkError.
class Client {
 public:
  static constexpr int kAttempts = 3;  ///< per unanswered request

  /// `timeout_us`: in addition to the reply's own bytes.
  Client(const link::Endpoint& endpoint, std::uint32_t timeout_us,
         BusProtocol protocol = BusProtocol::kDynamixel2);
  /// The caller owns the link, which must outlive the client; `endpoint` is its place.
  Client(link::Link& link, const link::Endpoint& endpoint, std::uint32_t timeout_us,
         BusProtocol protocol = BusProtocol::kDynamixel2);

  BusProtocol protocol() const { return words_->protocol(); }
  /// Every device that answers a broadcast Ping, sorted by id; noise among the answers repeats
  /// it. Feetech servos collide there: each id is asked, once.
  std::vector<Identity> scan();
  std::optional<Identity> ping(std::uint8_t id, int attempts = kAttempts);
  std::vector<std::uint8_t> read(std::uint8_t id, std::uint16_t address, std::uint16_t length);
  void write(std::uint8_t id, std::uint16_t address, const std::vector<std::uint8_t>& data);

  /// Without a retry; false: it failed.
  bool read_once(std::uint8_t id, std::uint16_t address, std::uint16_t length);

  int tries() const { return tries_; }
  const std::string& place() const { return text_; }
  const app::BusCounters& counters() const { return words_->counters(); }
  std::uint32_t crc_errors() const { return words_->damaged(); }
  hal::LinkErrors link_errors() const { return link_.errors(); }

 private:
  using Bus = app::LinkBus<link::Link, link::SystemClock>;
  struct Answer {
    std::uint8_t error = 0;
    std::vector<std::uint8_t> data;
  };
  /// `bytes` on the wire in both directions, plus the timeout.
  std::uint32_t patience_us(std::size_t bytes) const;
  /// `frame`: bytes of the request. `size`: data bytes of the answer.
  std::optional<Answer> ask(std::uint8_t id, std::size_t frame, std::size_t size, int attempts);
  void drop_late();
  void scan_once(std::vector<Identity>& found);
  std::vector<Identity> scan_each();
  std::optional<Identity> identify_feetech(std::uint8_t id, int attempts);
  [[noreturn]] void silent(std::uint8_t id) const;
  void expect_good(std::uint8_t id, std::uint16_t address, const char* what,
                   const std::optional<Answer>& answer) const;

  void wait_for_somebody();

  struct Owed {
    int replies = 0;
    std::uint8_t id = 0;
    std::size_t size = 0;
    std::uint32_t patience_us = 0;
  };

  std::string text_;
  std::uint32_t baud_;  ///< 0: the link has no rate
  std::uint32_t timeout_us_;
  link::SystemClock clock_;
  std::optional<link::Link> own_;
  link::Link& link_;
  Bus bus_;
  std::unique_ptr<ClientWords> words_;
  Owed owed_;
  int tries_ = 0;
};

}  // namespace verp::bus
