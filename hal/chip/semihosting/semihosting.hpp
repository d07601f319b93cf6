#pragma once
#include <cstddef>
#include <cstdint>

/// Arm semihosting: an emulated (or debugged) core asks the PC to open, read and write files. Files
/// may be FIFOs, which makes this the fastest link to QEMU. Calls after "Semihosting for AArch32
/// and AArch64" (Arm IHI 0100). A call stops the core until the PC has answered; without a debugger
/// it faults.
namespace verp::hal::semihosting {

/// An open file. Only one owner; closes at the end of its life.
class File {
 public:
  enum class Mode : std::uint32_t { kRead = 1, kWrite = 5 };  ///< "rb", "wb"

  /// `path` is on the PC, relative to where the emulator runs. Opening a FIFO waits for the other
  /// end.
  File(const char* path, Mode mode);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool is_open() const { return handle_ >= 0; }
  /// Waits for at least one byte; returns how many came, at most capacity; 0: the other end closed.
  std::size_t read_some(void* data, std::size_t capacity);
  /// Waits until all bytes have come. False: the other end closed, or the file ended, before that.
  bool read(void* data, std::size_t size);
  /// Waits until all bytes have gone. False: the other end closed.
  bool write(const void* data, std::size_t size);

 private:
  int handle_;
};

/// What the PC passed on the command line, at most capacity - 1 characters. False if it did not
/// fit.
bool command_line(char* text, std::size_t capacity);

/// To the emulator's standard error.
void print(const char* text);

/// Ends the emulator with this exit status.
[[noreturn]] void exit(int status);

}  // namespace verp::hal::semihosting
