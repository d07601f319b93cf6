#include "host/boards/flash/emulation.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>

#include "common/action/kept.hpp"
#include "common/protocol/controller_table.hpp"
#include "host/boards/board/board_error.hpp"
#include "host/boards/flash/flash_error.hpp"
#include "host/boards/flash/images.hpp"
#include "host/twin/bus/client.hpp"
#include "host/twin/bus/register_names.hpp"

namespace verp::flash {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kStart{20};
/// Longer than a boot check in an emulator on a busy machine.
constexpr std::uint32_t kPatience_us = 5'000'000;

bool is_emulated(const std::string& name) {
  const auto& boards = board::emulated_boards();
  return std::any_of(boards.begin(), boards.end(),
                     [&](const board::EmulatedBoard& each) { return each.name == name; });
}

/// The path must suit QEMU's options and a socket's name.
void require_plain(const fs::path& path) {
  if (path.string().size() < sizeof(sockaddr_un::sun_path) &&
      path.string().find_first_of(" ,") == std::string::npos) {
    return;
  }
  throw FlashError(FlashError::Kind::kUsage,
                   path.string() +
                       ": too long, or with a space or comma in it, for QEMU; set "
                       "VERP_FLASH_DIR to another folder, such as /tmp/verp");
}

/// Plans an STM32 board: two serial ports as sockets, pieces at their addresses.
void plan_serial(EmulationPlan& plan, const std::vector<Piece>& pieces, const fs::path& folder) {
  plan.launch.serial_ports = {folder / "servo.sock", folder / "operator.sock"};
  plan.launch.options = {"-accel", "tcg,thread=single"};
  for (const Piece& piece : pieces) {
    require_plain(piece.file);
    plan.launch.options.insert(plan.launch.options.end(),
                               {"-device", fmt::format("loader,file={},addr={:#010x},force-raw=on",
                                                       piece.file.string(), piece.region.begin)});
  }
  if (plan.protocol != BusProtocol::kCia402) {  // QEMU's chip has no CAN
    plan.links.push_back({"servo bus", "unix:" + plan.launch.serial_ports[0].string()});
  }
  plan.links.push_back({"operator", "unix:" + plan.launch.serial_ports[1].string()});
}

/// MPS2 board: uses semihosting through two FIFOs (host/boards/board/fifo_link.hpp).
void plan_fifos(EmulationPlan& plan, const fs::path& folder) {
  for (const char* name : {"to_board", "from_board"}) {
    plan.launch.arguments.push_back((folder / name).string());
    plan.links.push_back({name, (folder / name).string()});
  }
}

std::string actions_told(int count, int fault) {
  if (fault == 0) return fmt::format("{} actions", count);
  const bool known = fault < static_cast<int>(std::size(action::kKeptFaultNames));
  return fmt::format(
      "its actions do not count: {}",
      known ? action::kKeptFaultNames[fault] : "action_fault is " + fmt::to_string(fault));
}

}  // namespace

EmulationPlan plan_emulation(const Recipe& recipe, BusProtocol protocol,
                             const std::vector<Piece>& pieces, const fs::path& folder) {
  const std::string board = recipe.board;
  if (!is_emulated(board)) {
    throw FlashError(FlashError::Kind::kUsage,
                     fmt::format("{}: no emulator has this chip; leave out --emulate", board));
  }
  require_plain(folder / "operator.sock");
  const board::EmulatedBoard& emulated = board::find_emulated_board(board);
  // The chip's raw image: for an ELF file QEMU also clears memory behind the code, where the robot
  // may be.
  const fs::path image = recipe.chip != nullptr ? code_image(recipe, loop_image(recipe, protocol))
                                                : firmware_image(emulated, "loop");
  EmulationPlan plan{.launch = {.board = emulated, .image = image, .arguments = {}},
                     .links = {},
                     .protocol = protocol};
  if (recipe.chip != nullptr) {
    plan_serial(plan, pieces, folder);
  } else {
    plan_fifos(plan, folder);
  }
  return plan;
}

Emulation::Emulation(const EmulationPlan& plan) {
  for (const std::string& fifo : plan.launch.arguments) {
    if (::mkfifo(fifo.c_str(), 0600) == 0) continue;
    throw board::BoardError(fifo + ": can't make a FIFO (" + std::strerror(errno) +
                            "); set VERP_FLASH_DIR to a folder of a file system that has FIFOs");
  }
  firmware_ = std::make_unique<board::QemuProcess>(plan.launch);
  const auto deadline = std::chrono::steady_clock::now() + kStart;
  for (const fs::path& socket : plan.launch.serial_ports) {
    while (!fs::exists(socket)) {
      if (!running() || std::chrono::steady_clock::now() > deadline) {
        throw board::BoardError(described("made no " + socket.string()));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  if (plan.launch.serial_ports.empty()) return;
  operator_place_ = plan.launch.serial_ports.back().string();
  protocol_ = plan.protocol;
}

std::string Emulation::told() const {
  if (operator_place_.empty()) return "";
  bus::Client controller({.kind = link::Endpoint::Kind::kUnix, .place = operator_place_},
                         kPatience_us);
  const auto number = [&](const char* name) {
    const bus::NamedRegister* found = bus::find_register(dxl::controller::kModel, name);
    return controller.read(dxl::controller::kDefaultId, found->address, 1).at(0);
  };
  const std::uint8_t verdict = number("self_test");
  if (verdict != static_cast<std::uint8_t>(dxl::controller::SelfTest::kPassed)) {
    const bus::NamedRegister* field = bus::find_register(dxl::controller::kModel, "image_field");
    const std::vector<std::uint8_t> text =
        controller.read(dxl::controller::kDefaultId, field->address, kFieldNameLength);
    const std::string name(text.begin(), std::find(text.begin(), text.end(), 0));
    return fmt::format(
        "it refuses torque: self_test is {} (firmware/app/registers.md){}; a robot goes "
        "in with --params MODEL",
        verdict, name.empty() ? "" : ", for " + name);
  }
  const std::uint8_t fault = number("start_fault");
  if (fault == static_cast<std::uint8_t>(dxl::controller::StartFault::kNone)) {
    return "its boot check passed; " + actions_told(number("action_count"), number("action_fault"));
  }
  return fmt::format(
      "its boot check passed, but it refuses torque: start_fault is {} ({})", fault,
      protocol_ == BusProtocol::kCia402 ? "QEMU's chip has no CAN" : "firmware/app/registers.md");
}

}  // namespace verp::flash
