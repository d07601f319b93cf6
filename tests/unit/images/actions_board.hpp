#pragma once
#include <cstddef>
#include <cstdint>

#include "firmware/app/robot_images.hpp"
#include "tests/unit/action/shelf.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::app::test {

struct SentActions {
  explicit SentActions(const Params& robot) : mark(action::make_mark(shelf.header, robot)) {}
  const std::uint8_t* bytes() const { return reinterpret_cast<const std::uint8_t*>(this); }
  std::uint32_t crc() const { return crc32(this, sizeof *this); }

  action::test::Shelf shelf;
  action::KeptMark mark;
};
static_assert(sizeof(SentActions) == sizeof(action::test::Shelf) + sizeof(action::KeptMark));

struct FakePlace {
  static constexpr std::size_t kBytes = sizeof(SentActions) + 100;
  std::size_t room() const { return kBytes; }
  const std::uint8_t* bytes() const { return byte; }
  void begin() {
    ++begun;
    __builtin_memset(byte, 0xFF, kBytes);
  }
  bool ready() const { return !busy; }
  bool write(std::size_t offset, const std::uint8_t* from, std::size_t count) {
    if (blocks_taken == 0) return false;
    --blocks_taken;
    for (std::size_t i = 0; i < count; ++i) byte[offset + i] &= from[i];
    return true;
  }

  alignas(4) std::uint8_t byte[kBytes] = {};
  int begun = 0;
  bool busy = false;
  int blocks_taken = 1000;
};
static_assert(ActionPlace<FakePlace>);
using FakeImages = RobotImages<FakePlace>;

struct FakeBoard {
  FakeBoard() {
    robot.params = verp::test::kRobot;
    seal_image(robot);
  }
  ParamsImage robot;
  FakePlace place;
  alignas(4) const SentActions there{verp::test::kRobot};
  FakeImages images{robot, there.bytes(), sizeof there, place};
};

}  // namespace verp::app::test
