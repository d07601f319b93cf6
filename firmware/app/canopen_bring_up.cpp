#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/emcy.hpp"
#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/control_table.hpp"
#include "firmware/app/bring_up_report.hpp"
#include "firmware/app/can_master.hpp"
#include "firmware/app/can_nodes.hpp"
#include "firmware/app/can_schedule.hpp"
#include "firmware/app/drive_telemetry.hpp"
#include "firmware/app/node_settings.hpp"
#include "firmware/app/sdo_transfer.hpp"

namespace verp::app {
namespace {

class CanopenBringUp {
 public:
  CanopenBringUp(const Params& params, CanMaster& master)
      : params_(params), master_(master), nodes_(params) {}

  BringUpReport run() {
    if (!sound_ids() || !is_alone()) return report_;
    NodeMask missing = present();
    for (int times = 0; times < kResets && missing != 0; ++times) {
      command_all(canopen::NmtCommand::kResetNode, missing);
      missing = await_boot(missing);
    }
    for (int slot = 0; slot < kCanNodes && ready(); ++slot) {
      if (node_id(params_, slot) != 0) set_up(slot, (missing & node_bit(slot)) == 0);
    }
    if (ready()) start_all();
    if (!ready()) command_all(canopen::NmtCommand::kResetNode, present());
    return report_;
  }

 private:
  static constexpr int kAttempts = 3;
  /// Time for a drive to boot and to leave a fault: an allowance, not a measurement.
  static constexpr std::uint32_t kBootUs = 2'000'000;
  static constexpr int kResets = 2;   ///< of nodes without a boot-up message
  static constexpr int kRepeats = 3;  ///< of unconfirmed commands

  bool ready() const { return report_.status == BringUpStatus::kReady; }
  bool fail(BringUpStatus status, std::uint8_t id, canopen::Address at) {
    report_.status = status;
    report_.device_id = id;
    report_.address = at.index;
    return false;
  }

  bool sound_ids() {
    for (int slot = 0; slot < kCanNodes; ++slot) {
      const std::uint8_t id = node_id(params_, slot);
      const bool sound = canopen::is_node(id) && id != canopen::plan::kControllerNode &&
                         nodes_.slot_of(id) == slot;
      if (id != 0 && !sound) return fail(BringUpStatus::kRefused, id, canopen::plan::kDeviceType);
    }
    return true;
  }

  bool is_alone() {
    const std::uint64_t end_us = master_.now_us() + canopen::plan::quiet_us(params_);
    CanFrame frame;
    while (master_.receive_until(frame, end_us) && master_.now_us() < end_us) {
      if (!canopen::plan::is_of_master(frame)) continue;
      report_.status = BringUpStatus::kOccupied;
      report_.address = static_cast<std::uint16_t>(frame.id);
      return false;
    }
    return true;
  }

  NodeMask present() const {
    NodeMask mask = 0;
    for (int slot = 0; slot < kCanNodes; ++slot) {
      if (node_id(params_, slot) != 0) mask |= node_bit(slot);
    }
    return mask;
  }
  void command_all(canopen::NmtCommand command, NodeMask nodes) {
    for (int slot = 0; slot < kCanNodes; ++slot) {
      if ((nodes & node_bit(slot)) == 0) continue;
      master_.send(canopen::nmt_frame(command, node_id(params_, slot)));
    }
  }
  void start_all() {
    for (int i = 0; i < kRepeats; ++i) {
      command_all(canopen::NmtCommand::kStart, present());
      const std::uint32_t pass_us = can_frames_us(2, 2 * kCanNodes, params_.baud);
      const std::uint64_t end_us = master_.now_us() + pass_us;
      CanFrame frame;  // lets them pass; more would find no room
      while (master_.now_us() < end_us && master_.receive(frame, pass_us)) {
      }
    }
  }

  // The nodes of `missing` that did not boot in time.
  NodeMask await_boot(NodeMask missing) {
    CanFrame frame;
    const std::uint64_t end_us = master_.now_us() + kBootUs;
    while (missing != 0 && master_.now_us() < end_us && master_.receive(frame, kBootUs)) {
      std::uint8_t node = 0;
      canopen::NmtState state{};
      if (!canopen::decode_heartbeat(frame, node, state)) continue;
      const int slot = nodes_.slot_of(node);
      if (slot >= 0) missing &= ~node_bit(slot);
    }
    return missing;
  }

  canopen::Abort attempt(std::uint8_t id, const Setting& setting, std::uint32_t* found) {
    canopen::Abort why = canopen::Abort::kNone;
    for (int times = 0; times < kAttempts; ++times) {
      canopen::SdoClient client(id);
      std::uint8_t data[4] = {};
      constexpr auto kPlain = canopen::SdoClient::Mode::kPlain;
      if (found == nullptr) {
        canopen::put_le(data, setting.value, 4);
        client.download(setting.at, data, setting.bytes, kPlain, master_.now_us());
      } else {
        client.upload(setting.at, data, setting.bytes, kPlain, master_.now_us());
      }
      if (run_transfer(client, master_)) {
        if (found != nullptr) *found = static_cast<std::uint32_t>(canopen::get_le(data, 4));
        return canopen::Abort::kNone;
      }
      why = client.reason();
      if (why != canopen::Abort::kTimeout) break;
      ++master_.counters.timeouts;
    }
    if (why != canopen::Abort::kTimeout) ++master_.counters.errors;
    return why;
  }
  bool done(std::uint8_t id, canopen::Address at, canopen::Abort why) {
    if (why == canopen::Abort::kNone) return true;
    const bool silent = why == canopen::Abort::kTimeout;
    return fail(silent ? BringUpStatus::kSilent : BringUpStatus::kRefused, id, at);
  }
  bool read(std::uint8_t id, canopen::Address at, std::uint8_t bytes, std::uint32_t& value) {
    return done(id, at, attempt(id, {at, 0, bytes}, &value));
  }

