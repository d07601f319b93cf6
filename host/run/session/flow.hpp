#pragma once
#include <ucontext.h>

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>

namespace verp::session {

/// Somebody else's loop, run piece by piece: its body runs only inside resume(), up to its next
/// pause(). It has a stack of its own and runs in the thread of whoever resumes it: nothing ever
/// runs at the same time, and going there and back costs no more than two calls. (With a thread
/// each way took a turn of the scheduler: four robots took 59 s for 13 s of work on a busy PC.) Not
/// to be paused in an exception's handler.
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
  /// Called by the body: has this called on the stack of whoever resumed, which is for code that
  /// knows its thread by its stack, as languages with a garbage collector do. Throws what it threw.
  void outside(const std::function<void()>& call);

 private:
  struct Unwound {};  // no std::exception: nobody catches it on the way

  /// Memory for a stack, of which only what is used is ever there, and a page that nobody may touch
  /// below.
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
  void go();    ///< from the caller into the body, until that pauses or ends
  void back();  ///< from the body to its caller

  std::function<void(Flow&)> body_;
  std::unique_ptr<Stack> stack_;  ///< null: not begun
  ucontext_t here_{}, there_{};   ///< of the caller and of the body, while the other one runs
  std::exception_ptr error_;
  const std::function<void()>* outside_ = nullptr;  ///< the body waits for it
  bool ended_ = false, unwinding_ = false;
  // What the address sanitizer wants to know of a change of stacks.
  void* fake_here_ = nullptr;
  void* fake_there_ = nullptr;
  const void* caller_bottom_ = nullptr;
  std::size_t caller_bytes_ = 0;
};

}  // namespace verp::session
