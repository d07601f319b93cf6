#include <gtest/gtest.h>

#include <memory>

#include "common/protocol/canopen/device.hpp"
#include "firmware/app/controller_objects.hpp"
#include "host/author/action/send.hpp"
#include "host/twin/can/client.hpp"
#include "tests/unit/images/actions_board.hpp"

// Actions go to object 5002h.

namespace verp::action {
namespace {

using app::test::FakeBoard;
using app::test::SentActions;
using verp::test::kRobot;

class NodeBus : public can::ClientBus {
 public:
  explicit NodeBus(app::Images& images)
      : registers(kRobot, app::OperatorSetup{}, images), objects_(registers, images) {
    device_.start();
    device_.receive(canopen::nmt_frame(canopen::NmtCommand::kStart, kNode), 0);
  }
  bool send(const CanFrame& frame) override { return device_.receive(frame, now_us_), true; }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    if (polled) polled();
    if (device_.next(frame, now_us_)) return true;
    now_us_ += timeout_us;
    return false;
  }
  std::uint64_t now_us() override { return now_us_; }
  hal::CanErrors errors() const override { return {}; }
  bool connected() const override { return true; }

  static constexpr std::uint8_t kNode = canopen::plan::kControllerNode;
  app::OperatorRegisters registers;
  std::function<void()> polled;

 private:
  using Objects = app::ControllerObjects;
  Objects objects_;
  canopen::Device<Objects, app::kControllerSize> device_{objects_, app::controller_identity(),
                                                         kNode};
  std::uint64_t now_us_ = 0;
};

/// The error, or "".
template <class Bus>
std::string sent(Bus& bus, const std::vector<std::uint8_t>& image) {
  can::Client client(bus, "can:test", 100'000);
  try {
    const auto port = can_action_port(client, Bus::kNode);
    SendOptions options;
    options.robot = kRobot.name;
    options.actions = 2;
    return send_actions(*port, image, options) ? "" : "stopped";
  } catch (const bus::DeviceError& error) {
    return error.what();
  }
}

struct BoardOnCan {
  BoardOnCan() {
    fresh.shelf.goal(0, 1, 0.25F);
    fresh.mark = make_mark(fresh.shelf.header, kRobot);
    bus.polled = [this] { live(); };
  }
  std::vector<std::uint8_t> image() const { return {fresh.bytes(), fresh.bytes() + sizeof fresh}; }
  /// Frees a place in flash and restarts with the received actions.
  void live() {
    if (place_is_made_after > 0 && board.place.begun > 0 && --place_is_made_after == 0) {
      board.place.busy = false;
    }
    if (board.images.accepted_actions() == 0 || ++last_words < 10) return;
    board.images.begin(app::ImageKind::kActions);
    bus.registers.show_window(app::table::WindowState::kIdle);
    bus.registers.offer_actions(2);
    ++starts;
  }

  FakeBoard board;
  SentActions fresh{kRobot};
  NodeBus bus{board.images};
  int place_is_made_after = 0;
  int last_words = 0, starts = 0;
};

TEST(SendActionsOnCan, TheBoardStartsAnewWithThem) {
  const auto on_can = std::make_unique<BoardOnCan>();
  EXPECT_EQ(sent(on_can->bus, on_can->image()), "");
  EXPECT_EQ(on_can->starts, 1);
  const std::vector<std::uint8_t> image = on_can->image();
  EXPECT_TRUE(std::equal(image.begin(), image.end(), on_can->board.place.byte));
}

TEST(SendActionsOnCan, WaitsUntilThereIsAPlace) {
  const auto on_can = std::make_unique<BoardOnCan>();
  on_can->board.place.busy = true;
  on_can->place_is_made_after = 30;
  EXPECT_EQ(sent(on_can->bus, on_can->image()), "");
  EXPECT_EQ(on_can->starts, 1);
}

TEST(SendActionsOnCan, SaysWhyItTookNone) {
  const auto on_can = std::make_unique<BoardOnCan>();
  const auto expect_refused = [&](const std::vector<std::uint8_t>& image, const char* why) {
    const std::string told = sent(on_can->bus, image);
    EXPECT_NE(told.find(why), std::string::npos) << told;
    EXPECT_NE(told.find("it keeps those that it has"), std::string::npos) << told;
  };
  expect_refused(std::vector<std::uint8_t>(2000), "no room for 2000 bytes");
  on_can->fresh.mark.robot ^= 1;
  on_can->fresh.mark.crc32 = 0;
  expect_refused(on_can->image(), "damaged");
  Params other = kRobot;
  other.joint[0].upper_rad += 0.5F;
  on_can->fresh.mark = make_mark(on_can->fresh.shelf.header, other);
  expect_refused(on_can->image(), "for another robot");
  on_can->board.place.blocks_taken = 7;
  expect_refused(on_can->image(), "its flash did not keep a block");
  EXPECT_EQ(on_can->starts, 0);
}

TEST(SendActionsOnCan, ToAControllerThatKeepsNoneIsRefused) {
  const auto bus = std::make_unique<NodeBus>(app::no_images);
  const SentActions actions(kRobot);
  const std::string told = sent(*bus, {actions.bytes(), actions.bytes() + sizeof actions});
  EXPECT_NE(told.find("takes no actions while it runs"), std::string::npos) << told;
}

}  // namespace
}  // namespace verp::action
