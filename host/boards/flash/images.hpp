#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "common/model/params.hpp"
#include "host/boards/flash/memory_map.hpp"

/// Checks which files may be written where. All functions throw FlashError for invalid files.
namespace verp::flash {

/// Image name for this bus protocol: loop_<board> or loop_can_<board>; neither can drive the
/// other's robot. Throws FlashError if the board has no CAN.
std::string loop_image(const Recipe& recipe, BusProtocol protocol);

/// Path of its binary: in $VERP_FIRMWARE_DIR if set, else in the build folder of the preset
/// fw-<board>.
std::filesystem::path code_image(const Recipe& recipe, BusProtocol protocol);

/// Requires a vector table for this memory map (stack in RAM, entry in the code) and a size that
/// fits.
void check_code(const std::filesystem::path& file, const MemoryMap& map);

/// Requires a valid Params image of this program's core (common/model/image.hpp) that fits.
Params check_params(const std::filesystem::path& file, const MemoryMap& map);

/// File with the actions of a sector that a failed run saved.
inline constexpr const char* kKeptActions = "kept_actions.bin";

/// Checks a robot's actions (common/action/kept.hpp); they must be `robot`'s own if it is given. A
/// file named kKeptActions is accepted with any content. Returns the number of actions.
int check_actions(const std::filesystem::path& file, const MemoryMap& map, const Params* robot);

}  // namespace verp::flash
