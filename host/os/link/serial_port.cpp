#include <fcntl.h>
#include <libserial/SerialPort.h>
#include <linux/serial.h>
#include <pty.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "host/os/link/line_rate.hpp"
#include "host/os/link/link_error.hpp"
#include "host/os/link/port.hpp"
#include "host/os/link/serial_check.hpp"

namespace verp::link {
namespace {

using Kind = LinkError::Kind;
using LibSerial::BaudRate;

constexpr std::uint32_t kRetry_us = 50'000;

std::string ports_here() {
  std::string names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/dev", error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("ttyUSB") && !name.starts_with("ttyACM")) continue;
    names += (names.empty() ? "" : " ") + entry.path().string();
  }
  return names.empty() ? "no USB serial port is plugged in" : "plugged in: " + names;
}

LinkError no_permission(const std::string& device) {
  return {Kind::kPermission, device +
                                 ": no permission; join the group that may: sudo usermod -aG "
                                 "dialout $USER, then log in again"};
}

LinkError busy(const std::string& device) {
  return {Kind::kBusy,
          device + ": another program has it open; end that, fuser -v " + device + " names it"};
}

}  // namespace

void check_serial_port(const std::string& device) {
  struct stat status {};
  if (::stat(device.c_str(), &status) != 0) {
    if (errno == EACCES) throw no_permission(device);
    throw LinkError(Kind::kNoDevice, device + ": no such device; " + ports_here());
  }
  if (!S_ISCHR(status.st_mode)) {
    throw LinkError(Kind::kUnsuitable, device + ": is no serial port; " + ports_here());
  }
  const Descriptor probe(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (probe.get() >= 0) {
    if (::isatty(probe.get()) != 0) return;
    throw LinkError(Kind::kUnsuitable, device + ": is no serial port; " + ports_here());
  }
  const int error = errno;
  if (error == EACCES || error == EPERM) throw no_permission(device);
  if (error == EBUSY) throw busy(device);
  throw LinkError(Kind::kNoDevice,
                  device + ": " + std::strerror(error) + "; unplug it and plug it in again");
}

namespace {

/// libserial's constant for a rate; BAUD_INVALID: set the rate through the kernel.
BaudRate standard_rate(std::uint32_t baud) {
  switch (baud) {
    case 9600:
      return BaudRate::BAUD_9600;
    case 57600:
      return BaudRate::BAUD_57600;
    case 115200:
      return BaudRate::BAUD_115200;
    case 1000000:
      return BaudRate::BAUD_1000000;
    case 2000000:
      return BaudRate::BAUD_2000000;
    case 3000000:
      return BaudRate::BAUD_3000000;
    case 4000000:
      return BaudRate::BAUD_4000000;
    default:
      return BaudRate::BAUD_INVALID;
  }
}

class SerialPort final : public Port {
 public:
  explicit SerialPort(const Endpoint& endpoint) : device_(endpoint.place), baud_(endpoint.baud) {}
  ~SerialPort() override { close(); }

  int open() override {
    check_serial_port(device_);
    port_ = std::make_unique<LibSerial::SerialPort>();
    try {
      port_->Open(device_);
      own();
      set_up();
    } catch (const LinkError&) {
      close();
      throw;
    } catch (const std::exception& error) {  // without an error number
      close();
      throw LinkError(Kind::kUnsuitable,
                      device_ + ": " + error.what() + "; is it a serial port, and free?");
    }
    at_open_ = counters();
    return port_->GetFileDescriptor();
  }

  void close() override {
    if (!port_) return;
    before_ = counted();
    at_open_ = {};
    try {
      if (port_->IsOpen()) port_->Close();
    } catch (const std::exception&) {
      give_it_a_terminal();
    }
    port_.reset();
  }

  std::uint32_t retry_us() const override { return kRetry_us; }
  std::string place() const override { return device_; }

  hal::LinkErrors counted() override {
    hal::LinkErrors sum = before_;
    if (!port_) return sum;
    const hal::LinkErrors now = counters();
    sum.overruns += now.overruns - at_open_.overruns;
    sum.framing += now.framing - at_open_.framing;
    sum.noise += now.noise - at_open_.noise;
    return sum;
  }

 private:
  // A second reader would take half of the bytes. TIOCEXCL does not exclude root; flock() excludes
  // all that use it.
  void own() const {
    const int descriptor = port_->GetFileDescriptor();
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) throw busy(device_);
    ::ioctl(descriptor, TIOCEXCL);
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
  }

  // Closing restores the settings; on an unplugged device that fails, and libserial's destructor
  // ends the program. So give it a terminal on which closing succeeds.
  void give_it_a_terminal() {
    int master = -1;
    int slave = -1;
    if (::openpty(&master, &slave, nullptr, nullptr, nullptr) == 0) {
      ::dup2(slave, port_->GetFileDescriptor());
      ::close(slave);
      spare_.reset(master);
    } else {
      ::close(port_->GetFileDescriptor());
      static_cast<void>(port_.release());  // better a leak than a lost robot
    }
  }

  void set_up() const {
    port_->SetCharacterSize(LibSerial::CharacterSize::CHAR_SIZE_8);
    port_->SetParity(LibSerial::Parity::PARITY_NONE);
    port_->SetStopBits(LibSerial::StopBits::STOP_BITS_1);
    port_->SetFlowControl(LibSerial::FlowControl::FLOW_CONTROL_NONE);
    port_->SetVMin(1);  // with 0, an empty read looks like a hang-up
    port_->SetVTime(0);
    port_->SetSerialPortBlockingStatus(false);
    set_line();
    port_->FlushIOBuffers();
    serial_struct settings{};
    const int descriptor = port_->GetFileDescriptor();
    if (::ioctl(descriptor, TIOCGSERIAL, &settings) == 0) {
      settings.flags |= ASYNC_LOW_LATENCY;
      ::ioctl(descriptor, TIOCSSERIAL, &settings);  // not in all drivers
    }
  }

  // Receivers tolerate about 2 % of rate error. An adapter silently replaces rates that it lacks.
  void set_line() const {
    const int descriptor = port_->GetFileDescriptor();
    const BaudRate rate = standard_rate(baud_);
    if (rate != BaudRate::BAUD_INVALID) port_->SetBaudRate(rate);
    const bool set = rate != BaudRate::BAUD_INVALID || set_line_rate(descriptor, baud_);
    const std::uint32_t real = line_rate(descriptor);
    const std::uint32_t error = real > baud_ ? real - baud_ : baud_ - real;
    if (set && (real == 0 || error <= baud_ / 50)) return;
    throw LinkError(Kind::kUnsuitable, device_ + ": cannot make " + std::to_string(baud_) +
                                           " baud, only " + std::to_string(real) +
                                           "; choose another rate");
  }

  hal::LinkErrors counters() const {
    serial_icounter_struct count{};
    if (!port_ || !port_->IsOpen() ||
        ::ioctl(port_->GetFileDescriptor(), TIOCGICOUNT, &count) != 0) {
      return at_open_;  // pseudo-terminals and unplugged devices have no counters
    }
    const auto sum = [](int a, int b) { return static_cast<std::uint32_t>(a + b); };
    return {.overruns = sum(count.overrun, count.buf_overrun),
            .framing = sum(count.frame, count.brk),
            .noise = sum(count.parity, 0)};
  }

  std::string device_;
  std::uint32_t baud_;
  Descriptor spare_;  ///< must outlive port_
  std::unique_ptr<LibSerial::SerialPort> port_;
  hal::LinkErrors before_;   ///< from earlier openings
  hal::LinkErrors at_open_;  ///< driver's counters
};

}  // namespace

std::unique_ptr<Port> make_serial_port(const Endpoint& endpoint) {
  return std::make_unique<SerialPort>(endpoint);
}

}  // namespace verp::link
