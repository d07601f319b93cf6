#pragma once
#include <filesystem>
#include <string>

#include "host/boards/flash/recipe.hpp"

namespace verp::flash {

struct MemoryMap {
  Span code, ram;
  Span params = {}, actions = {};  ///< empty: not in flash
};

/// Reads boards/<board>/memory.ld. Throws FlashError if missing or not understood.
MemoryMap read_memory_map(const std::string& board);

/// Symbols verp_{params,actions}_{begin,bytes}, and FLASH and RAM of MEMORY: a number, a name or
/// `DEFINED(x) ? a : b`, where b is for flashed images.
MemoryMap parse_memory_map(const std::filesystem::path& file);

}  // namespace verp::flash
