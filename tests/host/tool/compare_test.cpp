#include <nlohmann/json.hpp>

#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using CompareCommand = Program;

TEST_F(CompareCommand, TellsDrawsAndRefuses) {
  ASSERT_EQ(verp("walk --for 3 --record a.mcap --json").status, 0);
  const Outcome told = verp("compare a.mcap a.mcap --json -o page");
  ASSERT_EQ(told.status, 0) << told.err;
  const auto json = nlohmann::json::parse(told.out);
  EXPECT_EQ(json.at("error_rms_deg"), 0);
  EXPECT_EQ(json.at("joints").size(), 21u);
  EXPECT_TRUE(json.at("joints")[0].at("delay_ms").is_null());  // the head stands still
  EXPECT_NE(slurp(folder_ / "page/index.html").find("<svg"), std::string::npos);
  EXPECT_TRUE(slurp(folder_ / "page/compare.png").starts_with("\x89PNG"));
  EXPECT_NE(slurp(folder_ / "page/joints.csv").find("\nl_knee,"), std::string::npos);
  expect_refused("compare a.mcap none.mcap", "none.mcap");
  expect_refused("compare a.mcap page/joints.csv", "not an MCAP file");
  expect_refused("compare a.mcap a.mcap --shift 60", "in common");
}

}  // namespace
}  // namespace verp::tool::test
