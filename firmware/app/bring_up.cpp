#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/control_table.hpp"
#include "firmware/app/bring_up_report.hpp"
#include "firmware/app/bus_master.hpp"
#include "firmware/app/servo_ram.hpp"

namespace verp::app {
namespace {

class BringUp {
 public:
  BringUp(const Params& params, BusMaster& master) : params_(params), master_(master) {}

  BringUpReport run() {
    release_all();
    for (int j = 0; j < params_.servo_count() && ready(); ++j) servo(j);
    if (params_.imu.device_id != 0 && ready()) sensor(params_.imu.device_id, dxl::kModelImu);
    for (std::uint8_t id : params_.feet.device_id) {
      if (id != 0 && ready()) sensor(id, dxl::kModelFoot);
    }
    if (!ready()) release_all();
    return report_;
  }

 private:
  static constexpr int kAttempts = 3;
  static constexpr std::size_t kMostBytes = 36;

  // Releases torque before any request, and again if a device does not answer: one missing servo
  // must not leave the others stiff. Sent three times: the write has no reply.
  void release_all() {
    for (int times = 0; times < 3; ++times) {
      dxl::Encoder encoder(master_.frame(), master_.capacity());
      dxl::begin_sync_write(encoder, dxl::address::kTorqueEnable, 1);
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

  bool transact(std::size_t frame, std::uint8_t id, std::uint16_t address, std::uint8_t* data,
                std::size_t size) {
    const std::uint32_t timeout =
        timeout_us(frame + dxl::kStatusBytes + size, 1, params_.baud) + kLongestReturnDelayUs;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      bool refused = false;
      const bool answered = master_.request(frame, timeout, [&](const dxl::Packet& packet) {
        if (packet.id != id) return Take::kStray;
        refused = (packet.error & ~dxl::kAlert) != 0;
        alert_ = (packet.error & dxl::kAlert) != 0;
        if (!refused && packet.size != size) return Take::kStray;
        for (std::size_t i = 0; i < size && !refused; ++i) data[i] = packet.parameters[i];
        return Take::kDone;
      });
      if (answered) return !refused || fail(BringUpStatus::kRefused, id, address);
    }
    return fail(BringUpStatus::kSilent, id, address);
  }

  bool ping(std::uint8_t id, std::uint16_t model) {
    std::uint8_t reply[3];
    const std::size_t frame = dxl::encode_ping(master_.frame(), master_.capacity(), id);
    if (!transact(frame, id, dxl::address::kModelNumber, reply, sizeof reply)) return false;
    report_.expected = model;
    report_.found = dxl::get_u16(reply);
    return report_.found == model ||
           fail(BringUpStatus::kWrongModel, id, dxl::address::kModelNumber);
  }

  bool read(std::uint8_t id, std::uint16_t address, std::uint8_t* data, std::size_t size) {
    const auto length = static_cast<std::uint16_t>(size);
    const std::size_t frame =
        dxl::encode_read(master_.frame(), master_.capacity(), id, address, length);
    return transact(frame, id, address, data, size);
  }

  bool write(std::uint8_t id, std::uint16_t address, const std::uint8_t* data, std::size_t size) {
    const std::size_t frame =
        dxl::encode_write(master_.frame(), master_.capacity(), id, address, data, size);
    return transact(frame, id, address, nullptr, 0);
  }

  bool establish(std::uint8_t id, std::uint16_t address, const std::uint8_t* data,
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

  bool servo(int j) {
    const JointParams& joint = params_.joint[j];
    const ServoProfile& profile = profile_of(params_, j);
    const ServoRam ram(profile);
    const ServoLimits limits(joint);
    const std::uint8_t id = joint.servo_id;
    const std::uint8_t off = 0;
    const std::uint8_t answer_all = 2;
    // Return Delay Time, Drive Mode and Operating Mode are adjacent.
    const std::uint8_t mode[3] = {0, dxl::kTimeBasedProfile, dxl::kPositionMode};
    return ping(id, profile.model_number) &&
           write(id, dxl::address::kTorqueEnable, &off, sizeof off) &&
           write(id, dxl::address::kBusWatchdog, &off, sizeof off) &&
           establish(id, dxl::address::kStatusReturnLevel, &answer_all, sizeof answer_all) &&
           establish(id, dxl::address::kReturnDelay, mode, sizeof mode) &&
           establish(id, dxl::address::kMaxPositionLimit, limits.bytes, sizeof limits.bytes) &&
           establish(id, dxl::address::kPositionDGain, ram.gains, sizeof ram.gains) &&
           establish(id, dxl::address::kProfileAcceleration, ram.motion, sizeof ram.motion) &&
           learn_strength(j, id) && is_well(id);
  }

  // The alert bit means that Hardware Error Status is not zero.
  bool is_well(std::uint8_t id) {
    if (!alert_) return true;
    std::uint8_t errors = 0;
    if (!read(id, dxl::address::kHardwareError, &errors, sizeof errors)) return false;
    report_.found = errors;
    return errors == 0 || fail(BringUpStatus::kHardwareError, id, dxl::address::kHardwareError);
  }

  bool learn_strength(int j, std::uint8_t id) {
    std::uint8_t limit[2];
    if (!read(id, dxl::address::kPwmLimit, limit, sizeof limit)) return false;
    report_.full_strength[j] = dxl::get_u16(limit);
    return true;
  }

  bool sensor(std::uint8_t id, std::uint16_t model) {
    const std::uint8_t no_delay = 0;
    return ping(id, model) && establish(id, dxl::address::kReturnDelay, &no_delay, sizeof no_delay);
  }

  const Params& params_;
  BusMaster& master_;
  BringUpReport report_;
  bool alert_ = false;  ///< last reply's
};

}  // namespace

BringUpReport bring_up(const Params& params, BusMaster& master) {
  return BringUp(params, master).run();
}

}  // namespace verp::app
