#include "tests/host/tool/program.hpp"

// tests/dynamixel/foreign_client.py on `verp hil`'s pseudo-terminal.
namespace verp::tool::test {
namespace {

class ForeignClient : public Program {
 protected:
  void plays(const std::string& scene) const {
    const Outcome outcome =
        shell("timeout 100 python3 " VERP_FOREIGN_CLIENT " " VERP_PROGRAM " " + scene);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
};

TEST_F(ForeignClient, FindsAllServosWithTheFirstPingToATwinThatJustStarted) {
  plays("first_ping_to_all");
}
TEST_F(ForeignClient, AndAScanFindEachServoOnce) {
  plays("scan_at_once");
}
TEST_F(ForeignClient, IsAnsweredWhenARequestEndsLikeAHeaderBegins) {
  plays("last_byte_ff");
}
TEST_F(ForeignClient, LosesNoRequestToHalfAPacketBeforeIt) {
  plays("half_a_packet");
}
TEST_F(ForeignClient, GetsNoAnswerThatItsPredecessorLeftUnread) {
  plays("unread_answers");
}
TEST_F(ForeignClient, LosesWhatAWireWouldLoseAndIsAnsweredInTime) {
  plays("too_many_writes");
}
TEST_F(ForeignClient, HearsOnlyServosOfItsPortsRate) {
  plays("another_rate");
}
TEST_F(ForeignClient, IsRefusedWhatNoServosBufferHolds) {
  plays("long_packets");
}
TEST_F(ForeignClient, FollowsEveryKindOfProfile) {
  plays("profiles");
}
TEST_F(ForeignClient, DrivesAServoInEveryMode) {
  plays("modes");
}
TEST_F(ForeignClient, FindsAServoAsItWasToldToStart) {
  plays("startup");
}

}  // namespace
}  // namespace verp::tool::test
