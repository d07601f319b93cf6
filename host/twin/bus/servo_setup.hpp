#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/twin/bus/client.hpp"

/// A servo out of its box becomes one of a robot: found at whatever rate and id it has, given its
/// own, and its zero and direction measured by hand, torque off.
namespace verp::bus {

struct FoundServo {
  Identity identity;
  std::uint32_t baud = 0;
};

/// One register that was changed, or would be.
struct Change {
  std::string name;
  std::int64_t before = 0, after = 0;
};

/// A link on which servos of other rates may be. Throws what Client throws.
class SetupLine {
 public:
  /// `baud` is the rate the robot's bus has.
  SetupLine(const link::Endpoint& endpoint, std::uint32_t baud);

  /// A client at that rate; on a link without a rate always the same one.
  Client& at(std::uint32_t baud);
  /// All servos at the first rate at which one answers: the robot's, the factory's, then the rest.
  std::vector<FoundServo> find(const std::function<bool()>& give_up);

 private:
  link::Endpoint endpoint_;
  std::uint32_t baud_;
  std::optional<Client> client_;
};

/// Told of each register when it was written, or would be.
using Changed = std::function<void(const Change&)>;

/// Torque off, every reply given, no return delay, then `id` and `baud`; each is read back. Tells
/// `changed` at once of what was not so; with `dry_run` only that. Afterwards the servo is where
/// `servo` says. Throws DeviceError.
void configure(SetupLine& line, FoundServo& servo, std::uint8_t id, std::uint32_t baud,
               bool dry_run, const Changed& changed);

/// Present Position, the middle of some readings; counts. Throws DeviceError if it moves.
std::int32_t still_position(Client& client, std::uint8_t id);

/// Where the encoder stood at the joint's zero, and what makes that the model's count.
struct ZeroFix {
  std::int32_t count = 0;          ///< as it was read
  std::int32_t homing_before = 0;  ///< Homing Offset (20)
  std::int32_t homing_after = 0;   ///< with which the count is the model's
  std::int32_t model_offset = 0;   ///< `offset` of <verp:servo> with which the count is right
  bool servo_can = true;           ///< Homing Offset has room for it
};

/// Homing Offset counts in position mode only within a quarter turn (e-Manual, Homing Offset (20)).
inline constexpr std::int32_t kMostHoming = 1024;

ZeroFix zero_fix(Client& client, std::uint8_t id, std::int32_t count, std::int32_t model_count);
/// Writes homing_after and reads it back.
void write_homing(Client& client, std::uint8_t id, const ZeroFix& fix);

}  // namespace verp::bus
