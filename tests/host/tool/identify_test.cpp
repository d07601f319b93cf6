#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using IdentifyCommand = Program;

TEST_F(IdentifyCommand, RefusesATraceFromWhichNothingCanBeToldAndMakesOneThatTells) {
  expect_refused("identify", "no trace");
  expect_refused("identify none.mcap", "none.mcap");
  ASSERT_EQ(verp("walk --for 6 --record floor.mcap").status, 0);
  expect_refused("identify floor.mcap", "no robot in a stand");
  expect_refused("identify floor.mcap --robot op3", "of another robot");
  expect_refused("identify floor.mcap --type mx28", "no servo of type 'mx28'");
  expect_refused("identify floor.mcap --write floor.mcap", "is there already");
  expect_refused("identify floor.mcap --write none/new.sdf", "there is no folder");
  expect_refused("identify floor.mcap --motion a.action", "excludes");
  expect_refused("identify --motion a.txt", "end in .action");
  ASSERT_EQ(verp("identify --motion still.action --for 5").status, 0);
  EXPECT_EQ(verp("action check still.action").status, 0);
  ASSERT_EQ(verp("action play stand --held --record still.mcap").status, 0);
  expect_refused("identify --motion still.action", "is there already");
  expect_refused("identify still.mcap", "record the motion that");
}

}  // namespace
}  // namespace verp::tool::test