  bool set_up(int slot, bool booted) {
    if (!identify(slot)) return false;
    // Without a reset it may keep an earlier controller's settings.
    if (!booted) return fail(BringUpStatus::kNotReset, node_id(params_, slot), {});
    return write_all(slot) && read_back(slot) &&
           (!is_joint(slot) || (learn_strength(slot) && is_well(slot)));
  }
  bool expect(std::uint8_t id, canopen::Address at, std::uint16_t expected) {
    std::uint32_t found = 0;
    if (!read(id, at, 4, found)) return false;
    report_.expected = expected;
    report_.found = static_cast<std::uint16_t>(found);
    return report_.found == expected || fail(BringUpStatus::kWrongModel, id, at);
  }
  bool identify(int slot) {
    const std::uint8_t id = node_id(params_, slot);
    if (!is_joint(slot)) {
      const bool imu = slot == kImuNode;
      return expect(id, canopen::plan::kProductCode, imu ? dxl::kModelImu : dxl::kModelFoot);
    }
    if (!expect(id, canopen::plan::kDeviceType, canopen::plan::kDriveProfile)) return false;
    std::uint32_t vendor = 0;
    if (!read(id, canopen::plan::kVendor, 4, vendor)) return false;
    if (vendor != canopen::plan::kOurVendor) report_.foreign_drives |= 1u << slot;
    const std::uint16_t model =
        params_.servo[params_.joint[slot].servo_profile % kServoProfiles].model_number;
    if (model != 0 && !expect(id, canopen::plan::kProductCode, model)) return false;
    constexpr canopen::Address kModes = canopen::cia402::object::kSupportedModes;
    std::uint32_t modes = 0;
    if (!read(id, kModes, 4, modes)) return false;
    return (modes & canopen::cia402::kSupportedCyclicPosition) != 0 ||
           fail(BringUpStatus::kRefused, id, kModes);
  }
  bool write_all(int slot) {
    const std::uint8_t id = node_id(params_, slot);
    Setting setting;
    for (int i = 0; node_setting(params_, slot, i, setting); ++i) {
      const canopen::Abort why = attempt(id, setting, nullptr);
      const bool absent = why == canopen::Abort::kNoObject || why == canopen::Abort::kNoSubindex;
      if (setting.optional && absent) continue;
      if (!done(id, setting.at, why)) return false;
    }
    return true;
  }
  bool read_back(int slot) {
    const std::uint8_t id = node_id(params_, slot);
    Setting setting;
    for (int i = 0; node_setting(params_, slot, i, setting); ++i) {
      if (!setting.stays || setting.optional) continue;
      std::uint32_t found = 0;
      if (!read(id, setting.at, setting.bytes, found)) return false;
      const std::uint32_t mask = setting.bytes == 4 ? ~0u : (1u << 8 * setting.bytes) - 1;
      if (((found ^ setting.value) & mask & ~canopen::kPdoNoRemote) != 0) {
        return fail(BringUpStatus::kNotVerified, id, setting.at);
      }
    }
    return true;
  }
  bool learn_strength(int joint) {
    constexpr canopen::Address kAt = canopen::cia402::object::kMaxTorque;
    std::uint32_t full = 0;
    if (!read(node_id(params_, joint), kAt, 2, full)) return false;
    report_.full_strength[joint] = static_cast<std::uint16_t>(full);
    return true;
  }
  // After a fault reset a remaining fault still has its cause.
  bool is_well(int joint) {
    using canopen::cia402::State;
    namespace object = canopen::cia402::object;
    const std::uint8_t id = node_id(params_, joint);
    const std::uint64_t end_us = master_.now_us() + kBootUs;
    for (;;) {
      std::uint32_t word = 0;
      if (!read(id, object::kStatusword, 2, word)) return false;
      const State state = canopen::cia402::state_of(static_cast<std::uint16_t>(word));
      if (state != State::kNotReady && state != State::kFaultReactionActive &&
          state != State::kFault) {
        return true;
      }
      if (state == State::kFault || master_.now_us() >= end_us) break;
    }
    std::uint32_t code = 0;
    if (!read(id, object::kErrorCode, 2, code)) return false;
    report_.found = hardware_error_of(static_cast<std::uint16_t>(code));
    return fail(BringUpStatus::kHardwareError, id, object::kStatusword);
  }

  const Params& params_;
  CanMaster& master_;
  CanNodes nodes_;
  BringUpReport report_;
};

}  // namespace

BringUpReport bring_up(const Params& params, CanMaster& master) {
  return CanopenBringUp(params, master).run();
}

}  // namespace verp::app
