#include "host/run/shadow/identity.hpp"

#include <fmt/format.h>

#include "common/model/image.hpp"

namespace verp::shadow {

std::string why_another(const Params& params, std::uint32_t crc, std::uint32_t core_version) {
  if (core_version != kCoreVersion) {
    return fmt::format(
        "the controller's core is version {}, this PC's {}; build both from one "
        "revision",
        core_version, kCoreVersion);
  }
  if (crc == params_crc(params)) return "";
  return fmt::format(
      "the controller drives another robot: its Params have CRC {:08x}, those of {} "
      "{:08x}; name its model, with the words that `verp run` was given "
      "(--period, --imu, --cycle, --set), or give it this one",
      crc, params.name, params_crc(params));
}

}  // namespace verp::shadow
