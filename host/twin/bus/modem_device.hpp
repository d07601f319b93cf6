#pragma once
#include <cstdint>
#include <deque>
#include <string>

#include "host/twin/bus/device.hpp"

namespace verp::bus {

/// Control table of a radio modem, our own layout; comments give bytes. One Write sends a message
/// and one Read receives it.
namespace modem {
inline constexpr std::uint8_t kId = 202;          ///< next to the controller (200) and the clock
inline constexpr std::uint16_t kModel = 0x7604;   ///< ours, like those in control_table.hpp
inline constexpr std::uint16_t kMostData = 96;    ///< bytes
inline constexpr std::size_t kMostWaiting = 64;   ///< later messages are lost
inline constexpr std::uint8_t kEverybody = 0xFF;  ///< broadcast value of `to`
// Read only.
inline constexpr std::uint16_t kNumber = 256;     // 1, this modem's number: the `to` of others
inline constexpr std::uint16_t kMostBytes = 257;  // 1, largest message
inline constexpr std::uint16_t kSaid = 258;       // 2, messages sent; modulo
inline constexpr std::uint16_t kRefused = 260;    // 2, messages refused
inline constexpr std::uint16_t kHeard = 262;      // 2, messages received
inline constexpr std::uint16_t kMissed = 264;     // 2, messages lost for lack of room
// Outgoing message: a Write that covers say_size sends that many bytes of say_data.
inline constexpr std::uint16_t kTo = 272;       // 1, a modem or kEverybody
inline constexpr std::uint16_t kSaySize = 273;  // 1
inline constexpr std::uint16_t kSayData = 274;  // kMostData times 1
// Oldest received message, read only; `waiting` 0: there is none.
inline constexpr std::uint16_t kWaiting = 384;      // 1, with this one
inline constexpr std::uint16_t kHeardNumber = 385;  // 1, counts this modem's messages; modulo
inline constexpr std::uint16_t kHeardFrom = 386;    // 1
inline constexpr std::uint16_t kHeardSize = 387;    // 1
inline constexpr std::uint16_t kHeardData = 388;    // kMostData times 1
/// Writing the message's number removes it. Another number has no effect, so a Write may be
/// repeated.
inline constexpr std::uint16_t kTake = 488;  // 1
}  // namespace modem

class Aerial {
 public:
  virtual ~Aerial() = default;
  virtual std::uint8_t number() const = 0;
  virtual std::uint8_t most_bytes() const = 0;
  /// kDataRange: too long, or no such modem. kResultFail: queue full.
  virtual dxl::Error say(std::uint8_t to, const std::string& data) = 0;
  /// Calls the modem's hear() for each message received so far.
  virtual void listen() = 0;
};

/// A robot's radio on its servo bus; its messages take their bus time.
class ModemDevice final : public Device {
 public:
  /// `aerial` must outlive the device.
  ModemDevice(std::uint32_t baud, Aerial& aerial);

  void hear(std::uint8_t from, std::string data);

  void refresh(std::uint16_t address, std::uint16_t length) override;
  dxl::Error write(std::uint16_t address, std::span<const std::uint8_t> data) override;

 protected:
  void written(std::uint16_t address, std::uint16_t length) override;
  void restarted() override { inbox_.clear(); }

 private:
  struct Message {
    std::uint8_t number, from;
    std::string data;
  };

  void count(std::uint16_t address) { table_.set(address, table_.get(address) + 1); }
  void say();
  void take(std::uint8_t number);

  Aerial& aerial_;
  std::deque<Message> inbox_;
  std::uint8_t numbers_ = 0;
  dxl::Error said_ = dxl::Error::kNone;  ///< of the write in progress
};

}  // namespace verp::bus
