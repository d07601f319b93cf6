#include "tests/target/serial_board.hpp"

#include <chrono>
#include <cstring>
#include <fstream>
#include <optional>
#include <thread>

#include "host/author/action/folder.hpp"
#include "host/author/action/kept.hpp"
#include "host/boards/board/board_error.hpp"
#include "host/robot/model/export.hpp"
#include "host/twin/bus/register_names.hpp"
#include "host/twin/bus/shadow_loop.hpp"
#include "host/twin/sim/robot.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::test {
namespace {

using Clock = std::chrono::steady_clock;

/// Longer than a boot check on a busy machine.
constexpr std::uint32_t kPatience_us = 3'000'000;
constexpr std::chrono::seconds kStart{20};
/// A controller asks again within a second of its own clock, which stutters in an emulator.
constexpr std::uint32_t kSilence_us = 10'000'000;
/// boards/olimex_h405/memory.ld, verp_params_begin.
constexpr const char* kParamsAddress = "0x08020000";
/// Likewise verp_actions_begin.
constexpr const char* kActionsAddress = "0x08030000";

const bus::NamedRegister& named(const char* name) {
  const bus::NamedRegister* found = bus::find_register(dxl::controller::kModel, name);
  if (found == nullptr) throw board::BoardError(std::string("no register ") + name);
  return *found;
}

bus::Client connect(const link::Endpoint& endpoint) {
  const auto deadline = Clock::now() + kStart;
  // The socket's file exists before it listens.
  for (;;) {
    try {
      return bus::Client(endpoint, kPatience_us);
    } catch (const link::LinkError&) {
      if (Clock::now() > deadline) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
}

}  // namespace

SerialBoard::SerialBoard(const std::string& board, const std::vector<std::uint8_t>& params_image,
                         const std::vector<std::uint8_t>& actions_image)
    : firmware_(start(board, params_image, actions_image)),
      operator_port_(connect(endpoint("operator.sock"))) {}

link::Endpoint SerialBoard::endpoint(const char* name) const {
  return {.kind = link::Endpoint::Kind::kUnix, .place = (directory_.path() / name).string()};
}

std::vector<std::string> SerialBoard::load(const char* name, const std::vector<std::uint8_t>& image,
                                           const char* address) const {
  if (image.empty()) return {};
  const std::string file = (directory_.path() / name).string();
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(image.data()),
             static_cast<std::streamsize>(image.size()));
  return {"-device", "loader,file=" + file + ",addr=" + address + ",force-raw=on"};
}

board::QemuProcess SerialBoard::start(const std::string& board,
                                      const std::vector<std::uint8_t>& params,
                                      const std::vector<std::uint8_t>& actions) const {
  const board::EmulatedBoard& emulated = board::find_emulated_board(board);
  board::QemuProcess::Launch launch{
      .board = emulated,
      .image = board::firmware_image(emulated, "loop"),
      .arguments = {},
      .serial_ports = {directory_.path() / "servo.sock", directory_.path() / "operator.sock"}};
  launch.options = load("params.bin", params, kParamsAddress);
  for (const std::string& each : load("actions.bin", actions, kActionsAddress)) {
    launch.options.push_back(each);
  }
  return board::QemuProcess(launch);
}

std::uint64_t SerialBoard::read(const char* name) {
  const bus::NamedRegister& found = named(name);
  const std::vector<std::uint8_t> bytes = operator_port_.read(
      dxl::controller::kDefaultId, found.address, static_cast<std::uint16_t>(found.bytes()));
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data(), std::min(bytes.size(), sizeof value));
  return value;
}

void SerialBoard::write(const char* name, std::int64_t value) {
  const bus::NamedRegister& found = named(name);
  std::vector<std::uint8_t> bytes(found.bytes());
  std::memcpy(bytes.data(), &value, std::min(bytes.size(), sizeof value));
  operator_port_.write(dxl::controller::kDefaultId, found.address, bytes);
}

std::vector<std::uint8_t> params_image(const Robot& robot) {
  const ParamsImage image = model::make_image(robot.entity);
  std::vector<std::uint8_t> bytes(sizeof image);
  std::memcpy(bytes.data(), &image, sizeof image);
  return bytes;
}

std::vector<std::uint8_t> actions_image(const Robot& robot) {
  const auto folder = action::folder_of(robot.entity.file);
  return action::kept_image(action::make_library(robot.params, action::read_folder(folder)),
                            robot.params);
}

namespace {

/// Registers request to walk_wz at once, and action_request.
void give(SerialBoard& board, const app::OperatorOrder& order, std::uint16_t& action) {
  const Command& command = order.command;
  if (action != order.action) board.write("action_request", action = order.action);
  std::vector<std::uint8_t> bytes(8);
  bytes[0] = static_cast<std::uint8_t>(command.request);
  bytes[1] = command.sequence;
  const std::int16_t velocity[] = {command.vx_tenth_mm_s, command.vy_tenth_mm_s, command.wz_mrad_s};
  std::memcpy(bytes.data() + 2, velocity, sizeof velocity);
  board.operator_port().write(dxl::controller::kDefaultId, named("request").address, bytes);
}

class Cable {
 public:
  Cable(SerialBoard& board, const SerialTrouble& trouble)
      : board_(board), trouble_(trouble), spoiler_(trouble.seed), link_(board.servo_port()) {}

