#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "host/apps/tool/robot/doctor_checks.hpp"
#include "host/boards/flash/diagnosis.hpp"
#include "host/boards/flash/recipe.hpp"
#include "host/os/link/latency.hpp"

namespace verp::tool {
namespace {

enum class Part { kSerial, kCan, kProbe, kBootLoader };

struct UsbDevice {
  const char* vendor;
  const char* product;  ///< as its begin
  Part part;
  const char* name;
  const char* driver;  ///< kernel module; flash tool of a board
};

// The numbers are those of /usr/share/misc/usb.ids and of the kernel's drivers of that name.
constexpr UsbDevice kUsbDevices[] = {
    {"0403", "60", Part::kSerial, "FTDI serial adapter (U2D2 and others)", "ftdi_sio"},
    {"1a86", "7523", Part::kSerial, "CH340 serial adapter", "ch341"},
    {"1a86", "55d3", Part::kSerial, "CH343 serial adapter", "cdc_acm"},
    {"10c4", "ea60", Part::kSerial, "CP210x serial adapter", "cp210x"},
    {"067b", "2303", Part::kSerial, "PL2303 serial adapter", "pl2303"},
    {"0483", "5740", Part::kSerial, "STM32 serial port", "cdc_acm"},
    {"1d50", "606f", Part::kCan, "candleLight CAN adapter", "gs_usb"},
    {"0c72", "00", Part::kCan, "PEAK CAN adapter", "peak_usb"},
    {"0bfd", "", Part::kCan, "Kvaser CAN adapter", "kvaser_usb"},
    {"0483", "37", Part::kProbe, "ST-LINK debug probe", "openocd"},
    {"0483", "df11", Part::kBootLoader, "STM32 boot loader (DFU)", "dfu-util"}};

const UsbDevice* known(const std::string& vendor, const std::string& product) {
  const auto* found =
      std::find_if(std::begin(kUsbDevices), std::end(kUsbDevices), [&](const UsbDevice& each) {
        return vendor == each.vendor && product.starts_with(each.product);
      });
  return found == std::end(kUsbDevices) ? nullptr : found;
}

/// Has the driver taken it? `folder`: in /sys.
bool has_driver(const Machine& machine, const std::string& folder, Part part) {
  const std::string name = folder.substr(folder.rfind('/') + 1);
  for (const std::string& interface : machine.list(folder, name + ":")) {
    if (part == Part::kCan && machine.exists(interface + "/net")) return true;
    if (part == Part::kSerial &&
        (machine.exists(interface + "/tty") || !machine.list(interface, "tty").empty())) {
      return true;
    }
  }
  return false;
}

void check_adapter(const Machine& machine, const std::string& folder, const UsbDevice& device,
                   Findings& found) {
  const std::string name = std::string(device.name) + " is plugged in";
  if (has_driver(machine, folder, device.part)) return found.good("USB", name);
  const auto programs = machine.programs();
  const bool braille =
      std::any_of(programs.begin(), programs.end(),
                  [](const RunningProgram& each) { return each.name == "brltty"; });
  if (device.part == Part::kSerial && braille) {
    return found.bad("USB", name + ", and brltty took it for a Braille display",
                     "sudo apt-get remove brltty  # then plug it in again");
  }
  found.bad("USB", name + ", and its driver is not loaded",
            fmt::format("sudo modprobe {}", device.driver));
}

std::string node_of(const Machine& machine, const std::string& folder) {
  const auto number = [&](const char* name) {
    return std::atoi(machine.first_line(folder + name).c_str());
  };
  return fmt::format("/dev/bus/usb/{:03}/{:03}", number("/busnum"), number("/devnum"));
}

void check_board(const Machine& machine, const std::string& folder, const UsbDevice& device,
                 Findings& found) {
  const std::string node = node_of(machine, folder);
  if (machine.exists(node) && !machine.may_use(node)) {
    return found.bad("board", fmt::format("{}: no permission for {}", device.name, node),
                     flash::udev_advice(device.part == Part::kProbe ? flash::Tool::kOpenocd
                                                                    : flash::Tool::kDfuUtil));
  }
  if (!machine.exists(fmt::format("/usr/bin/{}", device.driver))) {
    return found.bad("board", fmt::format("{}: {} is missing", device.name, device.driver),
                     fmt::format("sudo apt-get install {}", device.driver));
  }
  found.good("board", fmt::format("{}: {} can use it", device.name, device.driver));
}

void check_interface(const link::CanInterface& each, Findings& found) {
  const std::string down = link::down_trouble(each), advice = link::advice(each);
  if (!down.empty()) return found.bad(each.name, down);
  if (!advice.empty()) return found.advise(each.name, advice);
  found.good(each.name, each.bitrate == 0 ? "up" : fmt::format("up, {} bit/s", each.bitrate));
}

}  // namespace

bool check_device(const Machine& machine, const std::string& device, Findings& found) {
  if (!machine.may_use(device)) {
    found.bad(device, "no permission", machine.how_to_join(device));
    return false;
  }
  const auto holders = machine.holders(device);
  for (const RunningProgram& each : holders) {
    found.bad(device, fmt::format("{} (process {}) has it open", each.name, each.id),
              each.name == "ModemManager" ? "sudo systemctl disable --now ModemManager"
                                          : fmt::format("kill -INT {}", each.id));
  }
  const std::string slow =
      link::latency_advice(machine.at(device).string(), machine.at("/sys").string());
  if (!slow.empty()) {
    const std::size_t begin = slow.find(" keeps ") + 1, end = slow.find("; ");
    found.bad(device, slow.substr(begin, end - begin), slow.substr(slow.find("echo ")));
  }
  return holders.empty();
}

void check_serial_ports(const Machine& machine, Findings& found) {
  const std::size_t before = found.size();
  for (const char* kind : {"ttyUSB", "ttyACM", "ttyAMA"}) {
    for (const std::string& port : machine.list("/dev", kind)) {
      const std::size_t good = found.size();
      check_device(machine, port, found);
      if (found.size() == good) found.good(port, "can be opened");
    }
  }
  if (found.size() == before) found.good("serial ports", "none is plugged in");
}

void check_usb(const Machine& machine, Findings& found) {
  const std::size_t before = found.size();
  for (const std::string& folder : machine.list("/sys/bus/usb/devices")) {
    const UsbDevice* device =
        known(machine.first_line(folder + "/idVendor"), machine.first_line(folder + "/idProduct"));
    if (device == nullptr) continue;
    const bool adapter = device->part == Part::kSerial || device->part == Part::kCan;
    (adapter ? check_adapter : check_board)(machine, folder, *device, found);
  }
  if (found.size() > before) return;
  found.good("USB", "no adapter, probe or boot loader is plugged in");
}

void check_i2c(const Machine& machine, Findings& found) {
  const auto devices = machine.list("/dev", "i2c-");
  const bool buses = !machine.list("/sys/bus/i2c/devices", "i2c-").empty();
  for (const std::string& each : devices) {
    if (machine.may_use(each)) continue;
    return found.advise("I2C", "no permission for " + each + "; only an IMU at this PC needs it",
                        machine.how_to_join(each));
  }
  if (devices.empty() && buses) {
    return found.advise("I2C", "its buses are not in /dev; only an IMU at this PC needs one",
                        "sudo modprobe i2c-dev");
  }
  found.good("I2C", devices.empty() ? "no bus is here" : "all buses can be opened");
}

void check_can(const Machine& machine, Findings& found) {
  const std::size_t before = found.size();
  try {
    for (const link::CanInterface& each : machine.interfaces()) {
      if (each.is_can) check_interface(each, found);
    }
  } catch (const link::LinkError& error) {
    found.bad("CAN", error.what());
  }
  if (found.size() > before) return;
  const std::string modules = "/lib/modules/" + machine.first_line("/proc/sys/kernel/osrelease");
  const bool can = machine.exists("/sys/module/can") ||
                   machine.read(modules + "/modules.dep").find("/can.ko") != std::string::npos ||
                   machine.read(modules + "/modules.builtin").find("/can.ko") != std::string::npos;
  if (can) return found.good("CAN", "no CAN interface is here");
  found.advise("CAN", "this kernel has no CAN; only robots on CAN need it",
               "sudo apt-get install linux-image-$(dpkg --print-architecture)  # then restart");
}

}  // namespace verp::tool
