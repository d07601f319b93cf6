#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

namespace verp::survey {

/// Who waits for a survey. Empty members are allowed; both are called, some 20 times a second, by
/// the thread that asked for the survey.
struct Watch {
  std::function<bool()> interrupted = {};  ///< true: what is done by then is all there will be
  std::function<void(double share)> went_on = {};  ///< how much of it is done, 0..1
  unsigned threads = 0;                            ///< 0: one for each core
};

/// Pieces of work on several threads. A walk is a session of its own, and has the same bits
/// whatever runs beside it; so what comes of the pieces does not depend on how many threads there
/// are.
class Workers {
 public:
  /// `steps`: how often step_done() will be called in all.
  Workers(const Watch& watch, std::size_t steps) : watch_(watch), steps_(steps) {}

  /// work(0) to work(pieces - 1), each once and in any order, and back when all are done. If one
  /// throws, no other one is begun, and what it threw goes on to the caller.
  void run(std::size_t pieces, const std::function<void(std::size_t piece)>& work);

  /// For the pieces: somebody interrupts, or another piece failed.
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
  std::size_t ended_ = 0;  ///< threads
  std::exception_ptr failure_;
};

}  // namespace verp::survey
