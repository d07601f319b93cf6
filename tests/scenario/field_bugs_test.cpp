#include "host/run/scenario/field_bugs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"

namespace verp::scenario {
namespace {

const model::Entity& generic21() {
  static const model::Entity entity = model::load_robot(model::find_model("generic21"));
  return entity;
}

std::string manual() {
  std::ifstream page(VERP_SOURCE_DIR "/host/guide/field-bugs.md");
  return {std::istreambuf_iterator<char>(page), {}};
}

class FieldBugs : public testing::TestWithParam<std::size_t> {};

TEST_P(FieldBugs, IsCaughtByWhomTheTableSaysInWordsThatNameIt) {
  const FieldBug& bug = field_bugs()[GetParam()];
  const Trial trial = try_bug(bug, generic21());
  EXPECT_STREQ(in_words(trial.catcher), in_words(bug.catcher)) << trial.line;
  if (bug.catcher != Catcher::kNobody) {
    EXPECT_NE(trial.line.find(bug.word), std::string::npos) << trial.line;
  }
  const std::string cell = std::string("| ") + in_words(bug.catcher) + " |";
  const std::string page = manual();
  const std::size_t begin = page.find(std::string("\n| ") + bug.name + " |");
  ASSERT_NE(begin, std::string::npos) << "./verp faults --run makes the manual's page";
  EXPECT_NE(page.substr(begin, page.find('\n', begin + 1) - begin).find(cell), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Table, FieldBugs, testing::Range<std::size_t>(0, field_bugs().size()),
                         [](const auto& bug) { return std::string(field_bugs()[bug.param].name); });

TEST(FieldBugTable, HasFiftyOfFiveFamiliesAndFortyFiveAreCaught) {
  std::set<std::string> names;
  std::array<int, 5> families{};
  int caught = 0;
  for (const FieldBug& bug : field_bugs()) {
    names.insert(bug.name);
    ++families[static_cast<std::size_t>(bug.family)];
    caught += bug.catcher != Catcher::kNobody ? 1 : 0;
  }
  EXPECT_EQ(names.size(), 50U);
  EXPECT_GE(*std::min_element(families.begin(), families.end()), 8);
  EXPECT_GE(caught, 45);
}

/// Else every walk would be caught.
TEST(FieldBugTable, CatchesNothingInARobotWithoutOne) {
  const FieldBug none{"",
                      BugFamily::kBus,
                      "",
                      "",
                      Catcher::kNobody,
                      "",
                      {.text = "", .change = [](session::WalkPlan&) {}}};
  EXPECT_EQ(try_bug(none, generic21()).line, "none: the walk looks healthy");
}

}  // namespace
}  // namespace verp::scenario
