#pragma once
#include <cstdint>

#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/device.hpp"
#include "common/protocol/canopen/robot_plan.hpp"

namespace verp::test {

using canopen::Abort;
using canopen::Address;
namespace object = canopen::cia402::object;

class WireNode {
 public:
  virtual ~WireNode() = default;
  virtual void receive(const CanFrame& frame, std::uint64_t now_us) = 0;
  virtual bool next(CanFrame& frame, std::uint64_t now_us) = 0;
};

struct SensorObjects {
  struct Number {
    Address at;
    std::uint16_t value = 0;
  };
  Number numbers[6];

  Number* at(Address address) {
    for (Number& each : numbers) {
      if (each.at == address) return &each;
    }
    return nullptr;
  }
  Abort find(Address address, canopen::Entry& entry) {
    entry = {true, false, 2, 2, 2};
    return at(address) != nullptr ? Abort::kNone : Abort::kNoObject;
  }
  Abort read(Address address, std::uint32_t, std::uint8_t* buffer, std::uint32_t) {
    canopen::put_le(buffer, at(address)->value, 2);
    return Abort::kNone;
  }
  Abort write(Address, const std::uint8_t*, std::uint32_t) { return Abort::kReadOnly; }
  Abort mappable(Address address, std::uint8_t bits, bool receive) {
    const bool good = at(address) != nullptr && bits == 16 && !receive;
    return good ? Abort::kNone : Abort::kNotMappable;
  }
  std::uint64_t get(Address address, std::uint8_t) { return at(address)->value; }
  void put(Address, std::uint8_t, std::uint64_t) {}
};

/// Reaches each goal at once.
struct DriveApplication {
  canopen::cia402::DriveObjects objects;
  canopen::cia402::Drive drive;
  std::uint32_t telemetry = 0;
  bool has_telemetry = true;
  bool forgetful = false;  ///< confirms a following window but does not keep it

  void refresh() {
    const bool enabled = drive.state() == canopen::cia402::State::kOperationEnabled;
    const bool follows = enabled && objects.mode == canopen::cia402::kModeCyclicPosition;
    objects.statusword = drive.statusword(static_cast<std::uint16_t>(
        canopen::cia402::kRemote | (follows ? canopen::cia402::kFollowsCommand : 0)));
    if (follows) {
      objects.actual_position = objects.target_position;
    }
  }
  void obey() {
    drive.control(objects.controlword, objects.quick_stop_option);
    refresh();
  }
  bool is_telemetry(Address at) const { return at == canopen::plan::kTelemetry && has_telemetry; }
  Abort find(Address at, canopen::Entry& entry) {
    if (!is_telemetry(at)) return canopen::cia402::find_object(at, entry);
    entry = {true, false, 4, 4, 4};
    return Abort::kNone;
  }
  Abort read(Address at, std::uint32_t, std::uint8_t* buffer, std::uint32_t) {
    if (!is_telemetry(at)) return canopen::cia402::read_object(objects, at, buffer);
    canopen::put_le(buffer, telemetry, 4);
    return Abort::kNone;
  }
  Abort write(Address at, const std::uint8_t* data, std::uint32_t) {
    if (forgetful && at == object::kFollowingWindow) return Abort::kNone;
    const Abort refused = canopen::cia402::write_object(objects, at, data);
    if (refused == Abort::kNone && at == object::kControlword) obey();
    return refused;
  }
  Abort mappable(Address at, std::uint8_t bits, bool receive) {
    return canopen::cia402::check_mappable(at, bits, receive);
  }
  std::uint64_t get(Address at, std::uint8_t bits) {
    std::uint8_t bytes[8] = {};
    canopen::cia402::read_object(objects, at, bytes);
    return canopen::get_le(bytes, bits / 8u);
  }
  void put(Address at, std::uint8_t bits, std::uint64_t value) {
    std::uint8_t bytes[8] = {};
    canopen::put_le(bytes, value, bits / 8u);
    write(at, bytes, bits / 8u);
    refresh();
  }
};

template <class Application>
class PoweredNode : public WireNode {
 public:
  static constexpr canopen::DeviceSize kSize = {3, 4, 8, 1};

