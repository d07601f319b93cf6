#include "firmware/app/node_settings.hpp"

#include "common/model/counts.hpp"
#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/can_nodes.hpp"

namespace verp::app {
namespace {

/// Picks one setting of a list that is generated in order.
class SettingList {
 public:
  SettingList(const Params& params, int slot, int wanted)
      : params_(params), slot_(slot), wanted_(wanted) {}

  /// False: the list is shorter.
  bool pick(Setting& setting) {
    is_joint(slot_) ? drive() : sensor();
    setting = found_;
    return count_ > wanted_;
  }

 private:
  using Object = canopen::Address;

  void add(const Setting& setting) {
    if (count_++ == wanted_) found_ = setting;
  }
  std::uint8_t id() const { return node_id(params_, slot_); }

  void drive() {
    namespace object = canopen::cia402::object;
    const std::uint32_t period_us = params_.period_us;
    common();
    add({object::kMode, canopen::cia402::kModeCyclicPosition, 1});
    // The object counts whole or tenth milliseconds.
    const bool whole = period_us % 1000 == 0;
    add({object::kPeriodExponent, static_cast<std::uint8_t>(whole ? -3 : -4), 1});
    add({object::kPeriodValue, whole ? period_us / 1000 : (period_us + 50) / 100, 1});
    limits();
    // Off: the core watches the following error; a drive that goes limp by itself would topple the
    // robot.
    add({object::kFollowingWindow, UINT32_MAX, 4});
    add({object::kQuickStopOption, canopen::plan::kQuickStopAndHold, 2});
    add({object::kAbortConnection,
         static_cast<std::uint32_t>(canopen::cia402::AbortConnection::kQuickStop), 2});
    // A drive that stopped by itself keeps answering, and the next heartbeat enables it again.
    add({canopen::plan::kErrorBehaviour, static_cast<std::uint8_t>(canopen::ErrorBehaviour::kStay),
         1, true, true});
    const std::uint32_t watched = std::uint32_t{canopen::plan::kControllerNode} << 16;
    add({object::kConsumerHeartbeat, watched | canopen::plan::patience_ms(params_), 4});
    const std::uint8_t group = canopen::plan::group_of_joint(slot_);
    answer(1, canopen::plan::drive_answer(), group);
    for (unsigned number = 2; number <= canopen::kPdosOfSet; ++number) silence(number);
    receive(canopen::plan::kGoals);
    receive(canopen::plan::kWords);
    receive(canopen::plan::kStrengths);
    // Clears a fault whose cause is gone.
    add({object::kControlword, canopen::cia402::kWordDisableVoltage, 2, false});
    add({object::kControlword, canopen::cia402::kWordFaultReset, 2, false});
    add({object::kControlword, canopen::cia402::kWordDisableVoltage, 2, false});
  }
  void sensor() {
    const std::uint8_t group = canopen::plan::sync_groups(params_);
    common();
    if (slot_ == kImuNode) {
      answer(1, canopen::plan::imu_answer(canopen::plan::kGyro), group);
      answer(2, canopen::plan::imu_answer(canopen::plan::kAccel), group);
    } else {
      answer(1, canopen::plan::foot_answer(), group);
    }
  }
  /// Counted SYNCs come first: until then a node may complain of each.
  void common() {
    add({canopen::plan::kSyncOverflow, canopen::plan::sync_groups(params_), 1});
    // PDOs replace the node's heartbeat.
    add({canopen::cia402::object::kProducerHeartbeat, 0, 2, true, true});
  }

  // One count beyond the joint's limits, so that rounding refuses no goal.
  void limits() {
    const JointParams& joint = params_.joint[slot_];
    const std::int32_t a = model::count_of(joint, joint.lower_rad);
    const std::int32_t b = model::count_of(joint, joint.upper_rad);
    const std::int32_t low = a < b ? a : b;
    const std::int32_t high = a < b ? b : a;
    namespace object = canopen::cia402::object;
    add({object::kMinPosition, static_cast<std::uint32_t>(low > INT32_MIN ? low - 1 : low), 4});
    add({object::kMaxPosition, static_cast<std::uint32_t>(high < INT32_MAX ? high + 1 : high), 4});
  }

  static Object sub(unsigned index, unsigned subindex) {
    return {static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(subindex)};
  }
  // CiA 301's order: PDO off, no entries, the entries, their number, on.
  void map(unsigned communication, std::uint32_t cob_id, const canopen::PdoMapping<>& mapping,
           std::uint8_t type, std::uint8_t group) {
    const unsigned entries = communication + 0x200;
    add({sub(communication, 1), cob_id | canopen::kPdoInvalid, 4, false});
    add({sub(entries, 0), 0, 1, false});
    for (unsigned i = 0; i < mapping.count; ++i) {
      add({sub(entries, i + 1), mapping.entries[i].value(), 4});
    }
    add({sub(entries, 0), mapping.count, 1});
    add({sub(communication, 2), type, 1});
    if (group != 0) add({sub(communication, 6), group, 1});
    add({sub(communication, 1), cob_id, 4});
  }
  void answer(unsigned number, const canopen::PdoMapping<>& mapping, std::uint8_t group) {
    const std::uint32_t cob_id = canopen::tpdo_id(number, id()) | canopen::kPdoNoRemote;
    map(0x17FF + number, cob_id, mapping, canopen::plan::sync_groups(params_), group);
  }
  void silence(unsigned number) {
    const std::uint32_t cob_id = canopen::tpdo_id(number, id()) | canopen::kPdoInvalid;
    add({sub(0x17FF + number, 1), cob_id | canopen::kPdoNoRemote, 4, false, true});
  }
  void receive(const canopen::plan::Shared& kind) {
    const std::uint32_t cob_id = canopen::plan::shared_id(kind, params_, slot_ / kind.width);
    map(0x13FFu + kind.rpdo, cob_id, canopen::plan::shared_mapping(kind, params_, slot_),
        canopen::kEventProfile, 0);
  }

  const Params& params_;
  int slot_;
  int wanted_;
  int count_ = 0;
  Setting found_;
};

}  // namespace

bool node_setting(const Params& params, int slot, int number, Setting& setting) {
  return SettingList(params, slot, number).pick(setting);
}

}  // namespace verp::app
