#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

class ActionCommand : public Program {
 protected:
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  void write_two() const {
    write("mine/a.action", "action a\nframe 1\n head_yaw 20\nlink b\n");
    write("mine/b.action", "action b\nframe 1 hold 0.25\n head_yaw -20\n");
  }
};

TEST_F(ActionCommand, RefusesWhatIsNoActionAndNoMotionByItsName) {
  write("rub.bin", "rubbish");
  write("a.action", "action a\nframe 1 hold\n");
  write("full/a.action", "action a\nframe 1\n head_yaw 20\n");
  expect_refused("action show .", "is a folder");
  expect_refused("action show rub.bin", "is no action file");
  expect_refused("action show a.action", "a.action:2: something is missing");
  expect_refused("action convert none.bin new", "none.bin: cannot be read");
  expect_refused("action convert rub.bin new", "131072 bytes");
  expect_refused("action convert new m.bin", "nothing makes m.bin");
  ASSERT_EQ(verp("action convert full m.bin").status, 0);
  expect_refused("action convert m.bin full", "full is there already");
  EXPECT_EQ(slurp(folder_ / "full/a.action"), "action a\nframe 1\n head_yaw 20\n");
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

TEST_F(ActionCommand, FindsTheActionsBesideTheOneThatLeadsToThem) {
  write_two();
  EXPECT_EQ(verp("action check mine/a.action").status, 0);
  fs::remove(folder_ / "mine/b.action");
  expect_refused("action check mine/a.action", "a.action:4: there is no action 'b'");
}

TEST_F(ActionCommand, MakesAMotionOfAFolderAndTheSameOfWhatComesBack) {
  write_two();
  ASSERT_EQ(verp("action convert mine one.bin").status, 0);
  ASSERT_EQ(verp("action convert one.bin back").status, 0);
  ASSERT_EQ(verp("action convert back two.bin").status, 0);
  EXPECT_EQ(slurp(folder_ / "one.bin"), slurp(folder_ / "two.bin"));
  EXPECT_NE(slurp(folder_ / "back/a.action").find("link b"), std::string::npos);
}

TEST_F(ActionCommand, MakesNothingThatIsThereAndNothingButLieDown) {
  expect_refused("action make lie_down generic21", "lie_down.action is there already");
  expect_refused("action make wave generic21", "wave not in {lie_down}");
  expect_refused("action make lie_down generic21 -o /nowhere/a.action", "no such folder");
}

TEST_F(ActionCommand, SaysWhatOfAnActionNoTableAndNoPageHolds) {
  write("a.action", "action a\nframe go 1\n head_yaw 20\n stance none\n repeat 2 from go\n");
  const Outcome outcome = verp("action convert a.action a.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "a.csv: without its labels, stance, repeats\n");
  write("mine/a.action", slurp(folder_ / "a.action"));
  const Outcome paged = verp("action convert mine m.bin");
  ASSERT_EQ(paged.status, 0) << paged.err;
  EXPECT_EQ(paged.out, "m.bin: 1 actions on 256 pages\n  a without its stance\n");
}

}  // namespace
}  // namespace verp::tool::test
