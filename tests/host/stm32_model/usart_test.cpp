#include <gtest/gtest.h>

#include <vector>

#include "hal/chip/stm32/registers/cortex_m.hpp"
#include "hal/chip/stm32/registers/dma.hpp"
#include "tests/host/stm32_model/chip.hpp"
#include "tests/support/stm32/dma_model.hpp"
#include "tests/support/stm32/usart_model.hpp"

namespace verp::hal::stm32::model {
namespace {

using namespace usart_v1;

constexpr std::uint32_t kU = base::kUsart2;
constexpr Time kByteTime = us(10);  // 10 bits at 1 Mbaud

/// At 1 Mbaud from 16 MHz.
struct Line {
  explicit Line(Family family = Family::kF405, std::uint32_t cr3 = 0)
      : machine(family), io(machine.io()), usart(machine.usart(2)), v2(family == Family::kF746) {
    enable(io, rcc::kApb1enr, rcc::kApb1Usart2);
    io.write32(kU + (v2 ? usart_v2::kBrr : kBrr), 16);
    io.write32(kU + (v2 ? usart_v2::kCr3 : kCr3), cr3);
    io.write32(kU + (v2 ? usart_v2::kCr1 : kCr1),
               (v2 ? usart_v2::kCr1Ue : kCr1Ue) | kCr1Re | kCr1Te);
  }
  std::uint32_t status() { return io.read32(kU + (v2 ? usart_v2::kIsr : kSr)); }
  std::uint32_t data() { return io.read32(kU + (v2 ? usart_v2::kRdr : kDr)); }
  void send(std::uint8_t byte) { io.write32(kU + (v2 ? usart_v2::kTdr : kDr), byte); }

