#pragma once
#include <stdexcept>
#include <string>

namespace verp::link {

/// A link that cannot be opened: exit status 3. what() is one line that ends with a remedy.
class LinkError : public std::runtime_error {
 public:
  enum class Kind {
    kNoDevice,    ///< no such device, host or socket
    kPermission,  ///< it is there, but not for this user
    kBusy,        ///< another program has it
    kRefused,     ///< nobody listens there
    kUnsuitable,  ///< it is no such device, or cannot do what was asked of it
  };
  LinkError(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace verp::link
