#include "host/study/survey/workers.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

namespace verp::survey {

void Workers::run(std::size_t pieces, const std::function<void(std::size_t piece)>& work) {
  const std::size_t most =
      watch_.threads > 0 ? watch_.threads : std::thread::hardware_concurrency();
  const std::size_t count = std::clamp<std::size_t>(most, 1, std::max<std::size_t>(pieces, 1));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < count; ++i) {
    threads.emplace_back([this, pieces, &work] { take(pieces, work); });
  }
  wait(count);
  for (std::thread& thread : threads) thread.join();
  if (failure_) std::rethrow_exception(failure_);
}

void Workers::take(std::size_t pieces, const std::function<void(std::size_t piece)>& work) {
  try {
    for (std::size_t piece; !stopped_ && (piece = next_++) < pieces;) work(piece);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    stopped_ = true;
  }
  const std::lock_guard lock(mutex_);
  ++ended_;
  changed_.notify_one();
}

void Workers::wait(std::size_t count) {
  std::unique_lock lock(mutex_);
  for (;;) {
    const bool all = ended_ == count;  // read first: the last report covers everything
    if (watch_.interrupted && watch_.interrupted()) stopped_ = true;
    const double steps = static_cast<double>(std::max<std::size_t>(steps_, 1));
    if (watch_.went_on) watch_.went_on(static_cast<double>(done_) / steps);
    if (all) return;
    changed_.wait_for(lock, std::chrono::milliseconds(50));
  }
}

}  // namespace verp::survey
