#include "hal/chip/stm32/otg_fs.hpp"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/usb_rig.hpp"

// Beyond the suite of hal/contract/byte_link.hpp.
namespace verp::hal::stm32::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes noise(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  Bytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

class UsbPort : public EachFamily {
 protected:
  void meet() {
    ASSERT_TRUE(rig.open());
    ASSERT_TRUE(rig.host.plug());
    ASSERT_TRUE(rig.host.open());
    look();
    ASSERT_TRUE(rig.port.connected());
  }
  void look() { rig.port.write(nullptr, 0, 0); }
  Bytes read(std::size_t capacity, std::uint32_t timeout_us) {
    Bytes bytes(capacity);
    bytes.resize(rig.port.read(bytes.data(), capacity, timeout_us));
    return bytes;
  }
  Bytes read_all() {
    Bytes all;
    for (Bytes piece = read(100, 2000); !piece.empty(); piece = read(100, 2000)) {
      all.insert(all.end(), piece.begin(), piece.end());
    }
    return all;
  }
  std::size_t write(const Bytes& bytes, std::uint32_t timeout_us) {
    return rig.port.write(bytes.data(), bytes.size(), timeout_us);
  }
  void expect_alive() {
    look();
    ASSERT_TRUE(rig.port.connected());
    const Bytes there = noise(150, 1);
    const Bytes back = noise(170, 2);
    rig.host.take();
    rig.host.send(there);
    EXPECT_EQ(read_all(), there);
    EXPECT_EQ(write(back, 10'000), back.size());
    rig.machine.advance(ms(2));
    EXPECT_EQ(rig.host.take(), back);
  }

  UsbRig rig{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Chips, UsbPort, kFamilies, name_of);

TEST_P(UsbPort, IsFoundAndOpenedByAHost) {
  ASSERT_TRUE(rig.open());
  EXPECT_FALSE(rig.port.connected());
  ASSERT_TRUE(rig.host.plug());
  look();
  EXPECT_FALSE(rig.port.connected()) << "no program has it open";
  ASSERT_TRUE(rig.host.open());
  look();
  EXPECT_TRUE(rig.port.connected());
  EXPECT_EQ(rig.port.errors().losses, 0u);
  EXPECT_EQ(rig.port.stuck(), 0u);
}

// Any length, also whole packets.
TEST_P(UsbPort, TellsTheHostAllOfItsDescriptors) {
  ASSERT_TRUE(rig.open());
  ASSERT_TRUE(rig.host.plug());
  for (const std::uint16_t length :
       std::initializer_list<std::uint16_t>{8, 63, 64, 65, 67, 68, 255}) {
    const auto tree = rig.host.ask(0x80, 6, 0x0200, 0, length);
    ASSERT_TRUE(tree) << length;
    const Bytes whole(usb::kConfigurationDescriptor,
                      usb::kConfigurationDescriptor + usb::kConfigurationBytes);
    EXPECT_TRUE(std::equal(tree->begin(), tree->end(), whole.begin())) << length;
    EXPECT_EQ(tree->size(), std::min<std::size_t>(length, whole.size()));
  }
  const auto serial = rig.host.ask(0x80, 6, 0x0303, 0x0409, 255);
  ASSERT_TRUE(serial);
  EXPECT_EQ(serial->size(), usb::kStringBytes);
}

TEST_P(UsbPort, TakesLineCodingAndHandsItBack) {
  meet();
  const Bytes coding = {0x00, 0xC2, 0x01, 0x00, 0, 2, 7};  // 115200 7E1
  EXPECT_TRUE(rig.host.tell(0x21, 0x20, 0, 0, coding));
  EXPECT_EQ(rig.host.ask(0xA1, 0x21, 0, 0, 7), coding);
  const Bytes nonsense = {0, 0, 0, 0, 9, 9, 9};
  EXPECT_FALSE(rig.host.tell(0x21, 0x20, 0, 0, nonsense));
  EXPECT_EQ(rig.host.ask(0xA1, 0x21, 0, 0, 7), coding);
  EXPECT_TRUE(rig.host.tell(0x21, 0x23, 0xFFFF, 0));
  EXPECT_EQ(rig.port.errors().framing, 1u) << "a break is what no byte is";
  expect_alive();
}

TEST_P(UsbPort, RefusesWhatItDoesNotKnowAndGoesOn) {
  meet();
  EXPECT_FALSE(rig.host.ask(0x80, 6, 0x0600, 0, 10)) << "no high speed: no qualifier";
  EXPECT_FALSE(rig.host.ask(0xC0, 0x42, 0, 0, 16)) << "a vendor's";
  EXPECT_FALSE(rig.host.tell(0x40, 0x42, 0, 0));
  EXPECT_FALSE(rig.host.tell(0x40, 0x42, 0, 0, Bytes(20)));
  expect_alive();
}

TEST_P(UsbPort, OutlivesRequestsThatAreGivenUp) {
  meet();
  auto& wire = rig.machine.otg_fs();
  const std::uint8_t address = rig.host.bus().address();
  const std::uint8_t tell_all[8] = {0x80, 6, 0, 2, 0, 0, 255, 0};
  const std::uint8_t set_coding[8] = {0x21, 0x20, 0, 0, 0, 0, 7, 0};
  const auto give_up = [&](const std::uint8_t(&request)[8], int tokens) {
    ASSERT_EQ(wire.setup(address, request), model::UsbAnswer::kAck);
    for (; tokens > 0; --tokens) {
      wire.in(address, 0, true);
      rig.machine.advance(us(50));
    }
    ASSERT_TRUE(rig.host.ask(0x80, 6, 0x0100, 0, 18));
  };
  for (int tokens = 0; tokens < 5; ++tokens) {
    SCOPED_TRACE(tokens);
    give_up(tell_all, tokens);
    give_up(set_coding, tokens);
  }
  expect_alive();
}

// Both ways at once, with lost ACKs and slow programs.
TEST_P(UsbPort, CarriesAnyBytesInOrderBothWays) {
  meet();
  rig.host.deaf_every = 5;
  rig.host.twice_every = 7;
  const Bytes there = noise(6000, 3);
  const Bytes back = noise(6000, 4);
  Bytes got;
  std::size_t handed = 0;
  std::size_t written = 0;
  std::mt19937 random(5);
  for (unsigned turn = 0; turn < 4000 && (got.size() < there.size() || written < back.size());
       ++turn) {
    const std::size_t part = std::min<std::size_t>(random() % 150, there.size() - handed);
    if (rig.host.unsent() < 1000) {
      rig.host.send(Bytes(there.begin() + static_cast<std::ptrdiff_t>(handed),
                          there.begin() + static_cast<std::ptrdiff_t>(handed + part)));
      handed += part;
    }
    rig.host.reading = random() % 4 != 0;
    if (random() % 3 == 0) {
      const Bytes piece = read(1 + random() % 200, 100);
      got.insert(got.end(), piece.begin(), piece.end());
    }
    const std::size_t size = std::min<std::size_t>(random() % 200, back.size() - written);
    written += rig.port.write(back.data() + written, size, turn % 100);
  }
  rig.host.reading = true;
  rig.machine.advance(ms(5));
  EXPECT_TRUE(got == there);
  EXPECT_TRUE(rig.host.take() == back);
  EXPECT_GT(rig.host.out_naks(), 0u) << "the ring was never full: nothing was shown";
  EXPECT_EQ(rig.port.errors().overruns, 0u);
  EXPECT_EQ(rig.port.stuck(), 0u);
}

TEST_P(UsbPort, HoldsTheHostBackWhileTheRingIsFull) {
  meet();
  const Bytes much = noise(3 * UsbRig::kRing, 6);
  rig.host.send(much);
  rig.machine.advance(ms(20));
  EXPECT_GE(rig.host.unsent(), much.size() - UsbRig::kRing);
  EXPECT_GT(rig.host.out_naks(), 0u);
  EXPECT_EQ(read_all(), much);
}

// The host's driver passes data on at a packet that is not full.
TEST_P(UsbPort, EndsAFullPacketWithAnEmptyOne) {
  meet();
  for (const std::size_t size : {1u, 63u, 64u, 65u, 128u, 130u}) {
    const unsigned before = rig.host.ends();
    EXPECT_EQ(write(noise(size, 7), 1000), size);
    rig.machine.advance(ms(1));
    EXPECT_EQ(rig.host.take(), noise(size, 7));
    EXPECT_GE(rig.host.ends(), before + 1) << size;
  }
}

TEST_P(UsbPort, AProgramThatDoesNotReadCostsAWriteItsTimeout) {
  meet();
  rig.host.reading = false;
  const Bytes much = noise(2000, 8);
  const std::uint64_t before_us = rig.timer.now_us();
  const std::size_t taken = write(much, 3000);
  EXPECT_LT(taken, much.size());
  EXPECT_GE(rig.timer.now_us() - before_us, 3000u);
  EXPECT_LE(rig.timer.now_us() - before_us, 3100u);
  rig.host.reading = true;
  EXPECT_EQ(rig.port.write(much.data() + taken, much.size() - taken, 50'000), much.size() - taken);
  rig.machine.advance(ms(2));
  EXPECT_EQ(rig.host.take(), much);
}

struct Ending {
  const char* name;
  void (*end)(UsbRig&);
  bool (*come_back)(UsbRig&);
};
const Ending kEndings[] = {
    {"the program closes the port", [](UsbRig& rig) { rig.host.close(); },
     [](UsbRig& rig) { return rig.host.open(); }},
    {"the cable is pulled",
     [](UsbRig& rig) {
       rig.host.unplug();
       rig.machine.advance(ms(10));
     },
     [](UsbRig& rig) { return rig.host.plug() && rig.host.open(); }},
    {"the bus is reset", [](UsbRig& rig) { rig.host.reset_bus(); },
     [](UsbRig& rig) { return rig.host.reset_bus() && rig.host.meet() && rig.host.open(); }},
    {"another configuration is set", [](UsbRig& rig) { rig.host.configure(0); },
     [](UsbRig& rig) { return rig.host.reset_bus() && rig.host.meet() && rig.host.open(); }},
    {"the PC sleeps",
     [](UsbRig& rig) {
       rig.machine.otg_fs().idle();
       rig.machine.advance(ms(10));
     },
     [](UsbRig& rig) {
       rig.machine.otg_fs().resume();
       rig.machine.advance(ms(20));
       return true;
     }},
};

TEST_P(UsbPort, OutlivesTheEndOfAConnectionAtAnyMoment) {
  meet();
  std::uint32_t losses = 0;
  for (int round = 0; round < 5; ++round) {
    for (const Ending& each : kEndings) {
      SCOPED_TRACE(std::string(each.name) + ", round " + std::to_string(round));
      const Bytes sent = noise(400, 9);
      rig.host.send(sent);
      write(noise(900, 10), 0);
      rig.machine.advance(us(static_cast<std::uint64_t>(93 * round)));
      each.end(rig);
      const Bytes got = read_all();
      EXPECT_LE(got.size(), sent.size());
      EXPECT_TRUE(std::equal(got.begin(), got.end(), sent.begin()));
      look();
      EXPECT_FALSE(rig.port.connected());
      EXPECT_EQ(rig.port.errors().losses, ++losses);
      EXPECT_EQ(write(sent, 500), 0u) << "nobody is there";
      rig.host.take();
      ASSERT_TRUE(each.come_back(rig));
      rig.machine.advance(ms(50));
      EXPECT_TRUE(rig.host.take().empty()) << "it was for the program before";
      while (!read_all().empty()) {
      }
      expect_alive();
    }
  }
  EXPECT_EQ(rig.port.errors().losses, losses);
  EXPECT_EQ(rig.port.stuck(), 0u);
}

// The port was closed and opened between two calls.
TEST_P(UsbPort, TellsALossThatIsOverBeforeAnybodyLooked) {
  meet();
  const Bytes sent = noise(30, 11);
  rig.host.send(sent);
  rig.machine.advance(ms(1));
  ASSERT_TRUE(rig.host.close());
  ASSERT_TRUE(rig.host.open());
  const Bytes next = noise(20, 16);
  rig.host.send(next);
  rig.machine.advance(ms(1));
  EXPECT_EQ(read(100, 1000), sent) << "and nothing of the next program's";
  const std::uint64_t before_us = rig.timer.now_us();
  EXPECT_TRUE(read(100, 50'000).empty());
  EXPECT_LE(rig.timer.now_us() - before_us, 100u) << "the read that sees it returns at once";
  EXPECT_FALSE(rig.port.connected());
  EXPECT_EQ(rig.port.errors().losses, 1u);
  EXPECT_EQ(read(100, 1000), next);
  expect_alive();
  EXPECT_EQ(rig.port.errors().losses, 1u);
}

TEST_P(UsbPort, WithVbusSensedAPulledCableIsSeenAtOnce) {
  Gpio<Io>(rig.machine.io()).input({'A', 9}, gpio::kPullNone);
  ASSERT_TRUE(rig.open(true));
  rig.machine.advance(ms(10));
  EXPECT_FALSE(rig.machine.otg_fs().pulled_up()) << "no host: no pull-up";
  ASSERT_TRUE(rig.host.plug() && rig.host.open());
  look();
  ASSERT_TRUE(rig.port.connected());
  rig.host.unplug();
  rig.machine.advance(us(100));
  look();
  EXPECT_FALSE(rig.port.connected());
}

TEST_P(UsbPort, HaltsAndReleasesEndpoints) {
  meet();
  const Bytes bytes = noise(200, 12);
  ASSERT_TRUE(rig.host.tell(0x02, 3, 0, usb::kDataIn));
  ASSERT_TRUE(rig.host.tell(0x02, 3, 0, usb::kDataOut));
  rig.host.send(bytes);
  EXPECT_EQ(write(bytes, 0), bytes.size());
  rig.machine.advance(ms(3));
  EXPECT_TRUE(rig.host.take().empty());
  EXPECT_TRUE(read(300, 0).empty());
  EXPECT_GT(rig.host.stalls(), 2u);
  ASSERT_TRUE(rig.host.clear_halt(usb::kDataIn));
  ASSERT_TRUE(rig.host.clear_halt(usb::kDataOut));
  EXPECT_EQ(read_all(), bytes);
  rig.machine.advance(ms(3));
  EXPECT_EQ(rig.host.take(), bytes);
}

TEST_P(UsbPort, ACoreThatDoesNotComeOutOfResetIsRefused) {
  const std::uint64_t before_us = rig.timer.now_us();
  rig.machine.otg_fs().core_reset_stuck = true;
  EXPECT_FALSE(rig.open());
  EXPECT_EQ(rig.port.stuck(), 1u);
  EXPECT_LE(rig.timer.now_us() - before_us, 1000u);
}

TEST_P(UsbPort, ABusThatIsNeverIdleIsRefused) {
  rig.machine.otg_fs().ahb_busy = true;
  EXPECT_FALSE(rig.open());
  EXPECT_EQ(rig.port.stuck(), 1u);
}

TEST_P(UsbPort, TooSlowAClockIsRefused) {
  EXPECT_FALSE(rig.port.open(14'000'000, false));
}

// It blocks the way to the host, also after a bus reset, but costs only a few polls. The host's
// bytes still arrive.
TEST_P(UsbPort, OutlivesAPacketThatIsStuck) {
  meet();
  rig.host.reading = false;
  write(noise(500, 13), 0);
  rig.machine.advance(ms(1));
  rig.machine.otg_fs().disable_stuck = true;
  const std::uint64_t before_us = rig.timer.now_us();
  rig.host.close();
  EXPECT_LE(rig.timer.now_us() - before_us, 3000u);
  EXPECT_GE(rig.port.stuck(), 1u);
  rig.host.reading = true;
  for (int round = 0; round < 3; ++round) {
    look();
    EXPECT_FALSE(rig.port.connected());
    ASSERT_TRUE(rig.host.open());
    const Bytes there = noise(150, 14);
    rig.host.send(there);
    EXPECT_EQ(read_all(), there);
    const std::uint32_t stuck = rig.port.stuck();
    const std::uint64_t now_us = rig.timer.now_us();
    EXPECT_LE(write(noise(800, 15), 0), UsbRig::kRing);
    EXPECT_LE(rig.timer.now_us() - now_us, 100u);
    EXPECT_EQ(rig.port.stuck(), stuck) << "it is not tried again and again";
    rig.host.close();
  }
}

// The driver counts it and uses the FIFO anyway.
TEST_P(UsbPort, OutlivesAFlushThatDoesNotEnd) {
  meet();
  rig.machine.otg_fs().flush_stuck = true;
  rig.host.close();
  look();
  EXPECT_GE(rig.port.stuck(), 1u);
  rig.machine.otg_fs().flush_stuck = false;
  rig.machine.forget_violations();  // a second flush during the first
}

}  // namespace
}  // namespace verp::hal::stm32::test
