#include "host/twin/imu/imu_server.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/os/link/system_clock.hpp"
#include "host/twin/bus/assumed_imu.hpp"

namespace verp::imu {
namespace {

// The chip's units: 16 counts for a deg/s, 100 for a m/s^2 (BST-BNO055-DS000, tables 3-17, 3-22).
constexpr double kGyro_count_s_rad = 16 * 180 / std::numbers::pi, kAccel_count_s2_m = 100;
constexpr std::uint64_t kSample_us = 5'000;
constexpr std::uint32_t kTurn_us = 2'000;

std::int16_t to_count(double value) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -32768.0, 32767.0)));
}

}  // namespace

ImuServer::ImuServer(const std::string& link, const ImuParams& scale)
    : link_(link::parse_endpoint(link)),
      gyro_per_count_(kGyro_count_s_rad * static_cast<double>(scale.gyro_rad_s_per_count)),
      accel_per_count_(kAccel_count_s2_m * static_cast<double>(scale.accel_m_s2_per_count)) {
  hal::ImuSample upright;
  bus::AssumedImu(scale).read(upright);
  sim::ImuMeasurement at_rest;
  std::ranges::copy(upright.accel_count, at_rest.accel_count.begin());
  measured(at_rest);
  thread_ = std::thread([this] { serve(); });
}

ImuServer::~ImuServer() {
  over_ = true;
  thread_.join();
}

void ImuServer::measured(const sim::ImuMeasurement& twin) {
  constexpr std::array<std::int16_t, 3> kNone{};
  if (twin.accel_count == kNone && twin.gyro_count == kNone) return;  // its time has not begun
  const std::scoped_lock lock(mutex_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    newest_.gyro_count[axis] = to_count(gyro_per_count_ * twin.gyro_count[axis]);
    newest_.accel_count[axis] = to_count(accel_per_count_ * twin.accel_count[axis]);
  }
}

void ImuServer::serve() {
  const sched_param urgent{.sched_priority = 30};  // below the twin's own loop
  ::sched_setscheduler(0, SCHED_FIFO, &urgent);    // if permitted
  Bno055Model chip;
  Bno055Port port(chip);
  std::vector<std::uint8_t> answer;
  std::uint64_t next_us = 0;
  while (!over_) {
    std::uint8_t piece[64];
    const std::size_t count = link_.read(piece, sizeof piece, kTurn_us);
    const std::uint64_t now_us = link::monotonic_ns() / 1000;
    if (now_us >= next_us) {
      const std::scoped_lock lock(mutex_);
      chip.measure(newest_);
      next_us = now_us + kSample_us;
    }
    answer.clear();
    port.take({piece, count}, now_us, answer);
    link_.write(answer.data(), answer.size(), kTurn_us);
  }
}

}  // namespace verp::imu
