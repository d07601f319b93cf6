#include <cerrno>
#include <cstddef>
#include <cstdint>

#include "firmware/boot/boot.hpp"
#include "hal/chip/semihosting/semihosting.hpp"

/// What newlib asks of a system, for test images only: number formatting wants a heap. Files are
/// refused.
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
int _write(int, const char*, int size) {
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
}
