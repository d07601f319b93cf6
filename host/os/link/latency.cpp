#include "host/os/link/latency.hpp"

#include <filesystem>
#include <fstream>
#include <system_error>

namespace verp::link {
namespace {

std::string name_of(const std::string& device) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(device, error);
  return (error ? std::filesystem::path(device) : real).filename().string();
}

std::string timer_of(const std::string& device, const std::string& system_folder) {
  return system_folder + "/bus/usb-serial/devices/" + name_of(device) + "/latency_timer";
}

}  // namespace

std::optional<int> latency_timer_ms(const std::string& device, const std::string& system_folder) {
  std::ifstream file(timer_of(device, system_folder));
  int time_ms = 0;
  if (!(file >> time_ms)) return std::nullopt;
  return time_ms;
}

std::string latency_advice(const std::string& device, const std::string& system_folder) {
  const std::optional<int> time_ms = latency_timer_ms(device, system_folder);
  if (!time_ms || *time_ms <= 1) return "";
  return device + " keeps bytes back for " + std::to_string(*time_ms) +
         " ms; set 1: echo 1 | sudo tee " + timer_of(device, system_folder);
}

}  // namespace verp::link
