#pragma once
#include <stdexcept>
#include <string>

namespace verp::link {

/// A link could not be opened: exit status 3. what() is one line that ends with a remedy.
class LinkError : public std::runtime_error {
 public:
  enum class Kind {
    kNoDevice,    ///< no such device, host or socket
    kPermission,  ///< it exists, but this user may not open it
    kBusy,        ///< another program uses it
    kRefused,     ///< nothing listens there
    kUnsuitable,  ///< wrong kind of device, or it does not support the request
  };
  LinkError(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace verp::link