  Machine machine;
  ModelIo io;
  UsartModel& usart;
  bool v2;
};

TEST(Usart, SendsInTheTimeOfItsBaudRateAndSaysWhenItIsDone) {
  for (const Family family : kFamilies) {
    Line line(family);
    EXPECT_NEAR(line.usart.baud(), 1e6, 1);
    line.status();
    line.send(0x55);
    EXPECT_NE(line.status() & kSrTxe, 0u);
    line.send(0xAA);
    EXPECT_EQ(line.status() & (kSrTxe | kSrTc), 0u);
    line.machine.advance(4 * kByteTime);
    EXPECT_NE(line.status() & kSrTc, 0u);
    ASSERT_EQ(line.usart.sent().size(), 2u);
    EXPECT_EQ(line.usart.sent()[0].data, 0x55);
    EXPECT_EQ(line.usart.sent()[1].data, 0xAA);
    EXPECT_EQ(line.usart.sent()[1].start, line.usart.sent()[0].end);
    EXPECT_EQ(line.usart.sent()[1].end - line.usart.sent()[1].start, kByteTime);
    EXPECT_EQ(line.machine.violations_text(), "");
  }
}

TEST(Usart, AByteWrittenWhileTxeIsZeroIsLostAndSeen) {
  Line line;
  for (std::uint8_t byte = 1; byte <= 3; ++byte) line.send(byte);
  EXPECT_TRUE(one_violation(line.machine, "TXE is 0"));
  line.machine.advance(5 * kByteTime);
  ASSERT_EQ(line.usart.sent().size(), 2u);
  EXPECT_EQ(line.usart.sent()[1].data, 3);
}

TEST(Usart, OldKindKeepsTcUnlessSrWasReadBeforeDrWasWritten) {
  Line line;
  line.send(1);
  EXPECT_NE(line.status() & kSrTc, 0u);
  line.machine.advance(3 * kByteTime);
  line.status();
  line.send(2);
  EXPECT_EQ(line.status() & kSrTc, 0u);
  line.machine.advance(3 * kByteTime);
  line.io.write32(kU + kSr, kSrKeep & ~kSrTc);
  EXPECT_EQ(line.status() & kSrTc, 0u);
  EXPECT_EQ(line.machine.violations_text(), "");
}

TEST(Usart, ReceivesAndTellsIdleOnceAfterTheLastByte) {
  for (const Family family : kFamilies) {
    Line line(family);
    const std::uint8_t bytes[] = {0x12};
    line.usart.receive(bytes, 1, 1000000);
    line.machine.advance(kByteTime - us(2));
    EXPECT_EQ(line.status() & kSrRxne, 0u);
    line.machine.advance(us(3));
    EXPECT_EQ(line.status() & (kSrRxne | kSrIdle), kSrRxne);
    EXPECT_EQ(line.data(), 0x12u);
    EXPECT_EQ(line.status() & kSrRxne, 0u);
    line.machine.advance(2 * kByteTime);
    EXPECT_NE(line.status() & kSrIdle, 0u);
    if (line.v2) {
      line.io.write32(kU + usart_v2::kIcr, usart_v2::kIcrIdle);
    } else {
      line.data();  // after SR
    }
    line.machine.advance(10 * kByteTime);
    EXPECT_EQ(line.status() & kSrIdle, 0u);
    EXPECT_EQ(line.machine.violations_text(), "");
  }
}

TEST(Usart, AByteTooManyIsAnOverrunAndTheFirstStays) {
  for (const Family family : kFamilies) {
    Line line(family);
    const std::uint8_t bytes[] = {1, 2, 3};
    line.usart.receive(bytes, 3, 1000000);
    line.machine.advance(4 * kByteTime);
    EXPECT_NE(line.status() & kSrOre, 0u);
    EXPECT_EQ(line.data(), 1u);
    if (line.v2) {
      EXPECT_NE(line.status() & kSrOre, 0u);
      line.io.write32(kU + usart_v2::kIcr, usart_v2::kIcrOre);
    }
    EXPECT_EQ(line.status() & (kSrOre | kSrRxne), 0u);
  }
}

TEST(Usart, OldKindClearsErrorsOnlyByReadingSrAndThenDr) {
  Line line;
  line.usart.receive(0x33, 1000000, UsartModel::Flaw::kNoise);
  line.machine.advance(2 * kByteTime);
  line.data();  // no read of SR
  EXPECT_NE(line.status() & kSrNf, 0u);
  line.data();
  EXPECT_EQ(line.status() & kSrNf, 0u);
}

TEST(Usart, FramingErrorsNoiseAndBreaksShowWithTheByte) {
  using Flaw = UsartModel::Flaw;
  for (const Family family : kFamilies) {
    for (const Flaw flaw : {Flaw::kNoise, Flaw::kFraming, Flaw::kBreak}) {
      Line line(family);
      line.usart.receive(0x41, 1000000, flaw);
      line.machine.advance(2 * kByteTime);
      const std::uint32_t flags = line.status();
      EXPECT_EQ((flags & kSrNf) != 0, flaw == Flaw::kNoise);
      EXPECT_EQ((flags & kSrFe) != 0, flaw != Flaw::kNoise);
      EXPECT_EQ(line.data(), flaw == Flaw::kBreak ? 0u : 0x41u);
    }
  }
}

TEST(Usart, AWrongBaudRateDoesNotGoThrough) {
  for (const std::uint32_t baud : {1000000u, 1030000u, 1060000u, 115200u}) {
    Line line;
    line.usart.receive(0x41, baud);
    line.machine.advance(us(200));
    const std::uint32_t flags = line.status();
    const bool right = line.data() == 0x41u && (flags & (kSrFe | kSrNf)) == 0;
    EXPECT_EQ(right, baud == 1000000u || baud == 1030000u) << baud;
  }
}

TEST(Usart, WhatComesBeforeItListensIsLost) {
  Line line;
  line.io.write32(kU + kCr1, kCr1Ue | kCr1Te);
  line.usart.receive(0x41, 1000000);
  line.machine.advance(us(5));
  line.io.write32(kU + kCr1, kCr1Ue | kCr1Te | kCr1Re);  // in the middle of the byte
  line.machine.advance(us(50));
  EXPECT_EQ(line.status() & kSrRxne, 0u);
}

TEST(Usart, InHalfDuplexItHearsItself) {
  for (const Family family : kFamilies) {
    Line line(family, kCr3Hdsel);
    line.send(0x7E);
    line.machine.advance(us(40));
    EXPECT_NE(line.status() & kSrRxne, 0u);
    EXPECT_EQ(line.data(), 0x7Eu);
    EXPECT_TRUE(line.usart.sent()[0].whole);
  }
}

TEST(Usart, TheDirectionPinMustStayUntilTheLastStopBit) {
  for (const bool late : {true, false}) {
    Line line;
    enable(line.io, rcc::kAhb1enr, rcc::kAhb1GpioA);
    const std::uint32_t port = base::gpio('A');
    line.usart.direction_pin(line.machine.gpio('A'), 1, true);
    modify32(line.io, port + gpio::kModer, 0, gpio::kModeOutput << 2);
    line.machine.advance(us(20));
    line.io.write32(port + gpio::kBsrr, 1u << 1);
    line.send(0x99);
    line.machine.advance(late ? us(12) : us(6));
    line.io.write32(port + gpio::kBsrr, 1u << 17);
    line.machine.advance(us(20));
    ASSERT_EQ(line.usart.sent().size(), 1u);
    EXPECT_EQ(line.usart.sent()[0].whole, late);
  }
}

TEST(Usart, SettingsOfTheNewKindAreFixedWhileItIsOn) {
  Line line(Family::kF746);
  line.io.write32(kU + usart_v2::kBrr, 32);
  EXPECT_TRUE(one_violation(line.machine, "BRR while UE"));
  modify32(line.io, kU + usart_v2::kCr3, 0, kCr3Hdsel);
  EXPECT_TRUE(one_violation(line.machine, "while UE is set"));
  modify32(line.io, kU + usart_v2::kCr3, 0, kCr3Dmar);
  modify32(line.io, kU + usart_v2::kCr1, 0, kCr1Idleie);
  EXPECT_EQ(line.machine.violations_text(), "");
}

TEST(Usart, AStuckShifterNeverSaysThatItIsDone) {
  Line line;
  line.usart.tx_stuck = true;
  line.status();
  line.send(1);
  EXPECT_FALSE(wait_set(line.machine, kU + kSr, kSrTc, ms(10)));
}

TEST(Dma, CircularReceptionCountsDownMarksItsHalvesAndGoesRound) {
  for (const Family family : kFamilies) {
    Line line(family, kCr3Dmar);
    enable(line.io, rcc::kAhb1enr, rcc::kAhb1Dma1);
    std::uint8_t buffer[8] = {};
    const std::uint32_t stream = base::kDma1 + 5 * dma::kStreamStep;
    line.io.write32(stream + dma::kPar, kU + (line.v2 ? usart_v2::kRdr : kDr));
    line.io.write32(stream + dma::kM0ar, line.io.bus_address(buffer, sizeof buffer));
    line.io.write32(stream + dma::kNdtr, sizeof buffer);
    line.io.write32(stream + dma::kCr,
                    4u << dma::kCrChselShift | dma::kCrMinc | dma::kCrCirc | dma::kCrEn);
    const auto flags = [&] {
      return line.io.read32(base::kDma1 + dma::kHisr) >> dma::flag_shift(5) & dma::kFlagAll;
    };
    const std::uint8_t bytes[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    line.usart.receive(bytes, 4, 1000000);
    line.machine.advance(us(45));
    EXPECT_EQ(line.io.read32(stream + dma::kNdtr), 4u);
    EXPECT_EQ(flags(), dma::kFlagHt);
    line.usart.receive(bytes + 4, 6, 1000000);
    line.machine.advance(us(65));
    EXPECT_EQ(line.io.read32(stream + dma::kNdtr), 6u);
    EXPECT_EQ(flags(), dma::kFlagHt | dma::kFlagTc);
    const std::uint8_t want[] = {9, 10, 3, 4, 5, 6, 7, 8};
    for (int i = 0; i < 8; ++i) EXPECT_EQ(buffer[i], want[i]);
    line.io.write32(base::kDma1 + dma::kHifcr, dma::kFlagAll << dma::flag_shift(5));
    EXPECT_EQ(flags(), 0u);
    EXPECT_EQ(line.machine.violations_text(), "");
  }
}

TEST(Dma, SendsABlockOnceAndSwitchesItselfOff) {
  Line line(Family::kF405, kCr3Dmat);
  enable(line.io, rcc::kAhb1enr, rcc::kAhb1Dma1);
  std::uint8_t bytes[] = {9, 8, 7};
  const std::uint32_t stream = base::kDma1 + 6 * dma::kStreamStep;
  line.io.write32(stream + dma::kPar, kU + kDr);
  line.io.write32(stream + dma::kM0ar, line.io.bus_address(bytes, 3));
  line.io.write32(stream + dma::kNdtr, 3);
  line.io.write32(stream + dma::kCr,
                  4u << dma::kCrChselShift | dma::kCrMinc | dma::kCrDirToPeripheral | dma::kCrEn);
  line.machine.advance(us(100));
  ASSERT_EQ(line.usart.sent().size(), 3u);
  EXPECT_EQ(line.usart.sent()[2].data, 7);
  EXPECT_EQ(line.io.read32(stream + dma::kCr) & dma::kCrEn, 0u);
  line.io.write32(stream + dma::kNdtr, 3);
  modify32(line.io, stream + dma::kCr, 0, dma::kCrEn);  // TCIF and HTIF are set
  EXPECT_TRUE(one_violation(line.machine, "flags were cleared")) << line.machine.violations_text();
}

TEST(Dma, AWrongChannelServesNobody) {
  Line line(Family::kF405, kCr3Dmar);
  enable(line.io, rcc::kAhb1enr, rcc::kAhb1Dma1);
  std::uint8_t buffer[4] = {};
  const std::uint32_t stream = base::kDma1 + 5 * dma::kStreamStep;
  line.io.write32(stream + dma::kPar, kU + kDr);
  line.io.write32(stream + dma::kM0ar, line.io.bus_address(buffer, sizeof buffer));
  line.io.write32(stream + dma::kNdtr, 4);
  line.io.write32(stream + dma::kCr, 3u << dma::kCrChselShift | dma::kCrMinc | dma::kCrEn);
  line.usart.receive(0x41, 1000000);
  line.machine.advance(us(50));
  EXPECT_EQ(line.io.read32(stream + dma::kNdtr), 4u);
}

TEST(Dma, AStreamEndsWhenItEndsOrNeverAndIsFixedUntilThen) {
  for (const bool stuck : {false, true}) {
    Line line(Family::kF746, kCr3Dmar);
    enable(line.io, rcc::kAhb1enr, rcc::kAhb1Dma1);
    line.machine.dma(1).script[5].enable_stuck = stuck;
    line.machine.dma(1).script[5].disable_time = us(5);
    std::uint8_t buffer[4] = {};
    const std::uint32_t stream = base::kDma1 + 5 * dma::kStreamStep;
    line.io.write32(stream + dma::kPar, kU + usart_v2::kRdr);
    line.io.write32(stream + dma::kM0ar, line.io.bus_address(buffer, sizeof buffer));
    line.io.write32(stream + dma::kNdtr, 4);
    line.io.write32(stream + dma::kCr, 4u << dma::kCrChselShift | dma::kCrMinc | dma::kCrEn);
    line.io.write32(stream + dma::kNdtr, 2);
    EXPECT_TRUE(one_violation(line.machine, "while EN is set"));
    modify32(line.io, stream + dma::kCr, dma::kCrEn, 0);
    EXPECT_NE(line.io.read32(stream + dma::kCr) & dma::kCrEn, 0u);
    EXPECT_EQ(wait_clear(line.machine, stream + dma::kCr, dma::kCrEn, ms(1)), !stuck);
    EXPECT_EQ(line.machine.violations_text(), "");
  }
}

TEST(Dma, ATransferErrorStopsTheStreamAndInterrupts) {
  Line line(Family::kF405, kCr3Dmar);
  enable(line.io, rcc::kAhb1enr, rcc::kAhb1Dma1);
  line.machine.dma(1).script[5].fail_after = 1;
  int interrupts = 0;
  line.machine.attach(irq::dma1(5), [&] {
    ++interrupts;
    line.io.write32(base::kDma1 + dma::kHifcr, dma::kFlagAll << dma::flag_shift(5));
  });
  line.io.write32(cortex_m::kNvicIser, 1u << irq::dma1(5));
  std::uint8_t buffer[4] = {};
  const std::uint32_t stream = base::kDma1 + 5 * dma::kStreamStep;
  line.io.write32(stream + dma::kPar, kU + kDr);
  line.io.write32(stream + dma::kM0ar, line.io.bus_address(buffer, sizeof buffer));
  line.io.write32(stream + dma::kNdtr, 4);
  line.io.write32(stream + dma::kCr,
                  4u << dma::kCrChselShift | dma::kCrMinc | dma::kCrTeie | dma::kCrEn);
  const std::uint8_t bytes[] = {1, 2, 3};
  line.usart.receive(bytes, 3, 1000000);
  line.machine.advance(us(50));
  EXPECT_EQ(interrupts, 1);
  EXPECT_EQ(line.io.read32(stream + dma::kCr) & dma::kCrEn, 0u);
  EXPECT_EQ(buffer[0], 1);
  EXPECT_EQ(buffer[1], 0);
}

}  // namespace
}  // namespace verp::hal::stm32::model
