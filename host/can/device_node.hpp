#pragma once
#include <optional>

#include "common/protocol/canopen/device.hpp"
#include "host/can/drive.hpp"
#include "host/can/node.hpp"
#include "host/can/sensor.hpp"

namespace verp::can {

/// A CANopen device as a node of the bus: an application, and the device around it with `Setup`'s
/// PDOs, made anew at each reset.
///  - Setup::kSize: how many of each the device has.
///  - Setup::prepare(objects, node): its communication objects as they are out of the box.
template <class Application, class Setup>
class DeviceNode : public Node {
 public:
  using Device = canopen::Device<Application, Setup::kSize>;

  template <class... Parts>
  DeviceNode(const canopen::Identity& identity, std::uint8_t node, Parts&&... parts)
      : identity_(identity), node_(node), application_(std::forward<Parts>(parts)...) {
    boot();
  }

  std::uint8_t id() const override { return node_; }
  void hear(const CanFrame& frame, std::uint64_t now_us) override {
    const canopen::DeviceEvents events = device_->receive(frame, now_us);
    if (events.nmt != canopen::NmtEvent::kNone) obey(events.nmt);
  }
  void work(std::uint64_t) override {}
  bool say(CanFrame& frame, std::uint64_t now_us) override { return device_->next(frame, now_us); }
  void power_on() override {
    begin_anew();
    boot();
  }
  void power_off() override {}

  Application& application() { return application_; }
  Device& device() { return *device_; }

 protected:
  /// The application, not the communication, is as out of the box.
  virtual void begin_anew() {}
  /// NMT has stopped the node.
  virtual void stopped() {}

 private:
  void boot() {
    device_.emplace(application_, identity_, node_);
    Setup::prepare(device_->objects(), node_);
    device_->start();
  }
  void obey(canopen::NmtEvent event) {
    if (event == canopen::NmtEvent::kState) {
      if (device_->state() == canopen::NmtState::kStopped) stopped();
      return;
    }
    if (event == canopen::NmtEvent::kResetNode) begin_anew();
    boot();
  }

  canopen::Identity identity_;
  std::uint8_t node_;
  Application application_;
  std::optional<Device> device_;
};

/// RPDO 1 takes a controlword, TPDO 1 tells a changed statusword, as CiA 402 has it; what a robot's
/// controller wants besides, it maps itself.
struct DrivePdos {
  static constexpr canopen::DeviceSize kSize{.rpdos = 3, .tpdos = 2};
  static void prepare(canopen::CommunicationObjects<DriveApplication, kSize>& objects,
                      std::uint8_t node);
};
struct ImuPdos {
  static constexpr canopen::DeviceSize kSize{.rpdos = 1, .tpdos = 2};
  static void prepare(canopen::CommunicationObjects<ImuApplication, kSize>& objects,
                      std::uint8_t node);
};
struct FootPdos {
  static constexpr canopen::DeviceSize kSize{.rpdos = 1, .tpdos = 1};
  static void prepare(canopen::CommunicationObjects<FootApplication, kSize>& objects,
                      std::uint8_t node);
};

/// 1000h, 1008h and 1018h of the virtual devices; serial numbers are node ids.
canopen::Identity drive_identity(std::uint16_t model, std::uint8_t node);
canopen::Identity imu_identity(std::uint8_t node);
canopen::Identity foot_identity(std::uint8_t node);

using ImuNode = DeviceNode<ImuApplication, ImuPdos>;
using FootNode = DeviceNode<FootApplication, FootPdos>;

/// A drive as a node: it also watches its master's heartbeat, and tells its errors.
class DriveNode final : public DeviceNode<DriveApplication, DrivePdos> {
 public:
  DriveNode(const canopen::Identity& identity, std::uint8_t node, sim::Plant& plant, int joint,
            const DriveSetup& setup);

  void hear(const CanFrame& frame, std::uint64_t now_us) override;
  void work(std::uint64_t now_us) override;
  void power_off() override { application().power_off(); }

 private:
  void begin_anew() override { application().restart(); }
  void stopped() override { application().connection_lost(); }
  /// TPDO 1 is due if it tells events and there is one.
  void notice_status();
  std::uint16_t told_status_ = 0;
  bool in_error_ = false;
};

}  // namespace verp::can
