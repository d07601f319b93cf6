#include "tests/hil/can_intruder.hpp"

#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/canopen/sdo.hpp"

namespace verp::test {
namespace {

namespace plan = canopen::plan;
namespace sdo = canopen::sdo;

constexpr std::uint32_t kUrgentIds = 0x7F;  // before SYNC, not NMT

}  // namespace

std::uint8_t Intruder::random_node() {
  const std::uint32_t sensors = 3;
  const std::uint32_t chosen = random(params_.joint_count + sensors);
  if (chosen < params_.joint_count) return params_.joint[chosen].servo_id;
  const std::uint32_t sensor = chosen - params_.joint_count;
  return sensor == 0 ? params_.imu.device_id : params_.feet.device_id[sensor - 1];
}

void Intruder::add(std::uint32_t id, std::uint8_t size) {
  CanFrame frame = canopen::classic_frame(id, size);
  for (unsigned i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(random_() >> 8);
  out_.push_back(frame);
  ++frames_;
}

void Intruder::babble(int frames) {
  for (int i = 0; i < frames; ++i) add(1 + random(kUrgentIds), 8);
}

// Wrong size or number, extended, remote, or insignificant.
void Intruder::pretend() {
  const std::uint8_t node = random_node();
  switch (random(7)) {
    case 0:
      return add(canopen::tpdo_id(1, node), static_cast<std::uint8_t>(random(6)));
    case 1:
      return add(canopen::tpdo_id(3 + random(2), node), 8);
    case 2:
      add(canopen::heartbeat_id(node), 1);
      out_.back().data[0] = static_cast<std::uint8_t>(canopen::NmtState::kOperational);
      return;
    case 3:
      return add(canopen::heartbeat_id(node), static_cast<std::uint8_t>(2 + random(7)));
    case 4:
      return add(canopen::emcy_id(node), static_cast<std::uint8_t>(random(9)));
    case 5:
      add(canopen::tpdo_id(1, node), 8);
      out_.back().extended = true;
      return;
    default:
      add(canopen::tpdo_id(1, node), 8);
      out_.back().remote = true;
      out_.back().size = 0;
      return;
  }
}

// From drives that were not asked, or about another object.
void Intruder::respond() {
  const std::uint8_t node = params_.joint[random(params_.joint_count)].servo_id;
  const bool other = node == asked_ || random(2) == 0;
  const canopen::Address at = other ? canopen::cia402::object::kStatusword : plan::kTelemetry;
  const std::uint32_t what = random(4);
  add(canopen::sdo_response_id(node), sdo::kFrameBytes);
  CanFrame& frame = out_.back();
  if (what == 0) frame.size = static_cast<std::uint8_t>(random(8));
  if (what == 0 || what == 1) return;  // noise
  const std::uint32_t value = frame.data[4];
  frame = sdo::addressed(canopen::sdo_response_id(node), what == 2 ? sdo::kAbort : 0x43, at);
  canopen::put_le(frame.data + 4, what == 2 ? 0x06020000 : value, 4);
}

void Intruder::hear(const CanFrame& frame, std::uint64_t) {
  if (!canopen::is_canopen(frame)) return;
  const canopen::Connection to = canopen::connection_of(frame.id);
  if (to.service == canopen::Service::kSdoRequest) asked_ = to.node;
  // A twin obeys SYNC like its drive.
  const bool its_turn = frame.id == canopen::kSyncId && frame.size == 1 &&
                        frame.data[0] == plan::group_of_joint(joint);
  if (kind != Kind::kTwin || !its_turn) return;
  add(canopen::tpdo_id(1, params_.joint[joint].servo_id), plan::kDriveAnswerBytes);
  canopen::put_le(out_.back().data, 0x1637, 2);  // operation enabled
}

void Intruder::work(std::uint64_t now_us) {
  const std::uint64_t ms = now_us / 1000;
  switch (kind) {
    case Kind::kUrgent:
      return babble(3);
    case Kind::kCrowd:
      return babble(static_cast<int>(5 + random(5)));
    case Kind::kFlood:
      return babble(10);
    case Kind::kForeign:
      return pretend();
    case Kind::kSdo:
      if (ms % 2 == 0) respond();
      return;
    case Kind::kSync:
      if (random(200) != 0) return;
      add(canopen::kSyncId, 1);
      out_.back().data[0] = static_cast<std::uint8_t>(1 + random(plan::sync_groups(params_)));
      return;
    default:
      return;
  }
}

bool Intruder::say(CanFrame& frame, std::uint64_t) {
  if (out_.empty()) return false;
  frame = out_.front();
  out_.pop_front();
  return true;
}

}  // namespace verp::test
