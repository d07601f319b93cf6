#pragma once
#include <exception>
#include <functional>
#include <semaphore>
#include <thread>

namespace verp::session {

/// Somebody else's loop, run piece by piece: its body runs only inside resume(), up to its next
/// pause(). It has a stack of its own (a thread), but nothing ever runs at the same time, so what
/// both sides use needs no lock and the order of all things is the callers'.
class Flow {
 public:
  explicit Flow(std::function<void(Flow&)> body) : body_(std::move(body)) {}
  /// A body that has not ended is unwound: its pause() does not come back.
  ~Flow();
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;

  /// Runs the body on. Throws what it threw. False: it has ended.
  bool resume();
  /// Called by the body: goes on at the next resume().
  void pause();

 private:
  struct Unwound {};  // no std::exception: nobody catches it on the way

  void run();
  void hand_over();

  std::function<void(Flow&)> body_;
  std::binary_semaphore go_{0}, back_{0};
  std::exception_ptr error_;
  bool ended_ = false, unwinding_ = false;
  std::thread thread_;
};

}  // namespace verp::session
