#include "host/twin/can/device_node.hpp"

#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/control_table.hpp"

namespace verp::can {
namespace {

using canopen::Direction;
using canopen::PdoMapping;
namespace object = canopen::cia402::object;

constexpr std::uint8_t kEvery = 1;  ///< transmission type: answers each SYNC

PdoMapping<> just(canopen::Address at, std::uint8_t bits) {
  PdoMapping<> mapping;
  mapping.add({at, bits});
  return mapping;
}

template <class Record>
Record spare(Direction direction, std::uint16_t id, const PdoMapping<>& mapping) {
  Record record(direction, id, canopen::kEventProfile, mapping);
  record.write_communication(1, id | canopen::kPdoNoRemote | canopen::kPdoInvalid);
  return record;
}

canopen::Identity identity(const char* name, std::uint32_t type, std::uint32_t product,
                           std::uint8_t node) {
  return {.device_type = type, .name = name, .product = product, .revision = 1, .serial = node};
}

}  // namespace

canopen::Identity drive_identity(std::uint16_t model, std::uint8_t node) {
  constexpr std::uint32_t kServoDrive = 0x00020000 | canopen::plan::kDriveProfile;  // CiA 402
  return identity("VERP virtual drive", kServoDrive, model, node);
}
canopen::Identity imu_identity(std::uint8_t node) {
  return identity("VERP virtual IMU", 0, dxl::kModelImu, node);
}
canopen::Identity foot_identity(std::uint8_t node) {
  return identity("VERP virtual foot", 0, dxl::kModelFoot, node);
}

void DrivePdos::prepare(canopen::CommunicationObjects<DriveApplication, kSize>& objects,
                        std::uint8_t node) {
  using Record = canopen::PdoRecord<kSize.entries>;
  const PdoMapping<> word = just(object::kControlword, 16);
  const PdoMapping<> status = just(object::kStatusword, 16);
  objects.rpdos[0] =
      Record(Direction::kReceive, canopen::rpdo_id(1, node), canopen::kEventProfile, word);
  for (unsigned n = 2; n <= kSize.rpdos; ++n) {
    objects.rpdos[n - 1] = spare<Record>(Direction::kReceive, canopen::rpdo_id(n, node), word);
  }
  objects.tpdos[0] =
      Record(Direction::kTransmit, canopen::tpdo_id(1, node), canopen::kEventProfile, status);
  objects.tpdos[1] =
      spare<Record>(Direction::kTransmit, canopen::tpdo_id(2, node), canopen::plan::drive_answer());
}

void ImuPdos::prepare(canopen::CommunicationObjects<ImuApplication, kSize>& objects,
                      std::uint8_t node) {
  using Record = canopen::PdoRecord<kSize.entries>;
  objects.rpdos[0] = spare<Record>(Direction::kReceive, canopen::rpdo_id(1, node), {});
  objects.tpdos[0] = Record(Direction::kTransmit, canopen::tpdo_id(1, node), kEvery,
                            canopen::plan::imu_answer(canopen::plan::kGyro));
  objects.tpdos[1] = Record(Direction::kTransmit, canopen::tpdo_id(2, node), kEvery,
                            canopen::plan::imu_answer(canopen::plan::kAccel));
}

void FootPdos::prepare(canopen::CommunicationObjects<FootApplication, kSize>& objects,
                       std::uint8_t node) {
  using Record = canopen::PdoRecord<kSize.entries>;
  objects.rpdos[0] = spare<Record>(Direction::kReceive, canopen::rpdo_id(1, node), {});
  objects.tpdos[0] =
      Record(Direction::kTransmit, canopen::tpdo_id(1, node), kEvery, canopen::plan::foot_answer());
}

DriveNode::DriveNode(const canopen::Identity& identity, std::uint8_t node, sim::Plant& plant,
                     int joint, const DriveSetup& setup)
    : DeviceNode(identity, node, plant, joint, setup) {}

void DriveNode::hear(const CanFrame& frame, std::uint64_t now_us) {
  DeviceNode::hear(frame, now_us);
  const bool forgotten = device().standing_error() == canopen::ErrorCode::kNoError;
  if (error_.any && forgotten) device().hold_error(error_.code, error_.error_register);
  notice_status();
}

void DriveNode::work(std::uint64_t now_us) {
  DeviceNode::work(now_us);
  if (const DriveNews news = application().work(now_us); news.any) {
    error_ = news;
    device().report(news.code, news.error_register);
  }
  notice_status();
}

void DriveNode::begin_anew() {
  application().restart();
  if (stored_) application().restore(*stored_);
  error_ = {};
}

void DriveNode::keep_application(bool stores) {
  stored_.reset();
  if (stores) stored_ = application().settings();
}

void DriveNode::stopped() {
  if (!application().connection_lost()) return;
  error_ = {canopen::ErrorCode::kCommunication, canopen::kErrorCommunication, true};
  device().report(error_.code, error_.error_register);
}

void DriveNode::master_lost() {
  if (!application().connection_lost()) return;
  error_ = {canopen::ErrorCode::kHeartbeatLost, canopen::kErrorCommunication, true};
  device().hold_error(error_.code, error_.error_register);  // the device has already reported it
}

void DriveNode::notice_status() {
  const auto status = static_cast<std::uint16_t>(application().get(object::kStatusword, 16));
  if (status != told_status_) tell_status(status);
  application().show_error(device().standing_error());
}

void DriveNode::tell_status(std::uint16_t status) {
  told_status_ = status;
  const bool faulty = canopen::cia402::state_of(status) == canopen::cia402::State::kFault;
  if (error_.any && !faulty && (status & canopen::cia402::kWarning) == 0) {
    error_ = {};
    device().report(canopen::ErrorCode::kNoError, 0);
  }
  const bool tells_events = !canopen::is_synchronous(device().objects().tpdos[0].type());
  if (tells_events) device().trigger(0);
}

}  // namespace verp::can
