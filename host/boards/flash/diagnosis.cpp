#include "host/boards/flash/diagnosis.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "host/boards/flash/tool_run.hpp"
#include "host/os/process/child.hpp"

namespace verp::flash {
namespace {

using Kind = FlashError::Kind;

/// A tool's text and its meaning, with {port} and {pins}.
struct Saying {
  const char* words;
  Kind kind;
  const char* meaning;
};

constexpr const char* kNoBootLoader =
    "no boot loader answers on {port}; hold BOOT0 high, press reset, and see that {pins} are "
    "crossed with the adapter's lines and grounds are joined";
constexpr const char* kReadoutProtected =
    "the chip is readout protected and lets nobody read, erase or write; `stm32flash -k {port}` "
    "lifts it and erases all of the flash";

// Debian 12's stm32flash 0.7.
constexpr Saying kStm32flash[] = {
    {"Failed to verify at address", Kind::kVerify,
     "the flash reads back differently from what was written: a sector is write protected (see "
     "`stm32flash -u {port}`) or worn out"},
    {"Got NACK from device on command 0x11", Kind::kProtected, kReadoutProtected},
    {"Got NACK from device on command 0x44", Kind::kProtected, kReadoutProtected},
    {"Got NACK from device on command 0x31", Kind::kProtected, kReadoutProtected},
    {"Unknown/unsupported device", Kind::kWrongChip,
     "stm32flash does not know the chip on {port}; is it the right board?"},
    {"Failed to init device", Kind::kNoDevice, kNoBootLoader},
    {"Failed to send init to device", Kind::kNoDevice, kNoBootLoader},
    {"Failed to resend init to device", Kind::kNoDevice, kNoBootLoader},
    {"Failed to set terminal flags", Kind::kUsage,
     "{port} has no even parity, which the boot loader speaks; use another serial adapter"},
    {"Failed to open port", Kind::kBusy,
     "{port} cannot be opened; end what else uses it, `fuser -v {port}` names it"},
    {"rase failed", Kind::kRefused,
     "the chip did not erase; press reset with BOOT0 high, check the supply, and flash again"},
    {"Failed to erase", Kind::kRefused,
     "the chip did not erase; press reset with BOOT0 high, check the supply, and flash again"},
    {"Failed to write memory", Kind::kRefused,
     "the chip refused a write; press reset with BOOT0 high, check the supply, and flash again"},
    {"Failed to read memory", Kind::kRefused,
     "the chip refused a read; press reset with BOOT0 high and flash again"},
};

// Debian 12's openocd 0.12.0.
constexpr Saying kOpenocd[] = {
    {"LIBUSB_ERROR_ACCESS", Kind::kPermission, "no permission to open the debug probe"},
    {"LIBUSB_ERROR_BUSY", Kind::kBusy,
     "another program has the debug probe; end it (a debugger, another openocd)"},
    {"Error: open failed", Kind::kNoDevice,
     "no debug probe found; plug the ST-LINK in (`lsusb` should show 0483:37..), or give "
     "--tool stm32flash --port /dev/ttyUSB0"},
    {"serial mismatch", Kind::kNoDevice,
     "no debug probe of that serial number; leave --port out, or see `lsusb -v -d 0483:`"},
    {"checksum mismatch", Kind::kVerify,
     "the flash reads back differently from what was written; flash again, and check the supply"},
    {"contents differ", Kind::kVerify,
     "the flash reads back differently from what was written; flash again, and check the supply"},
    {"Verify Failed", Kind::kVerify,
     "the flash reads back differently from what was written; flash again, and check the supply"},
    {"device protected", Kind::kProtected,
     "the chip is readout protected; OpenOCD's `stm32f2x unlock 0` lifts it and erases all of the "
     "flash"},
    {"unable to connect to the target", Kind::kNoDevice,
     "the probe is there but no chip answers; power the board and check SWDIO, SWCLK and ground"},
    {"Could not find MEM-AP", Kind::kNoDevice,
     "the probe is there but no chip answers; power the board and check SWDIO, SWCLK and ground"},
    {"arget not examined", Kind::kNoDevice,
     "the probe is there but no chip answers; power the board and check SWDIO, SWCLK and ground"},
    {"LIBUSB_ERROR_NO_DEVICE", Kind::kLost,
     "the debug probe went away; plug it in and flash again"},
    {"Can't find interface/", Kind::kNoTool,
     "openocd has no configuration of this probe; install it anew: sudo apt-get install "
     "--reinstall openocd"},
};

// Debian 12's dfu-util 0.11.
constexpr const char* kNoDfu =
    "no USB device in DFU mode; hold BOOT0 high (OpenCR: its BOOT button), press reset, and check "
    "the cable (`lsusb` should show 0483:df11)";
constexpr Saying kDfuUtil[] = {
    {"LIBUSB_ERROR_ACCESS", Kind::kPermission, "no permission to open the USB device"},
    {"LIBUSB_ERROR_BUSY", Kind::kBusy, "another program has the USB device; end it"},
    {"No DFU capable USB device", Kind::kNoDevice, kNoDfu},
    {"More than one DFU capable", Kind::kUsage,
     "several boards are in DFU mode; give the serial number of one, as `dfu-util -l` shows it, "
     "with --port"},
    {"LIBUSB_ERROR_NO_DEVICE", Kind::kLost,
     "the USB device went away; plug it in with BOOT0 high and flash again"},
    {"LIBUSB_ERROR_IO", Kind::kLost,
     "the USB device went away; plug it in with BOOT0 high and flash again"},
    {"vendor specific error", Kind::kProtected,
     "the chip refuses, as one that is readout protected does; `dfu-util -a 0 -s :unprotect:force "
     "-D FILE` lifts that and erases all of the flash"},
    {"not writeable", Kind::kRefused,
     "the chip does not let this page be written; is it the right "
     "board?"},
};

std::string filled(std::string text, const Job& job) {
  const std::pair<std::string, std::string> values[] = {{"{port}", job.port},
                                                        {"{pins}", job.recipe.serial_pins}};
  for (const auto& [name, value] : values) {
    for (std::size_t at; (at = text.find(name)) != text.npos;) text.replace(at, name.size(), value);
  }
  return text;
}

template <std::size_t kCount>
const Saying* find(const Saying (&sayings)[kCount], const std::string& output) {
  for (const Saying& saying : sayings) {
    if (output.find(saying.words) != output.npos) return &saying;
  }
  return nullptr;
}

const Saying* saying_of(Tool tool, const std::string& output) {
  switch (tool) {
    case Tool::kOpenocd:
      return find(kOpenocd, output);
    case Tool::kStm32flash:
      return find(kStm32flash, output);
    case Tool::kDfuUtil:
      return find(kDfuUtil, output);
  }
  return nullptr;
}

std::string aftermath(const Step& step) {
  const bool wrote = step.kind == Step::Kind::kWrite || step.kind == Step::Kind::kReadBack ||
                     step.kind == Step::Kind::kCompare;
  return wrote ? "; the flash is not to be used before it is flashed again" : "";
}

bool port_is_gone(const Job& job) {
  return job.tool == Tool::kStm32flash && !std::filesystem::exists(job.port);
}

FlashError wrong_chip(const Job& job, const std::string& found) {
  return {Kind::kWrongChip,
          fmt::format("{}: the chip is no {}: {}; is another board connected? Nothing was written",
                      job.recipe.board, job.recipe.chip->name, found)};
}

}  // namespace

std::string udev_advice(Tool tool) {
  const char* rule =
      tool == Tool::kStm32flash
          ? R"(KERNEL=="ttyUSB[0-9]*|ttyACM[0-9]*", MODE="0660", GROUP="dialout", TAG+="uaccess")"
          : R"(SUBSYSTEM=="usb", ATTRS{idVendor}=="0483", MODE="0660", GROUP="plugdev", TAG+="uaccess")";
  return fmt::format(
      "as root put this line into /etc/udev/rules.d/60-verp.rules: {} and run: udevadm control "
      "--reload, then plug it in again",
      rule);
}

void check_chip(const Job& job, const std::string& output) {
  if (job.tool == Tool::kDfuUtil) {
    constexpr const char* kFlash = "@Internal Flash";
    const std::size_t at = output.find(kFlash);
    if (at == output.npos)
      throw diagnose(job, {}, output + "\nNo DFU capable USB device available");
    const std::string layout = output.substr(at, output.find('"', at) - at);
    const std::string expected = dfu_layout(*job.recipe.chip);
    if (layout.ends_with("/" + expected)) return;
    throw wrong_chip(job, fmt::format("its sectors are {}, not {}",
                                      layout.substr(layout.rfind('/') + 1), expected));
  }
  const std::size_t at = output.find("Device ID");
  const std::size_t number = at == output.npos ? at : output.find("0x", at);
  if (number == output.npos) {
    throw FlashError(Kind::kOther,
                     fmt::format("{}: {} did not tell the chip's identifier; its last words: {}",
                                 job.recipe.board, name_of(job.tool), process::last_line(output)));
  }
  const unsigned long found = std::strtoul(output.c_str() + number, nullptr, 16);
  if (found == job.recipe.chip->device_id) return;
  throw wrong_chip(
      job, fmt::format("device id {:#05x}, not {:#05x}", found, job.recipe.chip->device_id));
}

FlashError diagnose(const Job& job, const Step& step, const std::string& output) {
  const std::string board = std::string(job.recipe.board) + ": ";
  if (port_is_gone(job)) {
    return {Kind::kLost, board + job.port +
                             " is gone, cable pulled?; plug it in, press reset with "
                             "BOOT0 high, and flash again" +
                             aftermath(step)};
  }
  if (step.kind == Step::Kind::kCompare) {
    return {Kind::kVerify,
            board +
                "the flash reads back differently from what was written; flash again, and check "
                "the supply" +
                aftermath(step)};
  }
  const Saying* saying = saying_of(job.tool, output);
  if (saying == nullptr || step.kind == Step::Kind::kCompose) {
    return {Kind::kOther, fmt::format("{}{} failed; {} says: {}{}", board, step.label,
                                      step.command.empty() ? "" : step.command[0],
                                      process::last_line(output), aftermath(step))};
  }
  std::string text = filled(saying->meaning, job);
  if (saying->kind == Kind::kPermission) text += "; " + udev_advice(job.tool);
  return {saying->kind, board + text + aftermath(step)};
}

}  // namespace verp::flash
