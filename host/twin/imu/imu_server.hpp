#pragma once
#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "common/model/params.hpp"
#include "host/os/link/link.hpp"
#include "host/twin/imu/bno055_model.hpp"
#include "host/twin/imu/bno055_port.hpp"

namespace verp::imu {

/// The twin's IMU as a BNO055 on a serial line. A thread answers, whatever the twin is busy with.
class ImuServer {
 public:
  /// `scale`: of the twin's counts. Throws what opening a link throws.
  ImuServer(const std::string& link, const ImuParams& scale);
  ~ImuServer();
  ImuServer(const ImuServer&) = delete;
  ImuServer& operator=(const ImuServer&) = delete;

  /// The newest counts of the twin. Before the first ones it stands upright.
  void measured(const sim::ImuMeasurement& twin);

 private:
  void serve();

  link::Link link_;
  const double gyro_per_count_, accel_per_count_;
  std::mutex mutex_;
  sim::ImuMeasurement newest_;  ///< guarded; in the chip's counts
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

}  // namespace verp::imu
