#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/protocol/canopen/dictionary.hpp"
#include "firmware/app/can_master.hpp"
#include "host/bus/client.hpp"
#include "host/link/can_port.hpp"

namespace verp::can {

/// A node that said nothing, or the interface nothing of it.
class SilentError : public bus::DeviceError {
 public:
  using bus::DeviceError::DeviceError;
};

/// What a node says of itself.
struct NodeIdentity {
  std::uint8_t node = 0;
  std::uint32_t device_type = 0;        ///< 1000h
  std::optional<std::uint32_t> vendor;  ///< 1018h:1, as all that follow: nothing if it did not say
  std::optional<std::uint32_t> product;
  std::optional<std::uint32_t> revision;
  std::string name;  ///< 1008h; empty if it did not say
};

/// "6064:0", as people write an object's address: both hexadecimal.
std::string to_text(canopen::Address at);

/// CANopen nodes on an interface, asked by SDO, one transfer at a time; the PC has no node id and
/// sends nothing else. What gets no answer within `timeout_us` is asked again. Throws
/// bus::DeviceError with the abort's reason, SilentError if nobody answers; LinkError from the
/// constructor.
class Client {
 public:
  static constexpr int kAttempts = 3;  ///< of a transfer that got no answer

  Client(const wire::Endpoint& endpoint, std::uint32_t timeout_us);
  /// Over a port that stays the caller's, and outlives this; `endpoint` is what it was opened on.
  Client(wire::CanPort& port, const wire::Endpoint& endpoint, std::uint32_t timeout_us);

  /// Every node that answers a request for 1000h to each of the 127 ids within the timeout after
  /// the last one, by id.
  std::vector<NodeIdentity> scan();
  /// Nothing if nobody answers.
  std::optional<NodeIdentity> identify(std::uint8_t node, int attempts = kAttempts);
  std::vector<std::uint8_t> read(std::uint8_t node, canopen::Address at);
  void write(std::uint8_t node, canopen::Address at, const std::vector<std::uint8_t>& data);

  /// One expedited read without a second attempt; false if nobody answered.
  bool read_once(std::uint8_t node, canopen::Address at);

  const std::string& place() const { return place_; }

 private:
  /// Why it failed; kNone: it did not.
  canopen::Abort upload(std::uint8_t node, canopen::Address at, int attempts,
                        std::vector<std::uint8_t>& data);
  std::optional<std::uint32_t> number(std::uint8_t node, canopen::Address at);
  NodeIdentity described(std::uint8_t node, std::uint32_t device_type);
  [[noreturn]] void fail(std::uint8_t node, canopen::Address at, const char* what,
                         canopen::Abort why);

  std::optional<wire::CanPort> own_;
  wire::CanPort& port_;
  app::CanMaster<wire::CanPort> master_;
  const std::uint32_t timeout_us_;
  std::string place_;
};

}  // namespace verp::can
