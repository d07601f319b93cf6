#pragma once
#include <filesystem>
#include <string>

#include "host/boards/flash/recipe.hpp"

namespace verp::flash {

/// What a board keeps where, from its memory.ld: the linker and the flash tool read the same lines.
struct MemoryMap {
  Span code, ram;
  Span params = {}, actions = {};  ///< no bytes where the board keeps none in flash
};

/// Reads boards/<board>/memory.ld of the source tree. Throws FlashError when it is missing or says
/// what this reader does not understand.
MemoryMap read_memory_map(const std::string& board);

/// The same of any file: symbols verp_{params,actions}_{begin,bytes} and MEMORY's FLASH and
/// RAM, each a number, a name or `DEFINED(x) ? a : b`, of which b holds for images that are
/// flashed.
MemoryMap parse_memory_map(const std::filesystem::path& file);

}  // namespace verp::flash
