#pragma once
#include <cstdint>
#include <deque>
#include <string>

#include "host/twin/bus/device.hpp"

namespace verp::bus {

/// A radio modem's control table: ours, in Protocol 2.0 as servos and sensors are. Bytes behind
/// each; all that a program needs for one message stands side by side, so that one Write says it
/// and one Read has it.
namespace modem {
inline constexpr std::uint8_t kId = 202;          ///< next to the controller (200) and the clock
inline constexpr std::uint16_t kModel = 0x7604;   ///< ours, as those in control_table.hpp
inline constexpr std::uint16_t kMostData = 96;    ///< bytes of a message that it has room for
inline constexpr std::size_t kMostWaiting = 64;   ///< messages that it keeps; later ones are lost
inline constexpr std::uint8_t kEverybody = 0xFF;  ///< of `to`
// Read only.
inline constexpr std::uint16_t kNumber = 256;     // 1, its own, by which others say `to`
inline constexpr std::uint16_t kMostBytes = 257;  // 1, of a message
inline constexpr std::uint16_t kSaid = 258;       // 2, messages that went on their way; modulo
inline constexpr std::uint16_t kRefused = 260;    // 2, that did not
inline constexpr std::uint16_t kHeard = 262;      // 2, that it heard
inline constexpr std::uint16_t kMissed = 264;     // 2, that it had no room for
// What is to be said. A Write that covers say_size says it: so many bytes of say_data, as they
// stand then.
inline constexpr std::uint16_t kTo = 272;       // 1, number of a modem, or kEverybody
inline constexpr std::uint16_t kSaySize = 273;  // 1
inline constexpr std::uint16_t kSayData = 274;  // kMostData times 1
// The first message that was heard and not taken; `waiting` 0: there is none. Read only.
inline constexpr std::uint16_t kWaiting = 384;      // 1, this one counted
inline constexpr std::uint16_t kHeardNumber = 385;  // 1, counts this modem's messages; modulo
inline constexpr std::uint16_t kHeardFrom = 386;    // 1
inline constexpr std::uint16_t kHeardSize = 387;    // 1
inline constexpr std::uint16_t kHeardData = 388;    // kMostData times 1
/// Written with that message's number it makes room for the next one; with another number it does
/// nothing, so that a Write whose answer was lost may be repeated.
inline constexpr std::uint16_t kTake = 488;  // 1
}  // namespace modem

/// The air, as one modem reaches it.
class Aerial {
 public:
  virtual ~Aerial() = default;
  virtual std::uint8_t number() const = 0;
  virtual std::uint8_t most_bytes() const = 0;
  /// kNone: it is on its way. kDataRange: it is too long, or there is nobody of that number;
  /// kResultFail: too many wait.
  virtual dxl::Error say(std::uint8_t to, const std::string& data) = 0;
  /// Hands the modem by hear() what came up to now.
  virtual void listen() = 0;
};

/// The radio of a robot on its bus, beside the servos: what it says and hears takes its bytes' time
/// there.
class ModemDevice final : public Device {
 public:
  /// The aerial outlives it.
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
  dxl::Error said_ = dxl::Error::kNone;  ///< of the write that is under way
};

}  // namespace verp::bus
