#pragma once
#include <stdexcept>
#include <string>

namespace verp::link {

/// Exit status 3. what() is one line with a remedy.
class LinkError : public std::runtime_error {
 public:
  enum class Kind {
    kNoDevice,    ///< no such device, host or socket
    kPermission,  ///< this user may not open it
    kBusy,        ///< another program uses it
    kRefused,     ///< nothing listens there
    kUnsuitable,  ///< wrong kind of device or request
  };
  LinkError(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace verp::link
