#include <cstdint>

#include "common/model/counts.hpp"
#include "common/model/params.hpp"
#include "common/protocol/feetech_table.hpp"
#include "firmware/app/bring_up_report.hpp"
#include "firmware/app/feetech_servos.hpp"
#include "firmware/app/servo_ram.hpp"

namespace verp::app {
namespace {

namespace mem = feetech::address;

/// Min and Max Position Limit, one count beyond the joint's limits, within the turn.
struct PositionLimits {
  explicit PositionLimits(const JointParams& joint) {
    const std::int32_t a = model::count_of(joint, joint.lower_rad);
    const std::int32_t b = model::count_of(joint, joint.upper_rad);
    feetech::put_u16(bytes, in_turn((a < b ? a : b) - 1));
    feetech::put_u16(bytes + 2, in_turn((a < b ? b : a) + 1));
  }
  std::uint8_t bytes[4];

 private:
  static std::uint32_t in_turn(std::int32_t count) {
    constexpr std::int32_t kLast = feetech::kCountsPerTurn - 1;
    return static_cast<std::uint32_t>(count < 0 ? 0 : count > kLast ? kLast : count);
  }
};

class FeetechBringUp {
 public:
  FeetechBringUp(const Params& params, FeetechMaster& master) : params_(params), master_(master) {}

  BringUpReport run() {
    release_all();
    for (int j = 0; j < params_.servo_count() && ready(); ++j) servo(j);
    if (params_.imu.device_id != 0 && ready()) sensor(params_.imu.device_id, feetech::kModelImu);
    for (const std::uint8_t id : params_.feet.device_id) {
      if (id != 0 && ready()) sensor(id, feetech::kModelFoot);
    }
    if (!ready()) release_all();
    return report_;
  }

 private:
  static constexpr int kAttempts = 3;
  static constexpr std::size_t kMostBytes = 8;
  /// A write to EEPROM may delay the answer; an allowance, Feetech publishes nothing.
  static constexpr std::uint32_t kPatienceUs = 5000;

  // One missing servo must not leave the others stiff. Sent three times: the write has no reply.
  void release_all() {
    for (int times = 0; times < 3; ++times) {
      feetech::Encoder encoder(master_.frame(), master_.capacity());
      feetech::begin_sync_write(encoder, mem::kTorqueEnable, 1);
      for (int j = 0; j < params_.servo_count(); ++j) {
        encoder.u8(params_.joint[j].servo_id);
        encoder.u8(0);
      }
      master_.send(encoder.finish());
    }
  }

  bool ready() const { return report_.status == BringUpStatus::kReady; }

  bool fail(BringUpStatus status, std::uint8_t id, std::uint16_t address) {
    report_.status = status;
    report_.device_id = id;
    report_.address = address;
    return false;
  }

  bool transact(std::size_t frame, std::uint8_t id, std::uint8_t address, std::uint8_t* data,
                std::size_t size) {
    const std::uint32_t timeout =
        timeout_us(frame + feetech::kStatusBytes + size, 1, params_.baud) + kPatienceUs;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const bool answered = master_.request(frame, timeout, [&](const feetech::Packet& packet) {
        if (packet.id != id || packet.size != size) return Take::kStray;
        status_ = packet.code;
        for (std::size_t i = 0; i < size; ++i) data[i] = packet.parameters[i];
        return Take::kDone;
      });
      if (answered) return true;
    }
    return fail(BringUpStatus::kSilent, id, address);
  }

  bool read(std::uint8_t id, std::uint8_t address, std::uint8_t* data, std::size_t size) {
    const std::size_t frame = feetech::encode_read(master_.frame(), master_.capacity(), id, address,
                                                   static_cast<std::uint8_t>(size));
    return transact(frame, id, address, data, size);
  }

  bool write(std::uint8_t id, std::uint8_t address, const std::uint8_t* data, std::size_t size) {
    const std::size_t frame =
        feetech::encode_write(master_.frame(), master_.capacity(), id, address, data, size);
    return transact(frame, id, address, nullptr, 0);
  }
  bool write(std::uint8_t id, std::uint8_t address, std::uint8_t value) {
    return write(id, address, &value, 1);
  }

