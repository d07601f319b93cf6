#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "host/flash/memory_map.hpp"

/// What may be written where. All throw FlashError for a file that must not be.
namespace verp::flash {

/// The bytes of loop_<board>, in $VERP_FIRMWARE_DIR if that is set, else where the preset
/// fw-<board> builds them.
std::filesystem::path code_image(const std::string& board);

/// A vector table for this memory map (a stack in RAM, an entry in the code), and no more than
/// fits.
void check_code(const std::filesystem::path& file, const MemoryMap& map);

/// A sound Params image of this program's core (common/model/image.hpp) that fits. Returns the
/// robot's name.
std::string check_params(const std::filesystem::path& file, const MemoryMap& map);

/// What a run that failed kept of a sector's actions is in a file of this name, and all of them.
inline constexpr const char* kKeptActions = "kept_actions.bin";

/// Such a file: until actions have a format nothing else can be told from noise.
void check_actions(const std::filesystem::path& file, const MemoryMap& map);

}  // namespace verp::flash
