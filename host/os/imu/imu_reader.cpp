#include "host/os/imu/imu_reader.hpp"

#include <sched.h>

#include <algorithm>

#include "host/os/link/system_clock.hpp"

namespace verp::imu {

ImuReader::~ImuReader() {
  over_ = true;
  if (thread_.joinable()) thread_.join();
}

void ImuReader::start(std::uint32_t pause_us, int priority) {
  thread_ = std::thread([this, pause_us, priority] {
    const sched_param wanted{.sched_priority = priority};
    ::sched_setscheduler(0, SCHED_FIFO, &wanted);
    std::uint64_t next_ns = link::monotonic_ns();
    while (!over_) {
      turn();
      next_ns = std::max(next_ns + std::uint64_t{pause_us} * 1000, link::monotonic_ns());
      link::sleep_until_ns(next_ns);
    }
  });
}

hal::ImuStatus ImuReader::turn() {
  hal::ImuMean fresh;
  std::uint64_t time_us = 0;
  const hal::ImuStatus status = collect_(fresh, time_us);
  const std::scoped_lock lock(mutex_);
  if (status == hal::ImuStatus::kFresh) {
    if (mean_.count() + fresh.count() > kMostSamples) mean_ = {};
    mean_.add(fresh);
    time_us_ = time_us;
  }
  status_ = status;
  return status;
}

hal::ImuStatus ImuReader::read(hal::ImuSample& sample) {
  const std::scoped_lock lock(mutex_);
  if (mean_.take(sample)) {
    sample.time_us = time_us_;
    return hal::ImuStatus::kFresh;
  }
  if (status_ != hal::ImuStatus::kFault) return hal::ImuStatus::kStale;
  ++faults_;
  return hal::ImuStatus::kFault;
}

}  // namespace verp::imu
