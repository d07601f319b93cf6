#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/dictionary.hpp"
#include "firmware/app/can_master.hpp"
#include "host/os/link/can_port.hpp"
#include "host/twin/bus/client.hpp"

namespace verp::can {

class SilentError : public bus::DeviceError {
 public:
  using bus::DeviceError::DeviceError;
};

class AbortedError : public bus::DeviceError {
 public:
  AbortedError(const std::string& line, canopen::Abort why) : DeviceError(line), why_(why) {}
  canopen::Abort why() const { return why_; }

 private:
  canopen::Abort why_;
};

struct NodeIdentity {
  /// How far the identification came. Fields not reached are unknown.
  enum class Asked : std::uint8_t {
    kToTheEnd,
    kFellSilent,   ///< it stopped answering
    kInterrupted,  ///< by the caller
  };

  std::uint8_t node = 0;
  std::uint32_t device_type = 0;        ///< 1000h
  std::optional<std::uint32_t> vendor;  ///< 1018h:1; as the next two, nothing if refused
  std::optional<std::uint32_t> product;
  std::optional<std::uint32_t> revision;
  std::string name;  ///< 1008h; empty if the node refused
  Asked asked = Asked::kToTheEnd;
};

/// An interface of this PC or a test's bus.
class ClientBus : public hal::CanBus {
 public:
  virtual ~ClientBus() = default;
  virtual bool connected() const = 0;
};

/// "6064:0", the usual form of an object's address; both parts are hexadecimal.
std::string to_text(canopen::Address at);

/// SDO client for the nodes on an interface, one transfer at a time. It repeats a request without
/// an answer within `timeout_us`. Throws bus::DeviceError with the abort's reason, SilentError
/// without an answer; the constructor throws LinkError. It asks the controller's node over a
/// channel of its own (plan::kToolSdo).
class Client {
 public:
  static constexpr int kAttempts = 3;  ///< per unanswered transfer

  Client(const link::Endpoint& endpoint, std::uint32_t timeout_us);
  /// The caller owns the port, which must outlive the client; `endpoint` is its place.
  Client(link::CanPort& port, const link::Endpoint& endpoint, std::uint32_t timeout_us);
  Client(ClientBus& bus, std::string place, std::uint32_t timeout_us);
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// scan() and identify() stop sending once `stop` returns true.
  void stop_when(std::function<bool()> stop) { stop_ = std::move(stop); }

  /// Requests 1000h from all 127 ids; returns, by id, the nodes that answer in time.
  std::vector<NodeIdentity> scan();
  std::optional<NodeIdentity> identify(std::uint8_t node, int attempts = kAttempts);
  std::vector<std::uint8_t> read(std::uint8_t node, canopen::Address at);
  void write(std::uint8_t node, canopen::Address at, const std::vector<std::uint8_t>& data);

  /// One expedited read without retry; false: no answer.
  bool read_once(std::uint8_t node, canopen::Address at);

  const std::string& place() const { return place_; }

 private:
  canopen::SdoChannel channel_to(std::uint8_t node);
  /// Reason of the failure; kNone: success.
  canopen::Abort upload(std::uint8_t node, canopen::Address at, int attempts,
                        std::vector<std::uint8_t>& data);
  /// Reads the remaining objects until the node falls silent.
  void describe(NodeIdentity& identity);
  /// Indexed by node.
  std::vector<std::optional<std::uint32_t>> device_types();
  [[noreturn]] void fail(std::uint8_t node, canopen::Address at, const char* what,
                         canopen::Abort why);

  std::unique_ptr<ClientBus> own_;
  ClientBus& bus_;
  app::CanMaster master_;
  const std::uint32_t timeout_us_;
  std::string place_;
  std::function<bool()> stop_ = [] { return false; };
  std::optional<bool> has_own_channel_;  ///< nothing: not asked yet
};

}  // namespace verp::can
