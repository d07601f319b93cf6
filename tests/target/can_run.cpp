#include "tests/target/can_run.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>

#include "firmware/app/app.hpp"
#include "firmware/app/can_loop_job.hpp"
#include "host/boards/board/board_error.hpp"
#include "host/boards/board/emulated_board.hpp"
#include "host/boards/board/qemu.hpp"
#include "host/boards/board/temporary_directory.hpp"
#include "host/os/link/can_port.hpp"
#include "tests/target/lockstep_port.hpp"

namespace verp::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kSilence{60};
constexpr std::uint32_t kLook_us = 100'000;  ///< between checks of a silent emulator
constexpr std::chrono::seconds kEnd{10};

struct Keeper {
  std::vector<TickRecord>& records;
  void record(const TickRecord& record, const State&, const Outputs&) { records.push_back(record); }
};

template <class T>
void put(std::ofstream& file, const T& value) {
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void write_job(const std::filesystem::path& path, const Params& params, const Script& script) {
  std::ofstream file(path, std::ios::binary);
  app::CanLoopJob job;
  job.ticks = script.ticks;
  job.actions_size = static_cast<std::uint32_t>(4 * script.actions.size());
  put(file, job);
  put(file, params);
  for (const std::uint32_t word : script.actions) put(file, word);
  for (std::uint32_t n = 0; n < script.ticks + script.ticks / 8; ++n) put(file, script.order(n));
}

std::vector<TickRecord> read_records(const std::filesystem::path& path) {
  std::vector<TickRecord> records(std::filesystem::file_size(path) / sizeof(TickRecord));
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(records.data()),
            static_cast<std::streamsize>(records.size() * sizeof(TickRecord)));
  return records;
}

struct Watch {
  Clock::time_point first, last;
  std::uint64_t frames = 0, frames_before = 0;
  std::uint32_t ticks = 0;

  can::LockstepHooks hooks() {
    can::LockstepHooks hooks;
    hooks.tick_begins = [this](std::uint32_t) {
      last = Clock::now();
      if (ticks++ == 0) first = last, frames_before = frames;
    };
    hooks.sent = [this](const CanFrame&) { ++frames; };
    hooks.polled = [this](const std::vector<CanFrame>& burst, std::uint64_t) {
      frames += burst.size() + 2;  // question and answer
    };
    return hooks;
  }
};

const link::Endpoint kInterface{.kind = link::Endpoint::Kind::kCan, .place = "vcan0"};

/// Passes vcan0's frames to the live check, which may ask the controller.
class Listener {
 public:
  explicit Listener(shadow::LiveCheck& check) : check_(check) {}
  void listen(can::LockstepServer& server) {
    CanFrame frame;
    while (port_.poll(frame, 0)) check_.take(frame, port_.now_us());
    while (check_.next(frame, port_.now_us())) server.enclose(frame);
  }
  std::uint32_t overruns() const { return port_.errors().overruns; }

 private:
  link::CanPort port_{kInterface};
  shadow::LiveCheck& check_;
};

void serve(can::LockstepServer& server, can::LockstepPort& port, board::QemuProcess& firmware,
           std::optional<Listener>& listener) {
  Clock::time_point heard = Clock::now();
  for (;;) {
    const bool served = port.serve(server, kLook_us);
    if (listener) listener->listen(server);
    if (served) {
      heard = Clock::now();
      continue;
    }
    if (firmware.poll_status()) return;
    if (Clock::now() - heard > kSilence) throw board::BoardError(firmware.described("is silent"));
  }
}

}  // namespace

CanRun run_over_can(const std::string& board, CanTwin& twin, const Script& script,
                    shadow::LiveCheck* check) {
  twin.hands.take(script);
  return run_over_can(board, twin.robot.params, twin.bus, script, check);
}

CanRun run_over_can(const std::string& name, const Params& params, can::VirtualCan& bus,
                    const Script& script, shadow::LiveCheck* check) {
  const board::TemporaryDirectory folder;
  const auto job = folder.path() / "job", records = folder.path() / "records";
  write_job(job, params, script);
  can::LockstepPort port(kInterface);
  std::optional<Listener> listener;
  if (check != nullptr) listener.emplace(*check);
  Watch watch;
  can::LockstepServer server(params, bus, watch.hooks());
  const board::EmulatedBoard& emulated = board::find_emulated_board(name);
  board::QemuProcess firmware({.board = emulated,
                               .image = board::firmware_image(emulated, "loop"),
                               .arguments = {job.string(), records.string()},
                               .can_interface = "vcan0"});
  serve(server, port, firmware, listener);
  try {
    firmware.wait_for_success(kEnd);
  } catch (const board::BoardError& failed) {
    throw board::BoardError(std::string(failed.what()) + "\nanswers asked for again: " +
                            std::to_string(server.counters().repeats));
  }
  const std::uint32_t unheard = listener ? listener->overruns() : 0;
  if (port.errors().overruns + unheard != 0) {
    throw board::BoardError("vcan0: frames were lost on this PC");
  }
  CanRun run{.records = read_records(records), .counters = server.counters()};
  const std::chrono::duration<double> took = watch.last - watch.first;
  if (watch.ticks > 1) {
    run.ticks_per_s = (watch.ticks - 1) / took.count();
    run.frames_per_tick = static_cast<double>(watch.frames - watch.frames_before) / watch.ticks;
  }
  return run;
}

std::vector<TickRecord> run_can_here(CanTwin& twin, const Script& script) {
  std::vector<TickRecord> records;
  Orders orders{script};
  Keeper keeper{records};
  twin.hands.take(script);
  app::App app(twin.robot.params, twin.bus, orders, keeper, static_cast<app::NoImu*>(nullptr),
               app::Core{{script.actions.data(), 4 * script.actions.size()}});
  if (app.bring_up().status != app::BringUpStatus::kReady) return {};
  for (std::uint32_t n = 0; n < script.ticks; ++n) app.tick();
  return records;
}

}  // namespace verp::test
