#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/stm32/usb_rig.hpp"

/// A chip's USB port and a PC's program, which closes the port or, if `kPulled`, pulls the cable.
namespace verp::test {

template <hal::stm32::Family kFamily, bool kPulled>
class UsbPair {
  static constexpr std::uint32_t kStep_us = 50;

 public:
  static constexpr bool kDetectsLoss = true;
  static constexpr bool kKeepsBytesOnLoss = !kPulled;  // some bytes may be in the PC

  class Far final : public hal::ByteLink {
   public:
    explicit Far(UsbPair& pair) : pair_(pair) {}
    /// Waits until the device has them.
    std::size_t write(const std::uint8_t* data, std::size_t size,
                      std::uint32_t timeout_us) override {
      constexpr std::size_t kRoom = 256;
      auto& host = pair_.rig_.host;
      std::size_t taken = 0;
      for (std::uint32_t waited_us = 0;; waited_us += kStep_us) {
        const std::size_t count = std::min(size - taken, kRoom - std::min(kRoom, host.unsent()));
        host.send({data + taken, data + taken + count});
        taken += count;
        if ((taken == size && host.unsent() == 0) || waited_us >= timeout_us) return taken;
        pair_.pass(kStep_us);
      }
    }
    std::size_t read(std::uint8_t* buffer, std::size_t capacity,
                     std::uint32_t timeout_us) override {
      auto& host = pair_.rig_.host;
      for (std::uint32_t waited_us = 0; inbox_.empty() && waited_us < timeout_us;
           waited_us += kStep_us) {
        pair_.pass(kStep_us);
        inbox_ = host.take();
      }
      if (inbox_.empty()) inbox_ = host.take();
      const std::size_t count = std::min(capacity, inbox_.size());
      std::copy_n(inbox_.begin(), count, buffer);
      inbox_.erase(inbox_.begin(), inbox_.begin() + static_cast<std::ptrdiff_t>(count));
      return count;
    }
    bool connected() const override { return pair_.rig_.host.opened(); }
    hal::LinkErrors errors() const override { return {}; }

   private:
    UsbPair& pair_;
    std::vector<std::uint8_t> inbox_;
  };

  UsbPair() {
    EXPECT_TRUE(rig_.open());
    EXPECT_TRUE(rig_.host.plug() && rig_.host.open());
    rig_.port.write(nullptr, 0, 0);  // notices the host
  }
  auto& near() { return rig_.port; }
  Far& far() { return far_; }
  void cut() {
    if (kPulled) {
      rig_.host.unplug();
    } else {
      rig_.host.close();
    }
  }
  void mend() { EXPECT_TRUE((!kPulled || rig_.host.plug()) && rig_.host.open()); }
  std::uint64_t now_us() const { return rig_.timer.now_us(); }

 private:
  void pass(std::uint32_t time_us) { rig_.machine.advance(hal::stm32::model::us(time_us)); }

  hal::stm32::test::UsbRig rig_{kFamily};
  Far far_{*this};
};

}  // namespace verp::test
