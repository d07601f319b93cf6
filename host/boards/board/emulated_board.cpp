#include "host/boards/board/emulated_board.hpp"

#include <algorithm>
#include <cstdlib>

#include "host/boards/board/board_error.hpp"
#include "host/os/files/places.hpp"

namespace verp::board {

namespace {

/// QEMU's xlnx-zcu102: a Cortex-R5F is off until a Cortex-A53 requests it. These words at 0x200000
/// call PSCI's CPU_ON(core 4, 0x01000000) and sleep; boards/zcu102_r5/README.md lists them.
std::vector<std::string> wake_the_r5() {
  constexpr const char* kWords[] = {
      "addr=0x200000,data=0xf2800060d2b88000,data-len=8",
      "addr=0x200008,data=0xd2a02002d2800081,data-len=8",
      "addr=0x200010,data=0xd4000003d2800003,data-len=8",
      "addr=0x200018,data=0x17ffffffd503207f,data-len=8",
      "addr=0x200000,cpu-num=0",
  };
  std::vector<std::string> options = {"-smp", "5", "-m", "256M", "-accel", "tcg,tb-size=32"};
  for (const char* word : kWords) {
    options.emplace_back("-device");
    options.emplace_back(std::string("loader,") + word);
  }
  return options;
}

}  // namespace

const std::vector<EmulatedBoard>& emulated_boards() {
  static const std::vector<EmulatedBoard> boards = {
      {"mps2_an385", "mps2-an385", "Cortex-M3", true},
      {"mps2_an386", "mps2-an386", "Cortex-M4F", true},
      {"mps2_an500", "mps2-an500", "Cortex-M7", true},
      {"mps3_an547", "mps3-an547", "Cortex-M55", false},
      {"olimex_h405", "netduinoplus2", "Cortex-M4F", false},
      {"qemu_rv32",
       "virt",
       "RV32IMAC",
       false,
       "qemu-system-riscv32",
       "qemu-system-misc",
       {"-m", "32M", "-bios", "none", "-accel", "tcg,tb-size=32"},
       "-kernel",
       "",
       {"-device", "kvaser_pci,canbus=can0_bus"}},
      {"zcu102_r5",
       "xlnx-zcu102",
       "Cortex-R5F",
       false,
       "qemu-system-aarch64",
       "qemu-system-arm",
       wake_the_r5(),
       "-device",
       "loader,file=",
       {"-machine", "canbus0=can0_bus", "-machine", "canbus1=can0_bus"}},
  };
  return boards;
}

const EmulatedBoard& find_emulated_board(const std::string& name) {
  const auto& boards = emulated_boards();
  const auto found = std::find_if(boards.begin(), boards.end(),
                                  [&](const EmulatedBoard& board) { return board.name == name; });
  if (found != boards.end()) return *found;
  std::string known;
  for (const EmulatedBoard& board : boards) known += std::string(" ") + board.name;
  throw NoSuchBoard("no emulated board '" + name + "'; there is:" + known);
}

std::filesystem::path firmware_image(const EmulatedBoard& board, const std::string& what,
                                     const std::string& images) {
  const std::string name = board.name;
  const char* folder = std::getenv("VERP_FIRMWARE_DIR");
  std::filesystem::path image =
      (!images.empty()     ? std::filesystem::path(images)
       : folder != nullptr ? std::filesystem::path(folder)
                           : files::source_dir() / "build" / ("fw-" + name) / "images") /
      (what + "_" + name + ".elf");
  if (!std::filesystem::exists(image)) {
    throw NoSuchBoard(image.string() + ": no such firmware image; build it: cmake --preset fw-" +
                      name + " && cmake --build --preset fw-" + name);
  }
  return image;
}

}  // namespace verp::board
