#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "common/model/params.hpp"
#include "host/boards/flash/memory_map.hpp"

/// These throw FlashError for invalid files.
namespace verp::flash {

/// loop_<board> or loop_can_<board>; neither can drive the other's robot. Throws FlashError without
/// CAN.
std::string loop_image(const Recipe& recipe, BusProtocol protocol);

/// sensor_<board> or foot_<board> by `what`: the board becomes the IMU or a foot of `robot` (null:
/// named later). Throws FlashError if it cannot be.
std::string sensor_image(const Recipe& recipe, const std::string& what, const Params* robot);

/// The binary: in $VERP_FIRMWARE_DIR, else the build folder of the preset fw-<board>.
std::filesystem::path code_image(const Recipe& recipe, const std::string& image);

/// Requires a fitting size, and a vector table for this map: stack in RAM, entry in the code.
void check_code(const std::filesystem::path& file, const MemoryMap& map);

/// Requires a fitting, valid image for this core (common/model/image.hpp).
Params check_params(const std::filesystem::path& file, const MemoryMap& map);

/// File with the actions of a sector that a failed run saved.
inline constexpr const char* kKeptActions = "kept_actions.bin";

/// Checks actions (common/action/kept.hpp), `robot`'s own if given. kKeptActions may have any
/// content. Returns their number.
int check_actions(const std::filesystem::path& file, const MemoryMap& map, const Params* robot);

}  // namespace verp::flash
