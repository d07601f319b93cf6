#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "host/os/link/line_rate.hpp"
#include "host/os/link/link_error.hpp"
#include "host/os/link/port.hpp"

namespace verp::link {
namespace {

constexpr std::string_view kTerminals = "/dev/pts/";

std::string folder_of(const std::string& path) {
  const std::string::size_type end = path.rfind('/');
  return end == std::string::npos ? "." : path.substr(0, end + 1);
}

/// True if ptsname() gives such names.
bool is_terminal_name(std::string_view name) {
  if (!name.starts_with(kTerminals) || name.size() == kTerminals.size()) return false;
  name.remove_prefix(kTerminals.size());
  return std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The kernel removes the name with the master. Opening it would look like a peer to its master.
bool exists(const std::string& name) {
  struct stat status {};
  return ::stat(name.c_str(), &status) == 0;
}

/// The other end is a serial port to other programs.
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
    // Raw mode; opening and closing the other end shows the master that no peer is there.
    const Descriptor slave(::open(name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    termios settings{};
    if (::tcgetattr(slave.get(), &settings) == 0) {
      ::cfmakeraw(&settings);
      ::tcsetattr(slave.get(), TCSANOW, &settings);
    }
    found_ = rate();
    if (!path_.empty()) make_symbolic_link();
  }

  ~PtyPort() override {
    if (target() == name_) ::unlink(path_.c_str());
  }

  int open() override {
    pollfd one{master_.get(), 0, 0};
    return ::poll(&one, 1, 0) < 0 || (one.revents & POLLHUP) != 0 ? -1 : master_.get();
  }
  // The next peer must not get unread bytes; the master's flush does not reach the other end's line
  // buffer.
  void close() override {
    const Descriptor slave(::open(name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    ::tcflush(master_.get(), TCOFLUSH);
    ::tcflush(slave.get(), TCIFLUSH);
  }
  std::uint32_t rate() const override { return line_rate(master_.get()); }
  void set_rate(std::uint32_t baud) override {
    if (rate() == found_) set_line_rate(master_.get(), baud);
  }
  std::uint32_t retry_us() const override { return 1000; }
  std::string place() const override { return path_.empty() ? name_ : path_; }

 private:
  std::string target() const {
    std::array<char, 64> target{};
    return ::readlink(path_.c_str(), target.data(), target.size() - 1) > 0 ? target.data() : "";
  }
  void make_symbolic_link() {
    const int error = link();
    if (error == 0) return;
    if (error != EEXIST || !is_terminal_name(target())) refuse_link(error);
    // If two programs find a killed program's link, the second must see the first one's.
    const Descriptor folder(::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.get() >= 0) ::flock(folder.get(), LOCK_EX);
    const std::string other = target();
    if (is_terminal_name(other)) {
      if (exists(other)) refuse_served(other);
      ::unlink(path_.c_str());
    }
    if (const int still = link(); still != 0) refuse_link(still);
  }
  /// errno of the failed link. A killed program's number may be ours now, and then its link.
  int link() const {
    const int error = ::symlink(name_.c_str(), path_.c_str()) == 0 ? 0 : errno;
    return error == EEXIST && target() == name_ ? 0 : error;
  }

  [[noreturn]] void refuse_served(const std::string& other) const {
    throw LinkError(
        LinkError::Kind::kBusy,
        "pty:" + path_ + ": another program serves it, on " + other +
            "; to talk to that give serial:" + std::filesystem::absolute(path_).string() +
            "@BAUD with the servos' baud rate, to serve it yourself end that or name "
            "another path");
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
    const std::string folder = folder_of(path_);
    if (error == ENOENT || error == ENOTDIR) {
      throw LinkError(LinkError::Kind::kNoDevice,
                      at + "there is no folder " + folder + "; make it, or name another path");
    }
    throw LinkError(LinkError::Kind::kPermission,
                    at + std::strerror(error) + "; name a path in a folder of yours");
  }

  std::string path_;
  std::string name_;
  std::uint32_t found_ = 0;  ///< the kernel's initial rate
  Descriptor master_;
};

}  // namespace

std::unique_ptr<Port> make_pty_port(const Endpoint& endpoint) {
  return std::make_unique<PtyPort>(endpoint.place);
}

}  // namespace verp::link
