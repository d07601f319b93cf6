#pragma once
#include <optional>

#include "common/protocol/canopen/device.hpp"
#include "host/twin/can/drive.hpp"
#include "host/twin/can/node.hpp"
#include "host/twin/can/sensor.hpp"

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
    if constexpr (Setup::kSize.stores) keep();
    if (events.nmt != canopen::NmtEvent::kNone) obey(events.nmt);
  }
  void work(std::uint64_t now_us) override {
    if (device_->heartbeat_lost(now_us)) master_lost();
  }
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
  /// 1010h, or 1011h: the application's settings are stored, or no longer.
  virtual void keep_application(bool) {}
  /// NMT has stopped the node.
  virtual void stopped() {}
  /// Its master's heartbeat (1016h) does not come.
  virtual void master_lost() {}

 private:
  void boot() {
    device_.emplace(application_, identity_, node_);
    Setup::prepare(device_->objects(), node_);
    if (communication_) device_->objects().restore(*communication_);
    device_->start();
  }
  void obey(canopen::NmtEvent event) {
    if (event == canopen::NmtEvent::kState) {
      if (device_->state() == canopen::NmtState::kStopped) stopped();
      if (device_->state() == canopen::NmtState::kOperational) tell_all();
      return;
    }
    if (event == canopen::NmtEvent::kResetNode) begin_anew();
    boot();
  }
  // Who starts a node learns what is there: nothing need change before an event-driven TPDO comes.
  void tell_all() {
    for (std::size_t i = 0; i < Setup::kSize.tpdos; ++i) {
      if (!canopen::is_synchronous(device_->objects().tpdos[i].type())) device_->trigger(i);
    }
  }

  void keep() {
    const canopen::StoreOrder order = device_->objects().take_store_order();
    if (order == canopen::StoreOrder::kNone) return;
    const bool stores = order == canopen::StoreOrder::kStore;
    communication_.reset();
    if (stores) communication_.emplace(device_->objects());
    keep_application(stores);
  }

  canopen::Identity identity_;
  std::uint8_t node_;
  Application application_;
  std::optional<Device> device_;
  std::optional<typename Device::Objects> communication_;  ///< as stored by 1010h
};

/// RPDO 1 takes a controlword, TPDO 1 tells a changed statusword, as CiA 402 has it; what a robot's
/// controller wants besides, it maps itself.
struct DrivePdos {
  static constexpr canopen::DeviceSize kSize{.rpdos = 3, .tpdos = 2, .stores = true};
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
  void begin_anew() override;
  void keep_application(bool stores) override;
  void stopped() override;
  void master_lost() override;
  /// TPDO 1 is due if it tells events and there is one; 603Fh says what 1001h does.
  void notice_status();
  void tell_status(std::uint16_t status);
  std::uint16_t told_status_ = 0;
  std::optional<DriveApplication::Settings> stored_;
  DriveNews error_;  ///< of the drive itself, until it is gone
};

}  // namespace verp::can
