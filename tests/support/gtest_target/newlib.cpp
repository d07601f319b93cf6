#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "firmware/boot/boot.hpp"
#include "hal/chip/semihosting/semihosting.hpp"

/// System calls of newlib and the C++ library: number formatting and containers need a heap. File
/// access fails; output is printed.
extern "C" {
extern char verp_heap_begin[];
extern char verp_heap_end[];

void* _sbrk(std::ptrdiff_t bytes) {
  static char* end = verp_heap_begin;
  if (bytes > verp_heap_end - end) {
    errno = ENOMEM;
    return reinterpret_cast<void*>(-1);
  }
  char* const block = end;
  end += bytes;
  return block;
}
[[noreturn]] void _exit(int status) {
  verp_exit(status);
}
int _write(int, const char* text, int size) {
  for (int i = 0; i < size; ++i) {
    const char letter[2] = {text[i], 0};
    verp::hal::semihosting::print(letter);
  }
  return size;
}
int _read(int, char*, int) {
  return 0;
}
int _close(int) {
  return -1;
}
int _lseek(int, int, int) {
  return 0;
}
int _isatty(int) {
  return 1;
}
int _fstat(int, void*) {
  return -1;
}
int _kill(int, int) {
  return -1;
}
int _getpid() {
  return 1;
}
/// The library's version would bring its exceptions.
[[noreturn]] void __cxa_pure_virtual() {
  std::abort();
}
}

void* operator new(std::size_t bytes) {
  void* const block = std::malloc(bytes);
  if (block == nullptr) {
    verp::hal::semihosting::print("the heap is full\n");
    std::abort();
  }
  return block;
}
void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}

namespace std {
[[noreturn]] void __throw_length_error(const char* why) {
  verp::hal::semihosting::print(why);
  abort();
}
[[noreturn]] void __throw_logic_error(const char* why) {
  __throw_length_error(why);
}
[[noreturn]] void __throw_out_of_range(const char* why) {
  __throw_length_error(why);
}
[[noreturn]] void __throw_out_of_range_fmt(const char* why, ...) {
  __throw_length_error(why);
}
[[noreturn]] void __throw_bad_alloc() {
  __throw_length_error("bad_alloc");
}
[[noreturn]] void __throw_bad_array_new_length() {
  __throw_length_error("bad_array_new_length");
}
[[noreturn]] void __throw_bad_function_call() {
  __throw_length_error("bad_function_call");
}
}  // namespace std
