#pragma once
#include <cstddef>
#include <cstdint>

/// Arm semihosting: an emulated or debugged core reads and writes files on the PC ("Semihosting for
/// AArch32 and AArch64", Arm IHI 0100). FIFOs work too: the fastest link to QEMU. A call stops the
/// core until the PC has answered; without a debugger it faults.
namespace verp::hal::semihosting {

/// An open file; the destructor closes it.
class File {
 public:
  enum class Mode : std::uint32_t { kRead = 1, kWrite = 5 };  ///< "rb", "wb"

  /// `path` is relative to the emulator's directory. Opening a FIFO waits for the far end.
  File(const char* path, Mode mode);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool is_open() const { return handle_ >= 0; }
  /// Waits for at least one byte; returns the count. 0: the far end closed.
  std::size_t read_some(void* data, std::size_t capacity);
  /// Waits for all bytes. False: the far end closed or the file ended.
  bool read(void* data, std::size_t size);
  /// Waits until all bytes have gone. False: the far end closed.
  bool write(const void* data, std::size_t size);

 private:
  int handle_;
};

/// The emulator's command line, at most capacity - 1 characters. False: it did not fit.
bool command_line(char* text, std::size_t capacity);

/// Prints to the emulator's standard error.
void print(const char* text);

[[noreturn]] void exit(int status);

}  // namespace verp::hal::semihosting
