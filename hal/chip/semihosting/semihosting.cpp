#include "hal/chip/semihosting/semihosting.hpp"

namespace verp::hal::semihosting {
namespace {

enum class Call : std::uint32_t {
  kOpen = 0x01,
  kClose = 0x02,
  kWrite0 = 0x04,
  kWrite = 0x05,
  kRead = 0x06,
  kCommandLine = 0x15,
  kExitExtended = 0x20,
};
constexpr std::uint32_t kApplicationExit = 0x20026;  // ADP_Stopped_ApplicationExit

// How each core family calls ("The semihosting interface"). RISC-V's sequence must lie in one
// memory page.
#if defined(__riscv)
std::int32_t call(Call number, const void* argument) {
  register std::uint32_t a0 __asm__("a0") = static_cast<std::uint32_t>(number);
  register const void* a1 __asm__("a1") = argument;
  __asm__ volatile(
      ".balign 16\n"
      ".option push\n .option norvc\n"
      "slli zero, zero, 0x1F\n"
      "ebreak\n"
      "srai zero, zero, 7\n"
      ".option pop\n"
      : "+r"(a0)
      : "r"(a1)
      : "memory");
  return static_cast<std::int32_t>(a0);
}
#else
#if __ARM_ARCH_PROFILE == 'M'
#define VERP_SEMIHOSTING "bkpt 0xAB"
#else
#define VERP_SEMIHOSTING "svc 0x123456"
#endif
std::int32_t call(Call number, const void* argument) {
  register std::uint32_t r0 __asm__("r0") = static_cast<std::uint32_t>(number);
  register const void* r1 __asm__("r1") = argument;
  __asm__ volatile(VERP_SEMIHOSTING : "+r"(r0) : "r"(r1) : "memory");
  return static_cast<std::int32_t>(r0);
}
#endif

std::uint32_t word(const void* pointer) {
  return reinterpret_cast<std::uint32_t>(pointer);
}

std::size_t length(const char* text) {
  std::size_t size = 0;
  while (text[size] != 0) ++size;
  return size;
}

}  // namespace

File::File(const char* path, Mode mode) {
  const std::uint32_t block[3] = {word(path), static_cast<std::uint32_t>(mode), length(path)};
  handle_ = call(Call::kOpen, block);
}

File::~File() {
  if (!is_open()) return;
  const std::uint32_t block[1] = {static_cast<std::uint32_t>(handle_)};
  call(Call::kClose, block);
}

std::size_t File::read_some(void* data, std::size_t capacity) {
  const std::uint32_t block[3] = {static_cast<std::uint32_t>(handle_), word(data), capacity};
  const auto left = static_cast<std::uint32_t>(call(Call::kRead, block));  // bytes *not* read
  return left < capacity ? capacity - left : 0;
}

bool File::read(void* data, std::size_t size) {
  auto* bytes = static_cast<std::uint8_t*>(data);
  while (size > 0) {
    const std::size_t count = read_some(bytes, size);
    if (count == 0) return false;
    bytes += count;
    size -= count;
  }
  return true;
}

bool File::write(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  while (size > 0) {
    const std::uint32_t block[3] = {static_cast<std::uint32_t>(handle_), word(bytes), size};
    const auto left = static_cast<std::uint32_t>(call(Call::kWrite, block));  // bytes *not* written
    if (left >= size) return false;
    bytes += size - left;
    size = left;
  }
  return true;
}

bool command_line(char* text, std::size_t capacity) {
  const std::uint32_t block[2] = {word(text), capacity};
  return call(Call::kCommandLine, block) == 0;
}

void print(const char* text) {
  call(Call::kWrite0, text);
}

void exit(int status) {
  const std::uint32_t block[2] = {kApplicationExit, static_cast<std::uint32_t>(status)};
  for (;;) call(Call::kExitExtended, block);
}

}  // namespace verp::hal::semihosting
