#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "host/link/link_error.hpp"
#include "host/link/port.hpp"

namespace verp::wire {
namespace {

/// The master's end of a pseudo-terminal: whoever opens the other end finds a serial port.
class PtyPort final : public Port {
 public:
  explicit PtyPort(std::string path) : path_(std::move(path)) {
    master_.reset(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    std::array<char, 64> name{};
    if (master_.get() < 0 || ::grantpt(master_.get()) != 0 || ::unlockpt(master_.get()) != 0 ||
        ::ptsname_r(master_.get(), name.data(), name.size()) != 0) {
      throw LinkError(LinkError::Kind::kNoDevice,
                      std::string("no pseudo-terminal: ") + std::strerror(errno) +
                          "; mount /dev/pts, or close programs that use many");
    }
    name_ = name.data();
    // Raw from the start, and once open and closed, so that the master knows that nobody is there.
    const Descriptor slave(::open(name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    termios settings{};
    if (::tcgetattr(slave.get(), &settings) == 0) {
      ::cfmakeraw(&settings);
      ::tcsetattr(slave.get(), TCSANOW, &settings);
    }
    if (!path_.empty()) make_symbolic_link();
  }

  ~PtyPort() override {
    if (target() == name_) ::unlink(path_.c_str());
  }

  int open() override {
    pollfd one{master_.get(), 0, 0};
    return ::poll(&one, 1, 0) < 0 || (one.revents & POLLHUP) != 0 ? -1 : master_.get();
  }
  void close() override {}
  std::uint32_t retry_us() const override { return 1000; }
  std::string place() const override { return path_.empty() ? name_ : path_; }

 private:
  /// Where the symbolic link at path_ goes; empty if there is none.
  std::string target() const {
    std::array<char, 64> target{};
    return ::readlink(path_.c_str(), target.data(), target.size() - 1) > 0 ? target.data() : "";
  }
  void make_symbolic_link() {
    if (target().starts_with("/dev/pts/")) ::unlink(path_.c_str());  // of one that was killed
    if (::symlink(name_.c_str(), path_.c_str()) == 0) return;
    refuse_link(errno);
  }

  [[noreturn]] void refuse_link(int error) const {
    const std::string at = "pty:" + path_ + ": ";
    if (error == EEXIST) {
      throw LinkError(LinkError::Kind::kBusy,
                      at +
                          "that is there already, and pty: makes a new port; name another path, "
                          "or open what is there with serial:" +
                          path_);
    }
    const std::string::size_type end = path_.rfind('/');
    const std::string folder = end == std::string::npos ? "." : path_.substr(0, end + 1);
    if (error == ENOENT || error == ENOTDIR) {
      throw LinkError(LinkError::Kind::kNoDevice,
                      at + "there is no folder " + folder + "; make it, or name another path");
    }
    throw LinkError(LinkError::Kind::kPermission,
                    at + std::strerror(error) + "; name a path in a folder of yours");
  }

  std::string path_;
  std::string name_;
  Descriptor master_;
};

}  // namespace

std::unique_ptr<Port> make_pty_port(const Endpoint& endpoint) {
  return std::make_unique<PtyPort>(endpoint.place);
}

}  // namespace verp::wire
