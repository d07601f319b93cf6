#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/schedule.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using Json = nlohmann::json;

const fs::path kGuide = fs::path(VERP_SOURCE_DIR) / "host/guide";

class WireCommand : public Program {
 protected:
  Json wire(const std::string& arguments) const {
    const Outcome outcome = verp("bus wire --json " + arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The schedule counts bytes without the twin.
TEST_F(WireCommand, ATickTakesTheTimeOfItsBytes) {
  const Params params = model::make_params(model::load_robot(model::find_model("generic21")));
  const Json tick = wire("--show tick");
  double bytes_us = 0, free_us = 0;
  std::size_t read = 0;
  for (const Json& each : tick["packets"]) {
    const double begin_us = each["begin_us"], end_us = each["end_us"];
    EXPECT_GE(begin_us, free_us - 1e-6) << each;
    const double us = 1e7 * static_cast<double>(each["bytes"].size()) / params.baud;
    EXPECT_NEAR(end_us - begin_us, us, 1e-6) << each;
    bytes_us += us;
    free_us = end_us;
    const std::string what = each["what"];
    const bool writes = what.starts_with("sync write");
    read += writes ? 0 : each["bytes"].size();
  }
  EXPECT_EQ(read, app::fast_sync_read_bytes(params.servo_count(), 4) +
                      app::sync_read_bytes(app::sensor_devices(params), dxl::sensor_block::kBytes));
  EXPECT_NEAR(tick["wire_us"], bytes_us, 1e-6) << "the twin's devices answer at once";
  EXPECT_LE(tick["wire_us"], app::schedule_us(params));
}

TEST_F(WireCommand, TicksBeginAPeriodApart) {
  for (const char* bus : {"", "--bus can"}) {
    const Json ticks = wire(std::string("--show period --tick 20 ") + bus);
    ASSERT_EQ(ticks["times"].size(), 2u) << bus;
    for (const Json& each : ticks["times"]) EXPECT_EQ(each["us"], ticks["period_us"]) << bus;
  }
}

TEST_F(WireCommand, ThePingIsTheMakers) {
  const Json ping = wire("--show ping")["packets"];
  ASSERT_EQ(ping.size(), 2u);
  std::uint8_t frame[16];
  const std::size_t size = dxl::encode_ping(frame, sizeof frame, 19);
  EXPECT_EQ(ping[0]["bytes"], std::vector<std::uint8_t>(frame, frame + size));
  EXPECT_EQ(ping[0]["sender"], "board");
  EXPECT_EQ(ping[1]["sender"], "device");
}

// High and low of the line, from the picture, are the bytes again.
TEST_F(WireCommand, ThePictureOfThePingDecodesToItsBytes) {
  const Json ping = wire("--show bits --picture bits.svg");
  const std::string svg = slurp(folder_ / "bits.svg");
  const std::size_t at = svg.rfind("<polyline points='");
  ASSERT_NE(at, std::string::npos);
  std::istringstream points(svg.substr(at + 18, svg.find('\'', at + 18) - at - 18));
  std::vector<std::pair<double, double>> line;
  for (std::string point; points >> point;) {
    const std::size_t comma = point.find(',');
    line.emplace_back(std::stod(point.substr(0, comma)), std::stod(point.substr(comma + 1)));
  }
  const double high = line.front().second, begin = line[1].first;
  const auto level = [&](double x) {
    double y = high;
    for (const auto& [at_x, at_y] : line) y = at_x <= x ? at_y : y;
    return y == high;
  };
  // The arrow over the packet is its length.
  const std::size_t arrow = svg.find("<path d='M");
  const std::vector<std::uint8_t> bytes = ping["packets"][0]["bytes"];
  const double end = std::stod(svg.substr(svg.find("v12M", arrow) + 4));
  const double bit = (end - begin) / (10.0 * static_cast<double>(bytes.size()));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    unsigned byte = 0;
    const double start = begin + 10 * bit * static_cast<double>(i);
    EXPECT_FALSE(level(start + bit / 2)) << "start bit " << i;
    for (int b = 0; b < 8; ++b) byte |= level(start + (1.5 + b) * bit) ? 1u << b : 0u;
    EXPECT_EQ(byte, bytes[i]) << i;
    EXPECT_TRUE(level(start + 9.5 * bit)) << "stop bit " << i;
  }
}

TEST_F(WireCommand, WhatItCannotShowIsRefused) {
  expect_refused("bus wire --bus can --show ping", "of a CAN bus there is tick and period");
  expect_refused("bus wire --show walk", "--show");
  expect_refused("bus wire --tick 0", "--tick");
  expect_refused("bus wire nobody", "nobody");
  const Outcome outcome = verp("bus wire --show ping --picture nowhere/a.svg");
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.err.find("nowhere/a.svg: cannot be written"), std::string::npos) << outcome.err;
}

// What the page quotes of an answer begins its lines; numbers of a walk are cut off.
TEST_F(WireCommand, ThePageOfABringUpQuotesItsAnswers) {
  const std::string kCommand = "./verp bus wire";
  const std::vector<std::string> page = lines_of(slurp(kGuide / "bring-up.md"));
  int quoted = 0;
  for (std::size_t i = 0; i + 1 < page.size(); ++i) {
    if (!page[i].starts_with(kCommand) || page[i + 1] == "```") continue;
    const auto answer = lines_of(verp(page[i].substr(7)).out);
    for (std::size_t at = 0; page[i + 1 + at] != "```"; ++at, ++quoted) {
      ASSERT_LT(at, answer.size()) << page[i];
      EXPECT_EQ(page[i + 1 + at], answer[at].substr(0, page[i + 1 + at].size())) << page[i];
    }
  }
  EXPECT_GT(quoted, 20);
}

TEST_F(WireCommand, ThePicturesOfABringUpAreItsOwn) {
  for (const char* show : {"ping", "bits", "silent", "tick", "period"}) {
    const std::string name = std::string(show) + ".svg";
    EXPECT_EQ(verp("bus wire --show " + std::string(show) + " --picture " + name).status, 0);
    EXPECT_EQ(slurp(folder_ / name), slurp(kGuide / "images" / ("bring-up-" + name)))
        << "draw it anew: ./verp bus wire --show " << show
        << " --picture host/guide/images/bring-up-" << name;
  }
}

}  // namespace
}  // namespace verp::tool::test
