#include "host/boards/board/qemu.hpp"

#include <cstdlib>
#include <system_error>
#include <thread>

#include "host/boards/board/board_error.hpp"
#include "host/os/files/whole.hpp"

namespace verp::board {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(2);

}  // namespace

std::vector<std::string> QemuProcess::command(const Launch& launch) {
  const char* other = std::getenv("VERP_QEMU");
  std::string semihosting = "enable=on,target=native,arg=" + launch.image.filename().string();
  for (const std::string& argument : launch.arguments) semihosting += ",arg=" + argument;
  if (!launch.console.empty()) semihosting += ",chardev=" + launch.console;
  std::vector<std::string> command = {other != nullptr ? other : launch.board.program,
                                      "-M",
                                      launch.board.machine,
                                      "-display",
                                      "none",
                                      "-monitor",
                                      "none",
                                      "-semihosting-config",
                                      semihosting,
                                      launch.board.image_option,
                                      launch.board.image_prefix + launch.image.string()};
  command.insert(command.end(), launch.board.options.begin(), launch.board.options.end());
  const auto add = [&](const std::string& option, const std::string& value) {
    command.push_back(option);
    command.push_back(value);
  };
  if (launch.serial_ports.empty()) add("-serial", "none");
  for (const auto& port : launch.serial_ports) {
    add("-serial", "unix:" + port.string() + ",server=on,wait=off");
  }
  if (!launch.plugin.empty()) add("-plugin", launch.plugin);
  if (!launch.can_interface.empty()) {
    add("-object", "can-bus,id=can0_bus");
    add("-object", "can-host-socketcan,id=can0_host,canbus=can0_bus,if=" + launch.can_interface);
    command.insert(command.end(), launch.board.can.begin(), launch.board.can.end());
  }
  command.insert(command.end(), launch.options.begin(), launch.options.end());
  return command;
}

QemuProcess::QemuProcess(const Launch& launch) : name_(launch.image.filename().string()) {
  setenv("QEMU_AUDIO_DRV", "none", 1);  // QEMU must not search for a sound card
  const std::vector<std::string> words = command(launch);
  try {
    child_.emplace(process::Command{
        .words = words, .input = {}, .output = {.file = directory_.path() / "output"}});
  } catch (const std::system_error& error) {
    throw BoardError(words[0] + ": can't start the emulator (" + error.code().message() +
                     "); install it: apt-get install " + launch.board.package);
  }
}

int QemuProcess::wait(std::chrono::seconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  while (!poll_status()) {
    if (std::chrono::steady_clock::now() > deadline) {
      throw BoardError(described("still running after " + std::to_string(limit.count()) + " s"));
    }
    std::this_thread::sleep_for(kPollInterval);
  }
  return *poll_status();
}

void QemuProcess::wait_for_success(std::chrono::seconds limit) {
  const int status = wait(limit);
  if (status != 0) throw BoardError(described("ended with status " + std::to_string(status)));
}

std::string QemuProcess::output() const {
  return files::read(directory_.path() / "output").value_or("");
}

std::string QemuProcess::described(const std::string& what) const {
  std::string words = output();
  while (!words.empty() && words.back() == '\n') words.pop_back();
  const std::size_t last_line = words.rfind('\n');
  if (last_line != std::string::npos) words.erase(0, last_line + 1);
  return name_ + ": " + what + "; its last words: " + (words.empty() ? "none" : words);
}

}  // namespace verp::board