  PoweredNode(const canopen::Identity& identity, std::uint8_t node)
      : device(application, identity, node), node_(node) {
    forget();
    device.start();
  }

  void receive(const CanFrame& frame, std::uint64_t now_us) override {
    if (off || overhears(frame)) return;
    const canopen::DeviceEvents events = device.receive(frame, now_us);
    if (events.nmt != canopen::NmtEvent::kResetNode) return;
    ++resets;
    forget();
    on_reset();
    device.start();
  }
  bool next(CanFrame& frame, std::uint64_t now_us) override {
    if (off) return false;
    if (device.heartbeat_lost(now_us)) on_abandoned();
    return device.next(frame, now_us);
  }
  void reboot() {
    forget();
    on_reset();
    device.receive(canopen::nmt_frame(canopen::NmtCommand::kResetNode, node_), 0);
    device.start();
  }

  Application application;
  canopen::Device<Application, kSize> device;
  bool off = false;
  int resets = 0;
  int missed_resets = 0;

 protected:
  virtual void on_reset() {}
  virtual void on_abandoned() {}

 private:
  bool overhears(const CanFrame& frame) {
    const bool is_reset = frame.id == canopen::kNmtId && frame.data[1] == node_ &&
                          frame.data[0] == static_cast<int>(canopen::NmtCommand::kResetNode);
    return is_reset && missed_resets > 0 && missed_resets-- > 0;
  }
  void forget() {
    auto& objects = device.objects();
    for (unsigned i = 0; i < 3; ++i) {
      objects.rpdos[i] = {canopen::Direction::kReceive,
                          canopen::rpdo_id(i + 1, node_) | canopen::kPdoInvalid,
                          255,
                          {}};
    }
    for (unsigned i = 0; i < 4; ++i) {
      objects.tpdos[i] = {canopen::Direction::kTransmit,
                          canopen::tpdo_id(i + 1, node_) | canopen::kPdoInvalid,
                          255,
                          {}};
    }
    objects.consumer = {};
    objects.sync_overflow = 0;
  }
  std::uint8_t node_;
};

class DriveNode : public PoweredNode<DriveApplication> {
 public:
  static constexpr std::uint32_t kProduct = 1234;
  bool stuck = false;  ///< the fault survives a reset
  explicit DriveNode(std::uint8_t node, std::uint32_t vendor = canopen::plan::kOurVendor)
      : PoweredNode({0x00020192, "test drive", vendor, kProduct, 1, 1}, node) {
    DriveNode::on_reset();
  }
  canopen::cia402::State state() const { return application.drive.state(); }
  void fail(canopen::ErrorCode code, bool lasting) {
    using canopen::cia402::Trigger;
    application.drive.event(Trigger::kFault, 0);
    application.drive.event(Trigger::kFaultReactionDone, 0);
    if (!lasting) application.drive.clear_fault();
    application.objects.error_code = static_cast<std::uint16_t>(code);
    application.refresh();
    device.report(code, 1);
  }

 protected:
  void on_reset() override {
    const std::int32_t place = application.objects.actual_position;
    application.objects = {};
    application.objects.actual_position = place;
    application.objects.dc_link_mv = 12'300;
    if (application.forgetful) application.objects.following_window = 7;
    application.drive = {};
    application.drive.event(canopen::cia402::Trigger::kInitialised, 0);
    application.refresh();
    if (stuck) fail(canopen::ErrorCode::kOverTemperature, true);
  }
  void on_abandoned() override {
    application.drive.connection_lost(
        static_cast<canopen::cia402::AbortConnection>(application.objects.abort_connection),
        application.objects.quick_stop_option);
    application.refresh();
  }
};

class SensorNode : public PoweredNode<SensorObjects> {
 public:
  SensorNode(std::uint16_t product, std::uint8_t node)
      : PoweredNode({0, "test sensor", 1, product, 1, 1}, node) {}
};

}  // namespace verp::test
