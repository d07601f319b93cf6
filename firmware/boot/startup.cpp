#include <cstdint>

#include "firmware/boot/boot.hpp"
#include "firmware/boot/core.hpp"
#include "firmware/boot/stack.hpp"

/// From the core's entry to verp_main(). Symbols from sections.ld.
extern "C" {
extern const std::uint32_t verp_data_image[];
extern std::uint32_t verp_data_begin[];
extern std::uint32_t verp_data_end[];
extern std::uint32_t verp_bss_begin[];
extern std::uint32_t verp_bss_end[];
extern std::uint32_t verp_dma_begin[];
extern std::uint32_t verp_dma_end[];
using Constructor = void (*)();
extern const Constructor verp_init_begin[];
extern const Constructor verp_init_end[];
}

namespace {

// Volatile keeps the compiler from calling memcpy and memset, which may not work yet.
void fill_memory() {
  const volatile std::uint32_t* from = verp_data_image;
  for (volatile std::uint32_t* to = verp_data_begin; to != verp_data_end; ++to) *to = *from++;
  for (volatile std::uint32_t* word = verp_bss_begin; word != verp_bss_end; ++word) *word = 0;
  for (volatile std::uint32_t* word = verp_dma_begin; word != verp_dma_end; ++word) *word = 0;
}

}  // namespace

extern "C" void verp_reset() {
  verp::boot::enable_core();
  verp::boot::guard_stack();
  verp::boot::paint_stack();
  fill_memory();
  for (const Constructor* constructor = verp_init_begin; constructor != verp_init_end;
       ++constructor) {
    (*constructor)();
  }
  verp_exit(verp_main());
}