  /// A read may be damaged and pass the checksum; then the write is only one too many.
  bool establish(std::uint8_t id, std::uint8_t address, const std::uint8_t* data,
                 std::size_t size) {
    std::uint8_t found[kMostBytes];
    for (int pass = 0; pass < 2; ++pass) {
      if (!read(id, address, found, size)) return false;
      bool same = true;
      for (std::size_t i = 0; i < size; ++i) same = same && found[i] == data[i];
      if (same) return true;
      if (pass == 0 && !write(id, address, data, size)) return false;
    }
    return fail(BringUpStatus::kNotVerified, id, address);
  }

  bool is_model(std::uint8_t id, std::uint16_t model) {
    std::uint8_t found[2];
    const std::size_t frame = feetech::encode_ping(master_.frame(), master_.capacity(), id);
    if (!transact(frame, id, mem::kModelNumber, nullptr, 0)) return false;
    if (!read(id, mem::kModelNumber, found, sizeof found)) return false;
    report_.expected = model;
    report_.found = feetech::get_u16(found);
    return report_.found == model || fail(BringUpStatus::kWrongModel, id, mem::kModelNumber);
  }

  // Newer servos keep no Return Delay [feetech_table.hpp]: it is not read back.
  bool answer_at_once(std::uint8_t id) {
    std::uint8_t delay = 0;
    if (!read(id, mem::kReturnDelay, &delay, 1)) return false;
    return delay == 0 || write(id, mem::kReturnDelay, std::uint8_t{0});
  }

  bool single_turn(std::uint8_t id) {
    std::uint8_t phase = 0;
    if (!read(id, mem::kPhase, &phase, 1)) return false;
    const auto single = static_cast<std::uint8_t>(phase & ~feetech::kWholeAngle);
    return establish(id, mem::kPhase, &single, 1);
  }

  bool servo(int j) {
    const JointParams& joint = params_.joint[j];
    const ServoProfile& profile = profile_of(params_, j);
    const std::uint8_t id = joint.servo_id;
    const PositionLimits limits(joint);
    const std::uint8_t gains[3] = {static_cast<std::uint8_t>(profile.position_p_gain),
                                   static_cast<std::uint8_t>(profile.position_d_gain),
                                   static_cast<std::uint8_t>(profile.position_i_gain)};
    constexpr std::uint8_t kAll = 1, kPositionMode = 0, kAtOnce[4] = {};
    return is_model(id, profile.model_number) && write(id, mem::kTorqueEnable, std::uint8_t{0}) &&
           write(id, mem::kLock, std::uint8_t{0}) && establish(id, mem::kStatusLevel, &kAll, 1) &&
           answer_at_once(id) && single_turn(id) &&
           establish(id, mem::kMinPosition, limits.bytes, sizeof limits.bytes) &&
           establish(id, mem::kPGain, gains, sizeof gains) &&
           establish(id, mem::kMode, &kPositionMode, 1) && write(id, mem::kLock, std::uint8_t{1}) &&
           establish(id, mem::kGoalTime, kAtOnce, sizeof kAtOnce) && learn_strength(j, id) &&
           is_well(id);
  }

  bool learn_strength(int j, std::uint8_t id) {
    std::uint8_t limit[2];
    if (!read(id, mem::kMaxTorque, limit, sizeof limit)) return false;
    report_.full_strength[j] = feetech::get_u16(limit);
    return true;
  }

  bool is_well(std::uint8_t id) {
    report_.found = hardware_error_of(status_);
    return report_.found == 0 || fail(BringUpStatus::kHardwareError, id, mem::kStatus);
  }

  bool sensor(std::uint8_t id, std::uint16_t model) {
    return is_model(id, model) && answer_at_once(id);
  }

  const Params& params_;
  FeetechMaster& master_;
  BringUpReport report_;
  std::uint8_t status_ = 0;  ///< last answer's
};

}  // namespace

BringUpReport bring_up(const Params& params, FeetechMaster& master) {
  return FeetechBringUp(params, master).run();
}

}  // namespace verp::app
