#pragma once
#include <stdexcept>
#include <string>

namespace verp::flash {

/// Failed completely or partly. what() is one line with a remedy.
class FlashError : public std::runtime_error {
 public:
  enum class Kind {
    kUsage,    ///< no such board, tool or port
    kBadFile,  ///< not to be written there
    kNoTool,
    kNoDevice,    ///< no probe, boot loader, port, or answer
    kPermission,  ///< this user may not open it
    kBusy,        ///< another program uses it
    kWrongChip,   ///< not the board's chip
    kProtected,
    kRefused,  ///< the chip refused to erase or write
    kLost,     ///< connection lost during the operation
    kVerify,   ///< the flash reads back differently
    kInterrupted,
    kOther,
  };
  FlashError(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace verp::flash
