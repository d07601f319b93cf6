#include "firmware/app/controller_objects.hpp"

#include <gtest/gtest.h>

#include "tests/unit/can_app/objects_node.hpp"

namespace verp::app::test {
namespace {

using canopen::Abort;
using canopen::Address;
using canopen::Entry;
using canopen::Frame;
using canopen::SdoClient;
using table::Register;

static_assert(canopen::Application<ControllerObjects>);
static_assert(canopen::StreamingDictionary<ControllerObjects>);

TEST(ControllerObjects, EveryRegisterIsTheObjectThatTheTableNames) {
  auto& node = renewed<Node>(no_images);
  node.arm(false);
  Entry entry;
  for (const Register& each : table::row::kTable) {
    const std::uint16_t index = each.object_index();
    const std::uint8_t* bytes = node.registers.read(each.address, each.bytes());
    std::uint8_t got[64] = {};
    if (each.count == 1 || each.type == table::Type::kText) {
      ASSERT_TRUE(node.read({index, 0}, got, sizeof got) == Abort::kNone) << each.name;
      ASSERT_EQ(node.client.size(), each.bytes()) << each.name;
      for (unsigned i = 0; i < each.bytes(); ++i) EXPECT_EQ(got[i], bytes[i]) << each.name;
      EXPECT_TRUE(node.objects.find({index, 1}, entry) == Abort::kNoSubindex) << each.name;
      continue;
    }
    ASSERT_TRUE(node.read({index, 0}, got, sizeof got) == Abort::kNone) << each.name;
    EXPECT_EQ(got[0], each.count) << each.name;
    const unsigned size = table::type_bytes(each.type);
    for (unsigned i = 0; i < each.count; ++i) {
      const auto subindex = static_cast<std::uint8_t>(i + 1);
      ASSERT_TRUE(node.read({index, subindex}, got, sizeof got) == Abort::kNone) << each.name;
      ASSERT_EQ(node.client.size(), size) << each.name;
      for (unsigned b = 0; b < size; ++b) EXPECT_EQ(got[b], bytes[i * size + b]) << each.name;
    }
    EXPECT_TRUE(node.objects.find({index, static_cast<std::uint8_t>(each.count + 1)}, entry) ==
                Abort::kNoSubindex);
  }
}

TEST(ControllerObjects, WhatIsNoRegisterIsNoObject) {
  auto& node = renewed<Node>(no_images);
  Entry entry;
  unsigned found = 0;
  for (unsigned index = 0x2000; index <= 0xFFFF; ++index) {
    const Abort abort = node.objects.find({static_cast<std::uint16_t>(index), 0}, entry);
    const bool image = index > kImageIndex && index <= kImageIndex + 4u;
    const bool none = abort == (image ? Abort::kNoData : Abort::kNoObject);
    EXPECT_TRUE(abort == Abort::kNone || none) << index;
    if (abort == Abort::kNone) ++found;
  }
  EXPECT_EQ(found, table::kRegisters) << "there are no images here";
}

TEST(ControllerObjects, WriteDoesWhatItDoesToTheRegister) {
  auto& node = renewed<Node>(no_images);
  alignas(OperatorRegisters) static unsigned char place[sizeof(OperatorRegisters)];
  auto& other =
      *new (static_cast<void*>(place)) OperatorRegisters(kRobot, OperatorSetup{}, no_images);
  for (const bool armed : {false, true}) {
    node.arm(armed);
    other.record({node.state.digest, node.inputs}, node.state, node.outputs);
    for (const Register& each : table::row::kTable) {
      if (each.type == table::Type::kText) continue;
      const std::uint8_t subindex = each.count == 1 ? 0 : 1;
      const std::uint32_t size = table::type_bytes(each.type);
      for (const std::uint64_t value : {0ull, 1ull, 2ull, 100ull, 255ull, ~0ull}) {
        std::uint8_t bytes[8];
        canopen::put_le(bytes, value, 8);
        const Abort abort = node.write({each.object_index(), subindex}, bytes, size);
        const dxl::Error error = other.write(each.address, bytes, size);
        EXPECT_EQ(abort == Abort::kNone, error == dxl::Error::kNone) << each.name << " " << value;
        const std::uint8_t* mine = node.registers.read(each.address, size);
        const std::uint8_t* theirs = other.read(each.address, size);
        for (unsigned i = 0; i < size; ++i) EXPECT_EQ(mine[i], theirs[i]) << each.name;
      }
    }
    node.registers.order();
    other.order();
  }
}

TEST(ControllerObjects, RefusalsSayWhy) {
  auto& node = renewed<Node>(no_images);
  node.arm(true);
  const std::uint8_t one = 1, four = 4;
  const auto index = [](const char* name) { return table::find(name)->object_index(); };
  EXPECT_TRUE(node.write({index("tick"), 0}, &one, 1) != Abort::kNone);
  EXPECT_TRUE(node.write({index("mode"), 0}, &one, 1) == Abort::kReadOnly);
  EXPECT_TRUE(node.write({index("request"), 0}, &four, 1) == Abort::kValueRange);
  EXPECT_TRUE(node.write({index("request"), 0}, &one, 1) == Abort::kDeviceState) << "0 comes first";
  EXPECT_TRUE(node.write({index("id"), 0}, &one, 1) == Abort::kDeviceState) << "armed";
}

TEST(ControllerObjects, CommandCanStandInARpdo) {
  auto& node = renewed<Node>(no_images);
  constexpr std::uint16_t kVx = table::find("walk_vx")->object_index();
  constexpr std::uint16_t kGyro = table::find("gyro")->object_index();
  EXPECT_TRUE(node.objects.mappable({kVx, 0}, 16, true) == Abort::kNone);
  EXPECT_TRUE(node.objects.mappable({kVx, 0}, 8, true) == Abort::kNotMappable);
  EXPECT_TRUE(node.objects.mappable({kGyro, 1}, 16, false) == Abort::kNone);
  EXPECT_TRUE(node.objects.mappable({kGyro, 1}, 16, true) == Abort::kNotMappable);
  EXPECT_TRUE(node.objects.mappable({kGyro, 0}, 8, false) == Abort::kNotMappable);
  canopen::PdoMapping<> mapping;
  mapping.add({{kVx, 0}, 16});
  node.device.objects().rpdos[0] = {canopen::Direction::kReceive, canopen::rpdo_id(1, kNode), 255,
                                    mapping};
  node.device.receive(canopen::nmt_frame(canopen::NmtCommand::kStart, 0), 0);
  Frame frame = canopen::classic_frame(canopen::rpdo_id(1, kNode), 2);
  canopen::put_le(frame.data, 450, 2);
  node.device.receive(frame, 0);
  const OperatorOrder order = node.registers.order();
  EXPECT_EQ(order.command.vx_tenth_mm_s, 450);
  EXPECT_TRUE((order.flags & kCommandFresh) != 0);
}

TEST(ControllerObjects, ALoopThatObeysSomebodyElseRefusesEveryOrder) {
  auto& node = renewed<Node>(no_images, OperatorSetup{.takes_orders = false});
  const std::uint8_t zeros[8] = {}, one = 1;
  for (const bool armed : {false, true}) {
    node.arm(armed);
    for (const Register& each : table::row::kTable) {
      if (!each.writable()) continue;
      const Address at{each.object_index(), static_cast<std::uint8_t>(each.count == 1 ? 0 : 1)};
      const bool shows = table::same_name(each.name, "parameter_id") ||
                         table::same_name(each.name, "window_kind") ||
                         table::same_name(each.name, "window_offset") ||
                         table::same_name(each.name, "tick_hold");
      const unsigned size = table::type_bytes(each.type);
      EXPECT_TRUE(node.write(at, zeros, size) == (shows ? Abort::kNone : Abort::kLocalControl))
          << each.name;
      const auto bits = static_cast<std::uint8_t>(8 * size);
      EXPECT_EQ(node.objects.mappable(at, bits, true) == Abort::kNone, shows)
          << each.name << ": a PDO has no answer that could refuse";
    }
    node.write({table::find("emergency_stop")->object_index(), 0}, &one, 1);
    EXPECT_EQ(node.registers.order().flags, 0);
  }
}

/// Too large for a microcontroller's stack.
struct Exchange {
  explicit Exchange(std::uint32_t new_period_us) {
    now.params = next.params = kRobot;
    next.params.period_us = new_period_us;
    seal_image(now);
    seal_image(next);
  }
  ParamsImage now;
  ParamsImage next;
  ParamsImages images{now};
  Node node{images};
  std::uint8_t got[sizeof(ParamsImage)];
};

TEST(ControllerObjects, ImageIsReadAndReplacedByBlockTransfer) {
  auto& [now, next, images, node, got] = renewed<Exchange>(8000u);
  constexpr Address kParams{kImageIndex + 1, 0};
  node.arm(false);
  for (const auto mode : {SdoClient::Mode::kPlain, SdoClient::Mode::kBlock}) {
    ASSERT_TRUE(node.read(kParams, got, sizeof got, mode) == Abort::kNone);
    EXPECT_EQ(node.client.size(), sizeof now);
    EXPECT_EQ(__builtin_memcmp(got, &now, sizeof now), 0);
    node.arm(true);
    EXPECT_TRUE(node.write(kParams, &next, sizeof next, mode) == Abort::kDeviceState);
    EXPECT_TRUE(images.accepted() == nullptr);
    node.arm(false);
    next.params.period_us ^= 1;
    EXPECT_TRUE(node.write(kParams, &next, sizeof next, mode) == Abort::kIncompatibleParameter);
    EXPECT_TRUE(images.accepted() == nullptr) << "its own CRC is wrong";
    next.params.period_us ^= 1;
    EXPECT_TRUE(node.write(kParams, &next, sizeof next - 1, mode) != Abort::kNone);
    ASSERT_TRUE(node.write(kParams, &next, sizeof next, mode) == Abort::kNone);
    ASSERT_TRUE(images.accepted() != nullptr);
    EXPECT_EQ(images.accepted()->params.period_us, 8000u);
    images.begin(ImageKind::kParams);
  }
  Entry entry;
  EXPECT_TRUE(node.objects.find({kImageIndex + 2, 0}, entry) == Abort::kNoData);
}

}  // namespace
}  // namespace verp::app::test
