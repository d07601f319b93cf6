#pragma once
#include <ucontext.h>

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>

namespace verp::session {

/// A coroutine for a foreign loop: its body runs only inside resume(), until its next pause(). It
/// has its own stack but runs in the caller's thread, so nothing runs concurrently. A switch costs
/// no more than two calls; with a thread it cost a scheduler turn, and four robots took 59 s for 13
/// s of work on a busy PC. Do not call pause() in an exception handler.
class Flow {
 public:
  explicit Flow(std::function<void(Flow&)> body) : body_(std::move(body)) {}
  /// Unwinds a body that has not ended: its pause() does not return.
  ~Flow();
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;

  /// Resumes the body. Rethrows its exception. False: it has ended.
  bool resume();
  /// Called by the body: suspends it until the next resume().
  void pause();
  /// Called by the body: runs `call` on the stack of resume()'s caller, for code that identifies
  /// its thread by the stack, as garbage-collected languages do. Rethrows the exception of `call`.
  void outside(const std::function<void()>& call);

 private:
  struct Unwound {};  // not a std::exception, so that no handler catches it

  /// Memory for a stack, committed on use, with a guard page below.
  class Stack {
   public:
    Stack();
    ~Stack();
    Stack(const Stack&) = delete;
    Stack& operator=(const Stack&) = delete;
    void* bottom() const;

   private:
    void* memory_;
  };

  static void enter(unsigned high, unsigned low);
  void begin();
  void run();
  void go();    ///< caller to body, until it pauses or ends
  void back();  ///< body to caller

  std::function<void(Flow&)> body_;
  std::unique_ptr<Stack> stack_;  ///< null: not begun
  ucontext_t here_{}, there_{};   ///< contexts of caller and body while suspended
  std::exception_ptr error_;
  const std::function<void()>* outside_ = nullptr;  ///< call that the body waits for
  bool ended_ = false, unwinding_ = false;
  // State for the address sanitizer's stack switches.
  void* fake_here_ = nullptr;
  void* fake_there_ = nullptr;
  const void* caller_bottom_ = nullptr;
  std::size_t caller_bytes_ = 0;
};

}  // namespace verp::session
