#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/control/step.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/lockstep_can.hpp"
#include "firmware/app/node_settings.hpp"
#include "host/os/link/can_port.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/trace/record/trace.hpp"
#include "tests/can/capture.hpp"
#include "tests/host/tool/link_controller.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;
using verp::test::Capture;
using verp::test::Decoded;
namespace plan = canopen::plan;

struct CanSocket : link::CanPort {
  explicit CanSocket(const std::string& endpoint) : CanPort(link::parse_endpoint(endpoint)) {}
};
using CanController = verp::test::ControllerOn<CanSocket, app::LockstepCan>;
using Frames = std::vector<Decoded>;

/// A twin that answers late repeats its answer: drops the repeats.
Frames without_repeats(const Frames& all) {
  Frames kept;
  std::vector<std::size_t> answer;  ///< the twin's frames in `kept` since its last answer
  int last = -1;
  for (const Decoded& each : all) {
    const canopen::Connection on =
        each.id > 0x7FF ? canopen::Connection{} : canopen::connection_of(each.id);
    using canopen::Service;
    const bool twins = on.service == Service::kTpdo || on.service == Service::kSdoResponse ||
                       on.service == Service::kEmcy ||
                       (on.service == Service::kHeartbeat && on.node != plan::kControllerNode);
    if (twins) answer.push_back(kept.size());
    kept.push_back(each);
    if (each.id != lockstep::kCanAdvancedId || each.data.empty()) continue;
    const bool repeated = last == each.data[0];
    last = each.data[0];
    for (; repeated && !answer.empty(); answer.pop_back()) {
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(answer.back()));
    }
    answer.clear();
  }
  return kept;
}

using Write = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

class CanTools : public Program {
 protected:
  const Params params =
      model::make_params(model::load_robot(model::find_model("generic21"), "can"));
  Frames frames;
  record::Trace trace;

  void walk() {
    const std::string orders = (folder_ / "orders").string();
    Capture capture(folder_);
    CanController controller(params, "can:vcan0", "unix:" + orders);
    const Outcome hil = verp(
        "hil --bus can --link can:vcan0 --json --for 3 --record walk.mcap "
        "--operator unix-listen:" +
        orders);
    controller.join();
    ASSERT_EQ(hil.status, 0) << hil.err;
    frames = without_repeats(capture.decode());
    trace = record::read_trace(folder_ / "walk.mcap");
  }
  std::vector<std::uint8_t> nodes() const {
    std::vector<std::uint8_t> all;
    for (int slot = 0; slot < app::kCanNodes; ++slot) {
      if (const std::uint8_t id = app::node_id(params, slot); id != 0) all.push_back(id);
    }
    return all;
  }
  /// Each tick's SYNC with counter 1.
  std::vector<std::size_t> ticks() const {
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (frames[i].is("SYNC") && frames[i].sync == 1u) at.push_back(i);
    }
    return at;
  }
  Frames some(std::size_t from, std::size_t to, const char* words) const {
    Frames all;
    for (std::size_t i = from; i < to; ++i) {
      if (frames[i].is(words)) all.push_back(frames[i]);
    }
    return all;
  }

  void expect_commands(std::size_t end) const;
  void expect_settings(std::size_t end) const;
  void expect_answers(const Inputs& inputs, std::size_t from, std::size_t to) const;
  void expect_goals(const Outputs& outputs, std::size_t from, std::size_t to) const;
  void expect_heartbeats(std::size_t from, std::size_t to) const;
  bool says(const Decoded& answer, const Inputs& inputs) const {
    return answer.node == params.joint[inputs.slow_joint].servo_id &&
           plan::Telemetry::from(answer.value(0, 4)) == plan::Telemetry{inputs.slow_voltage_tenth_v,
                                                                        inputs.slow_temperature_c,
                                                                        inputs.slow_error};
  }
};

void CanTools::expect_commands(std::size_t end) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> told, wanted;
  for (const Decoded& each : some(0, end, "NMT: "))
    told.push_back({*each.command, *each.commanded});
  for (const std::uint8_t node : nodes()) wanted.push_back({0x81, node});
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (const std::uint8_t node : nodes()) wanted.push_back({0x01, node});
  }
  EXPECT_EQ(told, wanted);
  std::map<std::uint32_t, int> booted;
  for (const Decoded& each : some(0, end, "NMT Error Control: Boot-up")) {
    EXPECT_EQ(each.state, 0u);
    ++booted[*each.node];
  }
  for (const std::uint8_t node : nodes()) EXPECT_GE(booted[node], 1) << int{node};
  EXPECT_EQ(booted.size(), nodes().size());
}

