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

/// A node that said nothing, or the interface nothing of it.
class SilentError : public bus::DeviceError {
 public:
  using bus::DeviceError::DeviceError;
};

/// It answered, and that it does not do it.
class AbortedError : public bus::DeviceError {
 public:
  AbortedError(const std::string& line, canopen::Abort why) : DeviceError(line), why_(why) {}
  canopen::Abort why() const { return why_; }

 private:
  canopen::Abort why_;
};

/// What a node says of itself.
struct NodeIdentity {
  /// How far it was asked. Unless to the end, what is missing below is not known.
  enum class Asked : std::uint8_t {
    kToTheEnd,
    kFellSilent,   ///< it had answered, and then nothing more
    kInterrupted,  ///< by who asked
  };

  std::uint8_t node = 0;
  std::uint32_t device_type = 0;        ///< 1000h
  std::optional<std::uint32_t> vendor;  ///< 1018h:1, as all that follow: nothing if it refused
  std::optional<std::uint32_t> product;
  std::optional<std::uint32_t> revision;
  std::string name;  ///< 1008h; empty if it refused
  Asked asked = Asked::kToTheEnd;
};

/// What a Client asks through: an interface of this PC, or a bus of a test. A hal::CanBus.
class ClientBus {
 public:
  virtual ~ClientBus() = default;
  virtual bool send(const CanFrame& frame) = 0;
  virtual bool poll(CanFrame& frame, std::uint32_t timeout_us) = 0;
  virtual std::uint64_t now_us() = 0;
  virtual hal::CanErrors errors() const = 0;
  virtual bool connected() const = 0;
};
static_assert(hal::CanBus<ClientBus>);

/// "6064:0", as people write an object's address: both hexadecimal.
std::string to_text(canopen::Address at);

/// CANopen nodes on an interface, asked by SDO, one transfer at a time; the PC has no node id and
/// sends nothing else. What gets no answer within `timeout_us` is asked again. Throws
/// bus::DeviceError with the abort's reason, SilentError if nobody answers; LinkError from the
/// constructor.
///
/// The controller's node is asked by a channel of its own (plan::kToolSdo) where it has that: so
/// nobody who asks by the default one takes these answers for his.
class Client {
 public:
  static constexpr int kAttempts = 3;  ///< of a transfer that got no answer

  Client(const link::Endpoint& endpoint, std::uint32_t timeout_us);
  /// Over a port that stays the caller's, and outlives this; `endpoint` is what it was opened on.
  Client(link::CanPort& port, const link::Endpoint& endpoint, std::uint32_t timeout_us);
  /// Over a bus that stays the caller's likewise; `place` is what errors call it.
  Client(ClientBus& bus, std::string place, std::uint32_t timeout_us);
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// From when on `stop` says so, scan() and identify() ask nothing more.
  void stop_when(std::function<bool()> stop) { stop_ = std::move(stop); }

  /// Every node that answers a request for 1000h to each of the 127 ids within the timeout after
  /// the last one, by id; also one that says nothing more from then on.
  std::vector<NodeIdentity> scan();
  /// Nothing if nobody answers.
  std::optional<NodeIdentity> identify(std::uint8_t node, int attempts = kAttempts);
  std::vector<std::uint8_t> read(std::uint8_t node, canopen::Address at);
  void write(std::uint8_t node, canopen::Address at, const std::vector<std::uint8_t>& data);

  /// One expedited read without a second attempt; false if nobody answered.
  bool read_once(std::uint8_t node, canopen::Address at);

  const std::string& place() const { return place_; }

 private:
  /// By which channel.
  canopen::SdoChannel channel_to(std::uint8_t node);
  /// Why it failed; kNone: it did not.
  canopen::Abort upload(std::uint8_t node, canopen::Address at, int attempts,
                        std::vector<std::uint8_t>& data);
  /// Asks for the rest, until the node falls silent.
  void describe(NodeIdentity& identity);
  /// Who answers the request for 1000h, and with what; indexed by node.
  std::vector<std::optional<std::uint32_t>> device_types();
  [[noreturn]] void fail(std::uint8_t node, canopen::Address at, const char* what,
                         canopen::Abort why);

  std::unique_ptr<ClientBus> own_;
  ClientBus& bus_;
  app::CanMaster<ClientBus> master_;
  const std::uint32_t timeout_us_;
  std::string place_;
  std::function<bool()> stop_ = [] { return false; };
  std::optional<bool> has_own_channel_;  ///< the controller's node; nothing: not asked yet
};

}  // namespace verp::can
