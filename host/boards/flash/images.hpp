#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "common/model/params.hpp"
#include "host/boards/flash/memory_map.hpp"

/// What may be written where. All throw FlashError for a file that must not be.
namespace verp::flash {

/// The image that drives a robot on this kind of bus: loop_<board>, or loop_can_<board>, of which
/// neither drives the other's robot. Throws FlashError where the board has no CAN.
std::string loop_image(const Recipe& recipe, BusProtocol protocol);

/// Its bytes, in $VERP_FIRMWARE_DIR if that is set, else where the preset fw-<board> builds them.
std::filesystem::path code_image(const Recipe& recipe, BusProtocol protocol);

/// A vector table for this memory map (a stack in RAM, an entry in the code), and no more than
/// fits.
void check_code(const std::filesystem::path& file, const MemoryMap& map);

/// A sound Params image of this program's core (common/model/image.hpp) that fits.
Params check_params(const std::filesystem::path& file, const MemoryMap& map);

/// What a run that failed kept of a sector's actions is in a file of this name, and all of them.
inline constexpr const char* kKeptActions = "kept_actions.bin";

/// A robot's actions (common/action/kept.hpp), `robot`'s own if that goes with them; or a file of
/// that name, whatever was kept. Returns how many there are.
int check_actions(const std::filesystem::path& file, const MemoryMap& map, const Params* robot);

}  // namespace verp::flash