void CanTools::expect_settings(std::size_t end) const {
  std::vector<Write> wanted, told;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> kept;
  app::Setting setting;
  for (int slot = 0; slot < app::kCanNodes; ++slot) {
    const std::uint32_t node = app::node_id(params, slot);
    for (int i = 0; node != 0 && app::node_setting(params, slot, i, setting); ++i) {
      const std::uint32_t value =
          setting.bytes == 4 ? setting.value : setting.value & ((1u << 8 * setting.bytes) - 1);
      wanted.push_back({node, setting.at.index, setting.at.subindex, value});
      if (setting.stays) kept[{node, setting.at.index, setting.at.subindex}] = value;
    }
  }
  int confirmed = 0, read_back = 0;
  for (const Decoded& each : some(0, end, "Default-SDO")) {
    if (each.is("Default-SDO (rx): Initiate download")) {
      told.push_back({*each.node, *each.index, *each.subindex, each.value(0, 4)});
    }
    if (each.is("Default-SDO (tx): Initiate download")) {
      ASSERT_EQ((std::tuple{*each.node, *each.index, *each.subindex}),
                (std::tuple{std::get<0>(told.back()), std::get<1>(told.back()),
                            std::get<2>(told.back())}));
      ++confirmed;
    }
    if (!each.is("Default-SDO (tx): Initiate upload")) continue;
    const auto found = kept.find({*each.node, *each.index, *each.subindex});
    if (found == kept.end()) continue;
    EXPECT_EQ(each.value(0, each.data.size()), found->second) << std::hex << *each.index;
    ++read_back;
  }
  EXPECT_EQ(told, wanted);
  // Third and fourth PDOs are optional.
  const Frames aborted = some(0, end, "Default-SDO (tx): Abort");
  for (const Decoded& each : aborted) {
    EXPECT_EQ(*each.index & 0xFF00, 0x1800u);
    EXPECT_EQ(each.abort_code, 0x06020000u);
  }
  EXPECT_EQ(static_cast<std::size_t>(confirmed) + aborted.size(), wanted.size());
  EXPECT_GT(read_back, 500);
}

void CanTools::expect_answers(const Inputs& inputs, std::size_t from, std::size_t to) const {
  std::map<std::uint32_t, Decoded> first, second;
  for (const Decoded& each : some(from, to, "PDO1 (tx)")) first[*each.node] = each;
  for (const Decoded& each : some(from, to, "PDO2 (tx)")) second[*each.node] = each;
  for (int j = 0; j < params.joint_count; ++j) {
    const auto& data = first.at(params.joint[j].servo_id);
    EXPECT_EQ(static_cast<std::int32_t>(data.value(2, 4)), inputs.position_count[j])
        << "joint " << j << " in tick " << inputs.tick;
  }
  for (unsigned axis = 0; axis < 3; ++axis) {
    const std::uint8_t imu = params.imu.device_id;
    EXPECT_EQ(static_cast<std::int16_t>(first.at(imu).value(2 * axis, 2)), inputs.gyro_count[axis]);
    EXPECT_EQ(static_cast<std::int16_t>(second.at(imu).value(2 * axis, 2)),
              inputs.accel_count[axis]);
  }
  for (int foot = 0; foot < kFeet; ++foot) {
    for (unsigned i = 0; i < kFootSensors; ++i) {
      EXPECT_EQ(first.at(params.feet.device_id[foot]).value(2 * i, 2), inputs.foot_count[foot][i]);
    }
  }
}

void CanTools::expect_goals(const Outputs& outputs, std::size_t from, std::size_t to) const {
  std::map<std::uint32_t, Decoded> told;
  for (const Decoded& each : some(from, to, "PDO1 (rx)")) told[*each.node] = each;
  for (int j = 0; j < params.joint_count; ++j) {
    const int in_frame = j % plan::kGoals.width;
    const auto& data = told.at(params.joint[j - in_frame].servo_id);
    EXPECT_EQ(static_cast<std::int32_t>(data.value(4 * static_cast<std::size_t>(in_frame), 4)),
              outputs.goal_count[j])
        << "joint " << j;
  }
}

