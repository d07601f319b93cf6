#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "firmware/app/app.hpp"
#include "firmware/app/lockstep_bus.hpp"
#include "firmware/app/operator_device.hpp"
#include "host/os/link/link.hpp"

/// Two serial ports, like a board's, in a thread.
namespace verp::test {

/// Opens as soon as its endpoint exists; a test can disturb it.
class ControllerPort final : public hal::ByteLink {
 public:
  explicit ControllerPort(std::string endpoint) : endpoint_(std::move(endpoint)) {}

  std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t timeout_us) override {
    return open(timeout_us) ? link_->write(data, size, timeout_us) : 0;
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override {
    if (!open(timeout_us)) return 0;
    const std::size_t count = link_->read(buffer, capacity, timeout_us);
    for (std::size_t i = 0; i < count; ++i) {
      if (flips_per_million > random_() % 1'000'000) buffer[i] ^= 1;
    }
    if (count > 0 && cut_every > 0 && ++reads_ % cut_every == 0) {
      link_.reset();  // the bytes just read are lost
      ++cuts;
      return 0;
    }
    return count;
  }
  bool connected() const override { return link_ && link_->connected(); }
  hal::LinkErrors errors() const override { return link_ ? link_->errors() : hal::LinkErrors{}; }

  unsigned flips_per_million = 0;  ///< of received bytes
  int cut_every = 0;               ///< every so many reads with data
  int cuts = 0;
  std::atomic<bool> opened = false;  ///< the peer accepted the connection

 private:
  bool open(std::uint32_t timeout_us) {
    if (link_) return true;
    try {
      link_.emplace(link::parse_endpoint(endpoint_));
      opened = true;
    } catch (const link::LinkError&) {
      std::this_thread::sleep_for(std::chrono::microseconds(timeout_us + 1000));
    }
    return link_.has_value();
  }
  std::string endpoint_;
  std::optional<link::Link> link_;
  std::minstd_rand random_{7};
  int reads_ = 0;
};

/// Ends with this object, or when the twin stops or refuses it. Resets once, at tick `reset_at`.
/// `Lockstep<Port, Idle>` is its servo bus; `actions` must outlive it.
template <class Port, template <class, class> class Lockstep>
class ControllerOn {
 public:
  ControllerOn(const Params& params, const std::string& bus, const std::string& operators,
               const std::function<void(Port&)>& prepare = {}, std::uint32_t reset_at = 0,
               const action::Library& actions = {})
      : params_(params),
        bus_port_(bus),
        operator_port_(operators),
        reset_at_(reset_at),
        actions_(actions) {
    if (prepare) prepare(bus_port_);
    thread_ = std::thread([this] { run(); });
  }
  ~ControllerOn() { join(); }
  void join() {
    if (!thread_.joinable()) return;
    for (int i = 0; i < 200 && !done_; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    over_ = true;
    thread_.join();
  }
  int cuts() const { return bus_port_.cuts; }
  std::uint32_t spoilt() const { return spoilt_; }
  std::uint32_t ticks() const { return ticks_; }
  lockstep::Verdict verdict() const { return verdict_; }

 private:
  struct Life {
    Life(ControllerOn& owner)
        : device(owner.operator_port_, owner.params_, {}),
          bus(owner.bus_port_, Idle{&owner, &device}),
          loop(owner.params_, bus, device, device, nullptr, app::Core{owner.actions_}) {
      device.offer_actions(owner.actions_.count());
    }

    struct Idle {
      bool operator()() const {
        device->poll();
        return !controller->over_;
      }
      ControllerOn* controller;
      app::OperatorDevice* device;
    };
    using Bus = Lockstep<Port, Idle>;
    using Device = app::OperatorDevice;
    Device device;
    Bus bus;
    app::App<Bus, Device, Device> loop;
  };

  void run() {
    bool again = true;
    for (std::uint32_t until = reset_at_; again; until = 0) {
      Life life(*this);
      verdict_ = life.bus.greet(params_);
      if (verdict_ == lockstep::Verdict::kAccepted) {
        life.loop.bring_up();
        while (!life.bus.stopped() && (until == 0 || life.loop.inputs().tick < until)) {
          life.loop.tick();
        }
      }
      again = until > 0 && verdict_ == lockstep::Verdict::kAccepted && !life.bus.stopped();
      spoilt_ = life.bus.counters().spoilt;
      ticks_ = life.loop.inputs().tick;
    }
    done_ = true;
  }

  const Params params_;
  Port bus_port_;
  ControllerPort operator_port_;
  const std::uint32_t reset_at_;
  const action::Library actions_;
  std::atomic<bool> over_ = false, done_ = false;
  lockstep::Verdict verdict_ = lockstep::Verdict::kNoAnswer;
  std::uint32_t spoilt_ = 0, ticks_ = 0;
  std::thread thread_;
};
using LinkController = ControllerOn<ControllerPort, app::LockstepBus>;

}  // namespace verp::test
