#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/twin/bus/client.hpp"

/// Sets up a new servo: finds it at any baud rate and id, assigns its own, and measures zero and
/// direction by hand with torque off.
namespace verp::bus {

struct FoundServo {
  Identity identity;
  std::uint32_t baud = 0;
};

struct Change {
  std::string name;
  std::int64_t before = 0, after = 0;
};

/// A link whose servos may have different baud rates. Throws what Client throws.
class SetupLine {
 public:
  /// `baud`: the rate of the robot's bus.
  SetupLine(const link::Endpoint& endpoint, std::uint32_t baud,
            BusProtocol protocol = BusProtocol::kDynamixel2);

  /// Client at that rate; on a link without a rate, always the same client.
  Client& at(std::uint32_t baud);
  /// Servos at the first rate with an answer: robot's, factory's, others.
  std::vector<FoundServo> find(const std::function<bool()>& give_up);

 private:
  link::Endpoint endpoint_;
  std::uint32_t baud_;
  BusProtocol protocol_;
  std::optional<Client> client_;
};

using Changed = std::function<void(const Change&)>;

/// Sets torque off, all replies on, no return delay, `id` and `baud`; reads back. Calls `changed`
/// for each difference; `dry_run` writes nothing. Throws DeviceError.
void configure(SetupLine& line, FoundServo& servo, std::uint8_t id, std::uint32_t baud,
               bool dry_run, const Changed& changed);

bool is_stiff(Client& client, std::uint8_t id);

/// Median of several readings, counts. Throws DeviceError if the servo moves.
std::int32_t still_position(Client& client, std::uint8_t id);

/// Count at the joint's zero, and the correction to the model's count.
struct ZeroFix {
  std::int32_t count = 0;
  std::int32_t homing_before = 0;  ///< Homing Offset (20); Feetech: Offset (31)
  std::int32_t homing_after = 0;   ///< makes the count the model's
  std::int32_t model_offset = 0;   ///< alternative: `offset` of <verp:servo>
  bool servo_can = true;           ///< homing_after is within range
};

/// Limit of Homing Offset in position mode, a quarter turn (e-Manual, Homing Offset (20)).
inline constexpr std::int32_t kMostHoming = 1024;

ZeroFix zero_fix(Client& client, std::uint8_t id, std::int32_t count, std::int32_t model_count);
void write_homing(Client& client, std::uint8_t id, const ZeroFix& fix);

}  // namespace verp::bus
