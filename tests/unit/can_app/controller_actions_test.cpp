#include <gtest/gtest.h>

#include "tests/unit/can_app/objects_node.hpp"
#include "tests/unit/images/actions_board.hpp"

namespace verp::app::test {
namespace {

using canopen::Abort;
using canopen::SdoClient;

constexpr canopen::Address kActions{kImageIndex + static_cast<int>(ImageKind::kActions), 0};

struct Sender {
  Sender() : node(board.images) {
    fresh.shelf.goal(0, 1, 0.25F);
    fresh.mark = action::make_mark(fresh.shelf.header, kRobot);
    node.arm(false);
  }
  Abort send(std::uint32_t size = sizeof(SentActions)) {
    return node.write(kActions, &fresh, size, mode);
  }
  bool took_them() const { return board.images.accepted_actions() > 0; }

  FakeBoard board;
  SentActions fresh{kRobot};
  Node node;
  SdoClient::Mode mode = SdoClient::Mode::kBlock;
};

template <class Test>
void in_each_mode(Test test) {
  for (const auto mode : {SdoClient::Mode::kPlain, SdoClient::Mode::kBlock}) {
    Sender& sender = renewed<Sender>();
    sender.mode = mode;
    test(sender);
  }
}

TEST(ControllerActions, TakesWholeActionsAndReadsThoseInForce) {
  in_each_mode([](Sender& sender) {
    EXPECT_TRUE(sender.send() == Abort::kNone);
    EXPECT_EQ(sender.board.images.accepted_actions(), sizeof(SentActions));
    EXPECT_EQ(__builtin_memcmp(sender.board.place.byte, sender.fresh.bytes(), sizeof(SentActions)),
              0);
    static std::uint8_t got[sizeof(SentActions)];
    ASSERT_TRUE(sender.node.read(kActions, got, sizeof got, sender.mode) == Abort::kNone);
    EXPECT_EQ(__builtin_memcmp(got, sender.board.there.bytes(), sizeof got), 0);
  });
}

TEST(ControllerActions, SaysWhyItTakesNone) {
  in_each_mode([](Sender& sender) {
    EXPECT_TRUE(sender.send(sizeof(SentActions) - 1) == Abort::kIncompatibleParameter);
    sender.node.arm(true);
    EXPECT_TRUE(sender.send() == Abort::kDeviceState);
    sender.node.arm(false);
    sender.board.place.busy = true;
    EXPECT_TRUE(sender.send() == Abort::kDeviceState) << "a little later";
    sender.board.place.busy = false;
    sender.board.place.blocks_taken = 5;
    EXPECT_TRUE(sender.send() == Abort::kHardware);
    sender.board.place.blocks_taken = 1000;
    sender.fresh.mark.robot ^= 1;
    EXPECT_TRUE(sender.send() == Abort::kIncompatibleParameter);
    sender.fresh.mark = action::make_mark(sender.fresh.shelf.header, kRobot);
    static std::uint8_t much[FakePlace::kBytes + 1];
    EXPECT_TRUE(sender.node.write(kActions, much, sizeof much, sender.mode) == Abort::kTooLong);
    EXPECT_FALSE(sender.took_them());
    EXPECT_TRUE(sender.send() == Abort::kNone) << "and all that was no harm";
  });
}

TEST(ControllerActions, ATransferThatWasCutComesToNothingAndTheNextOneIsWhole) {
  in_each_mode([](Sender& sender) {
    for (int frames = 1; frames < 200; frames += 17) {
      sender.node.client.download(kActions, sender.fresh.bytes(), sizeof(SentActions), sender.mode,
                                  0);
      canopen::Frame frame;
      for (int sent = 0; sent < frames; ++sent) {
        if (sender.node.client.next(frame, 0)) sender.node.device.receive(frame, 0);
        while (sender.node.device.next(frame, 0)) sender.node.client.receive(frame, 0);
        if (sender.node.client.state() != SdoClient::State::kBusy) return;
      }
      EXPECT_FALSE(sender.took_them()) << frames;
      EXPECT_TRUE(sender.send() == Abort::kNone) << frames;
      sender.board.images.begin(ImageKind::kActions);
    }
  });
}

}  // namespace
}  // namespace verp::app::test
