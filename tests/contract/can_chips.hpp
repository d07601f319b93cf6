#pragma once
#include <cstdint>

#include "hal/chip/sja1000/sja1000.hpp"
#include "hal/chip/zynqmp_can/zynqmp_can.hpp"
#include "tests/contract/fakes.hpp"
#include "tests/support/can/sja1000_model.hpp"
#include "tests/support/can/zynqmp_can_model.hpp"

namespace verp::test {

/// A `Model` on its wire and its `Bus`.
template <class Model, class Io, class Bus>
struct CanChip {
  static constexpr std::uint32_t kPlenty_us = 20'000;
  static constexpr std::uint64_t kSlack_us = 100;  ///< reads of registers
  static constexpr bool kBusOff = true;
  static constexpr std::uint32_t kBitRate_hz = 1'000'000;

  CanChip() = default;
  CanChip(const CanChip&) = delete;
  CanChip& operator=(const CanChip&) = delete;
  ~CanChip() { EXPECT_EQ(model.violations(), 0u) << model.first_violation().c_str(); }

  void far_send(const CanFrame& frame) { model.wire.far_send(frame); }
  /// Frames on the wire or in the chip come first.
  bool far_take(CanFrame& frame) {
    for (std::uint32_t us = 0; us < kPlenty_us && !model.wire.idle(); ++us) model.advance(1);
    return model.wire.far_take(frame);
  }
  void fill_and_bus_off(const CanFrame& frame, int count) {
    model.wire.hold(true);
    for (int i = 0; i < count; ++i) EXPECT_TRUE(bus.send(frame));
    model.wire.spoil(ErrorCounter::kBusOff / ErrorCounter::kPerError);
    model.wire.hold(false);
    for (std::uint32_t us = 0; us < kPlenty_us && !model.off(); ++us) model.advance(1);
    CanFrame heard;
    EXPECT_FALSE(bus.poll(heard, 0));
  }

  Model model;
  Bus bus{Io(model)};
};

struct Sja1000Chip : CanChip<Sja1000Model, Sja1000ModelIo, hal::sja1000::Sja1000<Sja1000ModelIo>> {
  /// The board kvaser_pci's.
  static constexpr CanTiming kTiming =
      hal::sja1000::Sja1000<Sja1000ModelIo>::timing(16'000'000, kBitRate_hz);
  Sja1000Chip() { EXPECT_TRUE(bus.open(kTiming)); }
};

template <hal::zynqmp_can::Layout kLayout>
struct ZynqmpChip : CanChip<ZynqmpCanModel<kLayout>, ZynqmpCanModelIo<kLayout>,
                            hal::zynqmp_can::ZynqmpCan<ZynqmpCanModelIo<kLayout>, kLayout>> {
  using Base = CanChip<ZynqmpCanModel<kLayout>, ZynqmpCanModelIo<kLayout>,
                       hal::zynqmp_can::ZynqmpCan<ZynqmpCanModelIo<kLayout>, kLayout>>;
  static constexpr CanTiming kTiming = decltype(Base::bus)::timing(100'000'000, Base::kBitRate_hz);
  ZynqmpChip() { EXPECT_TRUE(this->bus.open(kTiming, Base::kBitRate_hz)); }
};

using ZynqmpSilicon = ZynqmpChip<hal::zynqmp_can::Layout::kSilicon>;
using ZynqmpQemu = ZynqmpChip<hal::zynqmp_can::Layout::kQemu>;

}  // namespace verp::test
