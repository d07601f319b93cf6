#include <nlohmann/json.hpp>

#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using DemoCommand = Program;

TEST_F(DemoCommand, ListsWhatThereIs) {
  const Outcome outcome = verp("demo");
  EXPECT_EQ(outcome.status, 0);
  for (const char* name : {"column", "follow", "goal", "ball"})
    EXPECT_NE(outcome.out.find(name), std::string::npos) << name;
}

TEST_F(DemoCommand, WhatCannotBeIsOneLineAndBadInput) {
  expect_refused("demo folow", "follow");
  expect_refused("demo follow --robots 1", "2 to 8");
  expect_refused("demo follow --robots 9", "2 to 8");
  expect_refused("demo follow --radio range_m=0", "range_m");
  expect_refused("demo follow --radio loss", "NAME=VALUE");
  expect_refused("demo follow --radio 'loss=2'", "0 to 1");
  expect_refused("demo follow --radio far=1", "range_m, loss");
  expect_refused("demo follow --picture a.jpg", ".png or .svg");
  expect_refused("demo follow --picture nowhere/a.png", "there is no folder nowhere");
  expect_refused("demo follow --for 0", "--for");
}

TEST_F(DemoCommand, ThatFailsItsCriterionEndsWithOne) {
  fs::create_directory(folder_ / "follow.png");  // blocks the picture
  const Outcome lost = verp("demo follow --robots 2 --for 2 --json");
  EXPECT_EQ(lost.status, 1);
  EXPECT_NE(lost.err.find("follow.png"), std::string::npos) << lost.err;
  const auto all_else = nlohmann::json::parse(lost.out);
  EXPECT_TRUE(all_else["picture"].is_null());
  EXPECT_EQ(all_else["lost"].size(), 1u);
  EXPECT_EQ(all_else["robots"].size(), 2u);
  const Outcome outcome = verp("demo follow --robots 2 --for 2 --json --no-picture");
  EXPECT_EQ(outcome.status, 1);
  const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << outcome.out;
  EXPECT_NE(json["verdict"], "good");
  EXPECT_EQ(json["robots"].size(), 2u);
  EXPECT_TRUE(json["picture"].is_null());
  EXPECT_NE(outcome.err, "");
}

}  // namespace
}  // namespace verp::tool::test
