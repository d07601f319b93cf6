#pragma once
#include <optional>

#include "common/protocol/canopen/device.hpp"
#include "host/twin/can/drive.hpp"
#include "host/twin/can/node.hpp"
#include "host/twin/can/sensor.hpp"

namespace verp::can {

/// Runs an application as a CANopen node with the PDOs of `Setup`, rebuilt at each reset.
///  - Setup::kSize: sizes of the device's object tables.
///  - Setup::prepare(objects, node): sets the factory values of the communication objects.
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
  /// Restores the application's factory state, not that of the communication.
  virtual void begin_anew() {}
  /// 1010h or 1011h: stores the application's settings or discards the stored ones.
  virtual void keep_application(bool) {}
  virtual void stopped() {}
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
  // Sends the event-driven TPDOs at once on start: their values may never change.
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
  std::optional<typename Device::Objects> communication_;  ///< stored by 1010h
};

/// As in CiA 402, RPDO 1 holds the controlword and TPDO 1 reports a changed statusword.
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

/// 1000h, 1008h and 1018h of the virtual devices; the serial number is the node id.
canopen::Identity drive_identity(std::uint16_t model, std::uint8_t node);
canopen::Identity imu_identity(std::uint8_t node);
canopen::Identity foot_identity(std::uint8_t node);

using ImuNode = DeviceNode<ImuApplication, ImuPdos>;
using FootNode = DeviceNode<FootApplication, FootPdos>;

/// A drive that also watches its master's heartbeat and reports errors.
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
  /// Triggers TPDO 1 if it is event-driven and the statusword changed; copies the error of 1001h to
  /// 603Fh.
  void notice_status();
  void tell_status(std::uint16_t status);
  std::uint16_t told_status_ = 0;
  std::optional<DriveApplication::Settings> stored_;
  DriveNews error_;  ///< the drive's own error, while it lasts
};

}  // namespace verp::can
