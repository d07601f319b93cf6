#pragma once
#include <cstdint>
#include <deque>
#include <optional>

#include "firmware/app/link_bus.hpp"
#include "firmware/store/flash_store.hpp"
#include "hal/chip/stm32/bxcan.hpp"
#include "hal/chip/stm32/flash_pages.hpp"
#include "hal/chip/stm32/usart.hpp"
#include "hal/chip/stm32/watchdog.hpp"
#include "tests/contract/fakes.hpp"
#include "tests/support/stm32/can_rig.hpp"
#include "tests/support/stm32/dma_model.hpp"
#include "tests/support/stm32/flash_model.hpp"
#include "tests/support/stm32/imu_rig.hpp"
#include "tests/support/stm32/iwdg_model.hpp"
#include "tests/support/stm32/rig.hpp"
#include "tests/support/stm32/usart_model.hpp"

namespace verp::test {

using hal::stm32::Family;
using hal::stm32::Io;
using hal::stm32::test::Rig;
using ChipIo = hal::stm32::test::Io;
using ChipTimer = hal::stm32::test::Timer;
using ChipDog = hal::stm32::IndependentWatchdog<ChipIo>;

class UsartPair {
  static constexpr std::uint32_t kBaud = 2'000'000;
  static constexpr std::uint32_t kStep_us = 50;
  using Port = hal::stm32::Usart<ChipIo, hal::stm32::UsartV1, ChipTimer, 512>;

 public:
  static constexpr bool kDetectsLoss = false;
  static constexpr bool kKeepsBytesOnLoss = true;

  class Far final : public hal::ByteLink {
   public:
    explicit Far(UsartPair& pair) : pair_(pair) {}
    std::size_t write(const std::uint8_t* data, std::size_t size,
                      std::uint32_t timeout_us) override {
      std::size_t taken = 0;
      for (std::uint32_t waited_us = 0;; waited_us += kStep_us) {
        for (; taken < size && pair_.line_has_room(); ++taken) pair_.put(data[taken]);
        if (taken == size || waited_us >= timeout_us) return taken;
        pair_.rig_.machine.advance(hal::stm32::model::us(kStep_us));
      }
    }
    std::size_t read(std::uint8_t* buffer, std::size_t capacity,
                     std::uint32_t timeout_us) override {
      for (std::uint32_t waited_us = 0; inbox_.empty() && waited_us < timeout_us;
           waited_us += kStep_us) {
        pair_.rig_.machine.advance(hal::stm32::model::us(kStep_us));
      }
      std::size_t count = 0;
      for (; count < capacity && !inbox_.empty(); inbox_.pop_front()) {
        buffer[count++] = inbox_.front();
      }
      return count;
    }
    bool connected() const override { return true; }
    hal::LinkErrors errors() const override { return {}; }

   private:
    friend class UsartPair;
    UsartPair& pair_;
    std::deque<std::uint8_t> inbox_;
  };

  UsartPair() {
    using namespace hal::stm32;
    auto& machine = rig_.machine;
    enable_clock(machine.io(), rcc::kApb2enr, rcc::kApb2Usart1);
    enable_clock(machine.io(), rcc::kAhb1enr, rcc::kAhb1Dma2);
    for (const unsigned line : {irq::kUsart1, irq::dma2(2)}) {
      machine.attach(line, [this] { port_.on_interrupt(); });
      enable_interrupt(machine.io(), line, 4);
    }
    line_.on_sent([this](const model::UsartModel::Sent& sent) {
      if (whole_) far_.inbox_.push_back(sent.data);
      line_.forget_sent();
    });
    port_.open(rig_.clocks.apb2_hz, kBaud);
    machine.advance(model::us(100));
  }

  Port& near() { return port_; }
  Far& far() { return far_; }
  void cut() { whole_ = false; }
  void mend() { whole_ = true; }
  std::uint64_t now_us() const { return rig_.timer.now_us(); }
  ChipTimer& clock() { return rig_.timer; }
  hal::stm32::model::Machine& machine() { return rig_.machine; }

 private:
  bool line_has_room() const {
    return line_.line_free_at() < rig_.machine.now() + hal::stm32::model::us(500);
  }
  void put(std::uint8_t byte) {
    if (whole_) line_.receive(byte, kBaud);
  }

  Rig rig_{Family::kF405};
  hal::stm32::model::UsartModel& line_ = rig_.machine.usart(1);
  Port port_{{.base = hal::stm32::base::kUsart1,
              .dma_base = hal::stm32::base::kDma2,
              .dma_stream = 2,
              .dma_channel = 4,
              .direction = {}},
             rig_.timer,
             rig_.machine.io()};
  bool whole_ = true;
  Far far_{*this};
};

struct UsartBus {
  static constexpr std::uint32_t kPlenty_us = 20'000;
  static constexpr std::uint64_t kSlack_us = 200;  // register accesses