// The controller's heartbeats, which drives watch: so many within their patience.
void CanTools::expect_heartbeats(std::size_t from, std::size_t to) const {
  const std::uint32_t ticks_each = std::uint32_t{plan::patience_ms(params)} * 1000 /
                                   plan::kHeartbeatsInPatience / params.period_us;
  std::size_t beats = 0;
  for (const Decoded& each : some(from, to, "NMT Error Control")) {
    EXPECT_EQ(each.node, std::uint32_t{plan::kControllerNode});
    EXPECT_EQ(each.state, beats == 0 ? 0u : 5u) << "boot-up, then operational";
    ++beats;
  }
  EXPECT_NEAR(static_cast<double>(beats),
              static_cast<double>(trace.ticks.size()) / (ticks_each + 0.5),
              2 + 0.1 * static_cast<double>(beats));
}

TEST_F(CanTools, TsharkReadsAWalkAsWeSayItIs) {
  ASSERT_NO_FATAL_FAILURE(walk());
  const std::vector<std::size_t> at = ticks();
  ASSERT_GT(trace.ticks.size(), 100u);
  ASSERT_GE(at.size(), trace.ticks.size());
  expect_commands(at.front());
  expect_settings(at.front());
  EXPECT_TRUE(some(0, frames.size(), "EMCY").empty());

  const action::Library actions = trace.library();
  State state;
  std::size_t driven = 0, uploads = 0, velocities = 0, torques = 0;
  Frames telemetry;
  for (std::size_t i = 0; i + 1 < trace.ticks.size() && !HasFailure(); ++i) {
    const std::size_t from = at[i], to = at[i + 1];
    const Frames syncs = some(from, to, "SYNC");
    ASSERT_EQ(syncs.size(), plan::sync_groups(params));
    for (std::size_t k = 0; k < syncs.size(); ++k) EXPECT_EQ(syncs[k].sync, k + 1);
    const Inputs& inputs = trace.ticks[i].inputs;
    expect_answers(inputs, from, to);
    Outputs outputs;
    step(params, actions, state, inputs, outputs);
    if (outputs.torque_enable != 0) {
      expect_goals(outputs, from, to);
      ++driven;
    }
    for (const Decoded& each : some(from, to, "Default-SDO (tx): Initiate upload")) {
      ++uploads;
      if (each.index == plan::kTelemetry.index) telemetry.push_back(each);
      velocities += each.index == 0x606C ? 1 : 0;
      torques += each.index == 0x6077 ? 1 : 0;
    }
    // The next answer may have come, too.
    if ((inputs.flags & kSlowFresh) != 0) {
      ASSERT_FALSE(telemetry.empty());
      const bool told = says(telemetry.back(), inputs) ||
                        (telemetry.size() > 1 && says(telemetry[telemetry.size() - 2], inputs));
      EXPECT_TRUE(told) << "telemetry in tick " << inputs.tick;
    }
  }
  EXPECT_GT(driven, 80u);
  expect_heartbeats(at.front(), at[trace.ticks.size() - 1]);
  EXPECT_GT(telemetry.size(), trace.ticks.size() / 2);
  EXPECT_EQ(uploads, telemetry.size() + velocities + torques) << "nothing else is asked";
  EXPECT_GT(velocities, trace.ticks.size() / (3 * plan::kEffortTicks));
  EXPECT_GT(torques, trace.ticks.size() / (3 * plan::kEffortTicks));
}

TEST_F(CanTools, RandomTrafficBesideAWalkChangesNothing) {
  const Outcome walk = verp("walk --bus can --json --for 3", "walk");
  ASSERT_EQ(walk.status, 0) << walk.err;
  const process::Child extended(
      {.words = {"cangen", "vcan0", "-e", "-g", "4", "-i"}, .input = {}, .output = {}});
  const process::Child unused(
      {.words = {"cangen", "vcan0", "-I", "7E5", "-g", "7", "-i"}, .input = {}, .output = {}});
  const std::string orders = (folder_ / "orders").string();
  CanController controller(params, "can:vcan0", "unix:" + orders);
  const Outcome hil =
      verp("hil --bus can --link can:vcan0 --json --for 3 --operator unix-listen:" + orders, "hil");
  controller.join();
  ASSERT_EQ(hil.status, 0) << hil.err;
  const json result = json::parse(hil.out), expected = json::parse(walk.out);
  EXPECT_EQ(result.at("digest"), expected.at("digest"));
  EXPECT_EQ(result.at("compared_ticks"), expected.at("ticks"));
  EXPECT_EQ(result.at("link").at("damaged"), 0);
  EXPECT_EQ(result.at("link").at("overruns"), 0);
  EXPECT_GT(result.at("link").at("repeats"), 5) << "the controller met them, too";
}

}  // namespace
}  // namespace verp::tool::test
