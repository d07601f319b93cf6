#include "host/boards/flash/images.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <vector>

#include "common/action/kept.hpp"
#include "common/model/image.hpp"
#include "host/boards/flash/flash_error.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/export.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::flash {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw FlashError(FlashError::Kind::kBadFile, file.string() + ": " + why);
}

std::string read(const std::filesystem::path& file, const char* what, const Span& region) {
  if (region.bytes == 0) refuse(file, fmt::format("this board keeps no {} in its flash", what));
  if (std::filesystem::is_directory(file)) refuse(file, "is a folder; name a file");
  std::optional<std::string> bytes = files::read(file);
  if (!bytes) refuse(file, "cannot be read; check the path and its permissions");
  if (bytes->empty()) refuse(file, "is empty; write it again");
  if (bytes->size() > region.bytes) {
    refuse(file, fmt::format("{} bytes are too many: {:#010x} has {} for the {}; is it the right "
                             "file?",
                             bytes->size(), region.begin, region.bytes, what));
  }
  return *bytes;
}

std::uint32_t word(const std::string& bytes, std::size_t index) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + 4 * index, sizeof value);
  return value;
}

}  // namespace

std::string loop_image(const Recipe& recipe, BusProtocol protocol) {
  if (protocol != BusProtocol::kCia402) return std::string("loop_") + recipe.board;
  if (recipe.can_image) return std::string("loop_can_") + recipe.board;
  std::string names;
  for (const Recipe& row : recipes()) {
    if (row.can_image) names += (names.empty() ? "" : ", ") + std::string(row.board);
  }
  throw FlashError(FlashError::Kind::kUsage,
                   fmt::format("{} drives no robot on CAN; give --board one of: {}, or another of "
                               "the robot's buses with --bus",
                               recipe.board, names));
}

std::string sensor_image(const Recipe& recipe, const std::string& what, const Params* robot) {
  const std::string image = what + "_" + recipe.board;
  const auto refuse = [&](const std::string& why) {
    throw FlashError(FlashError::Kind::kUsage, "--image " + what + ": " + why);
  };
  const bool foot = what == "foot";
  if (recipe.chip == nullptr || (foot && !recipe.foot_image)) {
    refuse(std::string(recipe.board) + " has no pins for it; name olimex_h405" +
           (foot ? " or nucleo_f446re" : ", nucleo_f446re or opencr"));
  }
  if (robot == nullptr) return image;
  const std::string name = robot->name;
  if (robot->bus_protocol != BusProtocol::kDynamixel2) {
    refuse("that bus of " + name + " has no Dynamixel servos; name another with --bus");
  }
  const auto& feet = robot->feet.device_id;
  if (foot ? feet[0] == 0 && feet[1] == 0 : robot->imu.device_id == 0) {
    refuse(fmt::format("{} has none on its bus; give the <verp:{}> of its file an id", name,
                       foot ? "feet" : "imu"));
  }
  return image;
}

std::filesystem::path code_image(const Recipe& recipe, const std::string& image) {
  const std::string board = recipe.board;
  const char* folder = std::getenv("VERP_FIRMWARE_DIR");
  const std::filesystem::path file =
      (folder != nullptr ? std::filesystem::path(folder)
                         : files::source_dir() / "build" / ("fw-" + board) / "images") /
      (image + ".bin");
  if (!std::filesystem::exists(file)) {
    refuse(file, fmt::format("not built; run ./verp flash --board {0}, which builds it, or: cmake "
                             "--preset fw-{0} && cmake --build --preset fw-{0}",
                             board));
  }
  return file;
}

void check_code(const std::filesystem::path& file, const MemoryMap& map) {
  constexpr std::size_t kFewestVectors = 16;  // minimum of every Cortex-M
  const std::string bytes = read(file, "code", map.code);
  const char* again = "build the firmware again";
  if (bytes.size() < 4 * kFewestVectors) refuse(file, fmt::format("is cut off; {}", again));
  const std::uint32_t stack = word(bytes, 0), entry = word(bytes, 1);
  const bool stack_in_ram = stack > map.ram.begin && stack <= map.ram.end() && stack % 4 == 0;
  const bool entry_in_code =
      entry % 2 == 1 && entry > map.code.begin && entry < map.code.begin + bytes.size();
  if (stack_in_ram && entry_in_code) return;
  refuse(file, fmt::format("does not begin with a vector table for {:#010x} (stack {:#010x}, entry "
                           "{:#010x}), so it is no firmware of this board; {}",
                           map.code.begin, stack, entry, again));
}

Params check_params(const std::filesystem::path& file, const MemoryMap& map) {
  read(file, "robot", map.params);
  try {
    return model::read_image(file.string()).params;
  } catch (const model::LoadError& error) {
    throw FlashError(FlashError::Kind::kBadFile, error.what());
  }
}

int check_actions(const std::filesystem::path& file, const MemoryMap& map, const Params* robot) {
  const std::string bytes = read(file, "actions", map.actions);
  if (bytes.size() >= sizeof kImageMagic &&
      std::memcmp(bytes.data(), kImageMagic, sizeof kImageMagic) == 0) {
    refuse(file, "is a robot (a Params image), not actions; give it to --params");
  }
  const bool kept = file.filename() == kKeptActions && bytes.size() == map.actions.bytes;
  std::vector<std::uint32_t> words((bytes.size() + 3) / 4);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  const action::KeptFault fault = action::check_any_kept(words.data(), bytes.size());
  if (fault != action::KeptFault::kNone && !kept) {
    refuse(file,
           fmt::format("{}; make it again: verp action export MODEL -o {}",
                       action::kKeptFaultNames[static_cast<int>(fault)], file.filename().string()));
  }
  if (robot != nullptr && !kept &&
      action::check_kept(words.data(), bytes.size(), *robot) != action::KeptFault::kNone) {
    refuse(file, fmt::format("these actions were made for another robot than {}, or before its "
                             "joints were changed; verp action export makes its own",
                             robot->name));
  }
  return action::Library(words.data(), bytes.size()).count();
}

}  // namespace verp::flash