  explicit UsartBus(int pings) : left(pings) { wait_for_ping(); }
  void wait_for_ping() {
    using hal::stm32::model::us;
    pair.machine().at(pair.machine().now() + us(50), [this] { answer(); });
  }
  void answer() {
    std::uint8_t byte = 0;
    while (pair.far().read(&byte, 1, 0) == 1) ++heard;
    if (heard >= kPing.size() && left > 0) {
      heard -= kPing.size();
      --left;
      const std::vector<std::uint8_t> reply = ping_reply();
      pair.far().write(reply.data(), reply.size(), 0);
    }
    wait_for_ping();
  }

  UsartPair pair;
  std::size_t heard = 0;
  int left;
  app::LinkBus<std::remove_reference_t<decltype(pair.near())>, ChipTimer> bus{pair.near(),
                                                                              pair.clock()};
};

template <Family kFamily>
struct ChipCan {
  static constexpr std::uint32_t kPlenty_us = 20'000;
  static constexpr std::uint64_t kSlack_us = 200;  // register accesses
  static constexpr bool kBusOff = true;

  void far_send(const CanFrame& frame) { board.can.send(frame); }
  bool far_take(CanFrame& frame) {
    if (taken == board.can.sent().size()) return false;
    frame = board.can.sent()[taken++].frame;
    return true;
  }
  void fill_and_bus_off(const CanFrame& frame, int count) {
    board.can.break_next = 1000;
    for (int i = 0; i < count; ++i) EXPECT_TRUE(bus.send(frame));
    for (int i = 0; i < 100 && bus.errors().bus_offs == 0; ++i) {
      board.rig.machine.advance(hal::stm32::model::us(100));
    }
    board.can.break_next = 0;
  }

  hal::stm32::test::CanRig board{kFamily};
  hal::stm32::test::Can& bus = board.driver;
  std::size_t taken = 0;
};

struct ChipTicks {
  void spend(std::uint32_t time_us) { rig.machine.advance(hal::stm32::model::us(time_us)); }
  Rig rig{Family::kF405};
  ChipTimer& source = rig.timer;
};

/// Across resets, its oscillator at kLsi_hz.
template <std::uint32_t kLsi_hz>
struct ChipWatchdog {
  class Dog {
   public:
    Dog() { machine_.iwdg().lsi_hz = kLsi_hz; }
    void advance(std::uint64_t time_us) {
      const std::uint32_t before = machine_.resets();
      machine_.advance(hal::stm32::model::us(time_us));
      if (machine_.resets() != before) restart();
    }
    void reset() {
      machine_.reset(hal::stm32::model::ResetCause::kPin);
      restart();
      --resets_;
    }
    std::uint32_t resets() const { return resets_; }
    bool start(std::uint32_t timeout_us) { return dog_->start(timeout_us); }
    void feed() { dog_->feed(); }
    bool caused_reset() const { return dog_->caused_reset(); }

   private:
    void restart() {
      ++resets_;
      dog_.emplace(hal::stm32::take_reset_cause(machine_.io()), machine_.io());
    }
    hal::stm32::model::Machine machine_{Family::kF405};
    std::optional<ChipDog> dog_{std::in_place, hal::stm32::ResetCause::kPowerOn, machine_.io()};
    std::uint32_t resets_ = 0;
  };
  Dog dog;
};

/// Two sectors.
template <Family kFamily>
struct ChipFlash {
  using Pages = hal::stm32::SectorPages<ChipIo, ChipTimer, ChipDog>;
  ChipFlash() { store.open(); }
  Rig rig{kFamily};
  ChipDog dog{hal::stm32::ResetCause::kPowerOn, rig.machine.io()};
  Pages pages{kFamily, 1, 2, rig.timer, dog, rig.machine.io()};
  store::FlashStore<Pages> store{pages};
};

template <hal::stm32::model::ImuKind kKind>
struct ChipImu {
  ChipImu() { settle(); }
  void measure(std::int16_t gyro_x) {
    board.device.motion({gyro_x, 0, 0}, {0, 0, 0});
    look();
    board.device.frozen = false;
    const std::uint32_t taken = board.device.samples_taken();
    while (board.device.samples_taken() == taken) look();
    board.device.frozen = true;
  }
  void break_chip(bool yes) { board.device.silent = yes; }
  hal::ImuStatus read(hal::ImuSample& sample) {
    board.rig.machine.advance(hal::stm32::model::us(100));
    const hal::ImuStatus status = board.read();
    if (status == hal::ImuStatus::kFresh) sample = board.sample;
    return status;
  }
  std::uint32_t faults() const { return board.imu.faults(); }
  void settle() {
    board.device.frozen = true;
    for (int tick = 0; tick < 30; ++tick) {
      board.read();
      board.rig.machine.advance(hal::stm32::model::ms(8));
    }
  }
  void look() {
    board.rig.machine.advance(hal::stm32::model::us(100));
    board.device.update(board.rig.machine.now());
  }

  hal::stm32::test::ImuRig board{Family::kF405, kKind};
};

using Mpu9250 = ChipImu<hal::stm32::model::ImuKind::kMpu9250>;
using Icm20648 = ChipImu<hal::stm32::model::ImuKind::kIcm20648>;

}  // namespace verp::test
