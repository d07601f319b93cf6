#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "hal/contract/imu.hpp"

namespace verp::imu {

/// Takes one step on the bus and adds what samples there are: a driver of hal/chip.
using Collect = std::function<hal::ImuStatus(hal::ImuMean& mean, std::uint64_t& time_us)>;

/// A chip on a slow bus as an Imu: a thread of its own collects, and read() never waits for the
/// bus.
class ImuReader {
 public:
  explicit ImuReader(Collect collect) : collect_(std::move(collect)) {}
  ~ImuReader();
  ImuReader(const ImuReader&) = delete;
  ImuReader& operator=(const ImuReader&) = delete;

  /// Collects every `pause_us` from now on. `priority`: SCHED_FIFO, where the system allows it; not
  /// below the reader's, which waits for this thread's copy of six sums.
  void start(std::uint32_t pause_us, int priority);
  /// Collects once; for a user without start().
  hal::ImuStatus turn();

  hal::ImuStatus read(hal::ImuSample& sample);
  std::uint32_t faults() const { return faults_; }
  /// The chip's last answer.
  hal::ImuStatus status() const { return status_; }

 private:
  /// More samples than that are of a pause, and dropped (hal::kImuMostPause_us).
  static constexpr std::int32_t kMostSamples = 64;

  Collect collect_;
  std::mutex mutex_;
  hal::ImuMean mean_;          ///< guarded
  std::uint64_t time_us_ = 0;  ///< guarded
  std::atomic<hal::ImuStatus> status_ = hal::ImuStatus::kStale;
  std::uint32_t faults_ = 0;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

static_assert(hal::Imu<ImuReader>);

}  // namespace verp::imu
