#pragma once
#include <filesystem>
#include <string>

#include "host/boards/flash/recipe.hpp"

namespace verp::flash {

/// Memory regions of a board, read from the memory.ld that the linker uses.
struct MemoryMap {
  Span code, ram;
  Span params = {}, actions = {};  ///< empty if the board does not keep them in flash
};

/// Reads boards/<board>/memory.ld of the source tree. Throws FlashError if it is missing or this
/// parser does not understand it.
MemoryMap read_memory_map(const std::string& board);

/// The same for any file: symbols verp_{params,actions}_{begin,bytes}, and FLASH and RAM of MEMORY.
/// Each is a number, a name or `DEFINED(x) ? a : b`; b applies to flashed images.
MemoryMap parse_memory_map(const std::filesystem::path& file);

}  // namespace verp::flash
