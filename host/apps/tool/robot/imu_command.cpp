#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "host/apps/cli/answers.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/tool/robot/setup_command.hpp"
#include "host/os/imu/imu_port.hpp"
#include "host/os/imu/mount.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/robot/model/servo_types.hpp"

namespace verp::tool {
namespace {

struct ImuWatchWords {
  std::string imu;
  double seconds = 2;
  bool mount = false, json = false;
};

using Axes = std::array<double, 3>;

/// The mean of some time, in the chip's axes.
struct Felt {
  Axes rate_deg_s{}, accel_m_s2{};
  int reads = 0;  ///< with a sample
};

Felt feel(imu::ImuPort& port, imu::Chip chip, double seconds) {
  const model::ImuType& type = *model::find_imu_type(imu::name_of(chip));
  const double deg_s = 180 / std::numbers::pi * type.gyro_rad_s_per_count;
  const std::uint64_t end_ns = link::monotonic_ns() + static_cast<std::uint64_t>(1e9 * seconds);
  hal::ImuSample sample;
  port.read(sample);  // of the time before
  Felt felt;
  while (link::monotonic_ns() < end_ns && !cli::interrupted()) {
    link::sleep_until_ns(link::monotonic_ns() + 10'000'000);
    if (port.read(sample) != hal::ImuStatus::kFresh) continue;
    ++felt.reads;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      felt.rate_deg_s[axis] += deg_s * sample.gyro_count[axis];
      felt.accel_m_s2[axis] += type.accel_m_s2_per_count * sample.accel_count[axis];
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    felt.rate_deg_s[axis] /= std::max(felt.reads, 1);
    felt.accel_m_s2[axis] /= std::max(felt.reads, 1);
  }
  return felt;
}

Felt require_felt(imu::ImuPort& port, const imu::ImuPlace& place, double seconds) {
  const Felt felt = feel(port, place.chip, seconds);
  if (felt.reads > 0) return felt;
  throw cli::ToolError(
      cli::kNoDevice,
      "verp bus imu: " + imu::to_text(place) +
          (cli::interrupted() ? ": interrupted" : ": it has fallen silent; check its cable"));
}

std::string to_text(const Axes& axes) {
  return fmt::format("{:8.2f} {:8.2f} {:8.2f}", axes[0], axes[1], axes[2]);
}

/// The words for the mounting, by two poses.
std::string ask_mount(imu::ImuPort& port, const imu::ImuPlace& place) {
  cli::Answers answers;
  Axes felt[2];
  const char* questions[] = {
      "Set the robot upright, hold it still and press Enter: ",
      "Tilt it forward by 20 to 60 degrees, hold it still and press Enter: "};
  for (int pose = 0; pose < 2; ++pose) {
    if (!answers.line(questions[pose]))
      throw cli::ToolError(cli::kBadInput, "verp bus imu: no answer; --mount asks for two poses");
    felt[pose] = require_felt(port, place, 1).accel_m_s2;
  }
  const imu::Mount mount = imu::find_mount(felt[0], felt[1]);
  constexpr double kAskew_rad = 0.2;
  if (!mount.words.empty() && mount.askew_rad < kAskew_rad) return mount.words;
  throw cli::ToolError(
      cli::kRunFailed,
      mount.words.empty()
          ? "verp bus imu: these poses do not tell the mounting; tilt it forward by 20 degrees "
            "or more"
          : fmt::format("verp bus imu: the chip is {:.0f} degrees askew of {}; turn it, or write "
                        "its pose into <verp:imu> of the robot's file",
                        180 / std::numbers::pi * mount.askew_rad, mount.words));
}

int run_imu(const ImuWatchWords& words) {
  const imu::ImuPlace place = imu::parse_imu(words.imu);
  imu::ImuPort port(place, [] { return cli::interrupted(); });
  port.start(1);
  if (words.mount) {
    const std::string found = ask_mount(port, place);
    if (words.json) {
      cli::print_json({{"mount", found}});
    } else {
      cli::answer(found + "\n");
    }
    return cli::kGood;
  }
  const Felt felt = require_felt(port, place, words.seconds);
  if (words.json) {
    cli::print_json({{"imu", imu::to_text(place)},
                     {"rate_deg_s", felt.rate_deg_s},
                     {"accel_m_s2", felt.accel_m_s2},
                     {"faults", port.faults()}});
  } else {
    cli::answer(fmt::format("{}: the mean of {:g} s along its x, y, z\n", imu::to_text(place),
                            words.seconds) +
                fmt::format("  rate          {} deg/s\n", to_text(felt.rate_deg_s)) +
                fmt::format("  acceleration  {} m/s^2\n", to_text(felt.accel_m_s2)));
  }
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_bus_imu(CLI::App& bus) {
  CLI::App* app = bus.add_subcommand("imu", "what an IMU at this PC measures, and its mounting");
  auto words = std::make_shared<ImuWatchWords>();
  app->add_option("--imu", words->imu,
                  "as for verp run: i2c:/dev/i2c-1,CHIP[,address=0x29] or serial:DEVICE,bno055")
      ->required();
  app->add_option("--for", words->seconds, "how long, s")
      ->transform(cli::number_between(0.1, 3600, "s"))
      ->capture_default_str();
  app->add_flag("--mount", words->mount,
                "asks for two poses of the robot and prints mount=... for --imu");
  cli::add_json_flag(*app, words->json);
  return {app, [words] {
            cli::catch_interrupts();
            return run_imu(*words);
          }};
}

}  // namespace verp::tool