  /// Trouble begins with the first tick: earlier it could end the start.
  void serve(bus::LockstepServer& server, const SerialRun& run) {
    std::vector<std::uint8_t> chunk(4096), heard, answer;
    while (!server.stopped()) {
      const std::size_t size = link_->read(chunk.data(), chunk.size(), kSilence_us);
      if (size == 0) throw board::BoardError(board_.described("sent nothing for a while"));
      const bool bad = !run.twin.records.empty();
      heard.clear();
      answer.clear();
      spoiler_.spoil({chunk.data(), size}, heard, bad ? trouble_.from_board : LinkFaults{});
      server.take(heard, answer);
      if (!answer.empty()) send(answer, bad && !server.stopped());
    }
  }
  std::uint64_t faults() const { return spoiler_.faults(); }
  int cuts() const { return cuts_; }

 private:
  void send(const std::vector<std::uint8_t>& answer, bool bad) {
    if (bad && trouble_.cut_every > 0 && ++answers_ % trouble_.cut_every == 0) return cut();
    std::vector<std::uint8_t> bytes;
    spoiler_.spoil(answer, bytes, bad ? trouble_.to_board : LinkFaults{});
    if (link_->write(bytes.data(), bytes.size(), kPatience_us) != bytes.size()) {
      throw board::BoardError(board_.described("took nothing for a while"));
    }
  }
  void cut() {
    link_.reset();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    link_.emplace(board_.servo_port());
    ++cuts_;
  }

  SerialBoard& board_;
  const SerialTrouble& trouble_;
  LinkSpoiler spoiler_;
  std::optional<link::Link> link_;
  int answers_ = 0, cuts_ = 0;
};

}  // namespace

SerialRun run_over_serial(SerialBoard& board, const Robot& robot, std::uint32_t ticks,
                          const SerialTrouble& trouble) {
  return run_over_serial(board, robot, walk_script(robot.params, ticks), trouble);
}

SerialRun run_over_serial(SerialBoard& board, const Robot& robot, const Script& script,
                          const SerialTrouble& trouble) {
  sim::World world;
  sim::TwinRobot body(world, robot.entity);
  bus::VirtualBus bus(robot.params, body);
  const sim::Vec3 start = body.truth().com_world_m;
  Hands hands(world, body);
  hands.take(script);
  const std::uint32_t ticks = script.ticks;
  std::uint16_t action = 0;
  SerialRun run;
  bus::ShadowLoop shadow(robot.params,
                         [&](const TickRecord& record, const State&, const Outputs&) {
                           run.twin.records.push_back(record);
                         },
                         {script.actions.data(), 4 * script.actions.size()});
  Clock::time_point begun;
  bus::LockstepHooks hooks;
  hooks.refused = [](const std::string& why) { throw board::BoardError(why); };
  hooks.sent = [&](auto frame) { shadow.sent({frame.begin(), frame.end()}); };
  hooks.damaged = [&] { shadow.damaged(); };
  hooks.polled = [&](auto bytes, std::uint64_t now_us) {
    shadow.polled({bytes.begin(), bytes.end()}, now_us);
  };
  hooks.tick_begins = [&](std::uint32_t tick) {
    if (tick == trouble.pause_before && trouble.pause) trouble.pause();
    const app::OperatorOrder order = script.order(tick);
    if (run.twin.records.empty()) board.write("request", 0);  // required before any other order
    give(board, order, action);
    shadow.ordered(order);
  };
  hooks.tick_ends = [&] {
    shadow.catch_up();
    if (run.twin.records.empty()) begun = Clock::now();
    if (run.twin.records.size() < ticks) return true;
    run.ticks_per_s = ticks / std::chrono::duration<double>(Clock::now() - begun).count();
    run.digest = board.read("digest");
    run.tick = static_cast<std::uint32_t>(board.read("tick"));
    run.bus_timeouts = static_cast<std::uint32_t>(board.read("bus_timeouts"));
    run.bus_noise = static_cast<std::uint32_t>(board.read("bus_noise"));
    return false;
  };
  bus::LockstepServer server(robot.params, bus, hooks);
  Cable cable(board, trouble);
  cable.serve(server, run);
  run.faults = cable.faults();
  run.cuts = cable.cuts();
  run.lockstep = server.counters();
  run.difference = shadow.difference();
  run.twin.distance_m = (body.truth().com_world_m - start).head<2>().norm();
  run.twin.fallen = body.truth().fallen;
  return run;
}

}  // namespace verp::test
