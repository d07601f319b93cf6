#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

namespace verp::survey {

/// Members may be empty; called in the caller's thread, about 20 times a second.
struct Watch {
  std::function<bool()> interrupted = {};          ///< true: return what is done
  std::function<void(double share)> went_on = {};  ///< share done, 0..1
  unsigned threads = 0;                            ///< 0: one per core
};

/// Pieces of work on several threads. Their number does not matter: each walk is its own session
/// with the same bits.
class Workers {
 public:
  /// `steps`: calls to step_done().
  Workers(const Watch& watch, std::size_t steps) : watch_(watch), steps_(steps) {}

  /// Calls work(0) to work(pieces - 1), once each, in any order. If one throws, starts no other and
  /// rethrows.
  void run(std::size_t pieces, const std::function<void(std::size_t piece)>& work);

  /// For the pieces: the caller interrupted, or another piece failed.
  bool stopped() const { return stopped_; }
  void step_done() { ++done_; }

 private:
  void take(std::size_t pieces, const std::function<void(std::size_t piece)>& work);
  void wait(std::size_t count);

  const Watch& watch_;
  const std::size_t steps_;
  std::atomic<std::size_t> next_ = 0, done_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t ended_ = 0;  ///< threads that returned
  std::exception_ptr failure_;
};

}  // namespace verp::survey
