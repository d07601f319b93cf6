#pragma once
#include <stdexcept>
#include <string>

namespace verp::flash {

/// Why nothing, or not all, came into a board's flash. what() is one line that ends with a remedy.
class FlashError : public std::runtime_error {
 public:
  enum class Kind {
    kUsage,        ///< no such board, tool or port for it
    kBadFile,      ///< a file that must not be written there
    kNoTool,       ///< the flash tool is not installed
    kNoDevice,     ///< no probe, boot loader or port; or the chip behind it does not answer
    kPermission,   ///< it is there, but not for this user
    kBusy,         ///< another program has it
    kWrongChip,    ///< it is another chip than the board's
    kProtected,    ///< the chip's readout protection
    kRefused,      ///< the chip would not erase or write
    kLost,         ///< it went away in the middle
    kVerify,       ///< what was written reads back differently
    kInterrupted,  ///< Ctrl-C
    kOther,        ///< something else that the tool says
  };
  FlashError(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace verp::flash
