#pragma once
#include <stdexcept>
#include <string>

namespace verp::flash {

/// A flash operation failed completely or partly. what() is one line that ends with a remedy.
class FlashError : public std::runtime_error {
 public:
  enum class Kind {
    kUsage,    ///< no such board, tool or port for it
    kBadFile,  ///< this file must not be written there
    kNoTool,
    kNoDevice,    ///< no probe, boot loader or port, or the chip does not answer
    kPermission,  ///< the device exists, but this user may not open it
    kBusy,        ///< another program uses it
    kWrongChip,   ///< not the board's chip
    kProtected,
    kRefused,  ///< the chip refused to erase or write
    kLost,     ///< the connection was lost during the operation
    kVerify,   ///< the flash reads back differently
    kInterrupted,
    kOther,  ///< any other error of the tool
  };
  FlashError(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace verp::flash
