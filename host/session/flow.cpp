#include "host/session/flow.hpp"

#include <utility>

namespace verp::session {

Flow::~Flow() {
  if (!thread_.joinable()) return;
  unwinding_ = true;
  if (!ended_) hand_over();
  thread_.join();
}

bool Flow::resume() {
  if (ended_) return false;
  if (thread_.joinable()) {
    hand_over();
  } else {
    thread_ = std::thread([this] { run(); });
    back_.acquire();
  }
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return !ended_;
}

void Flow::hand_over() {
  go_.release();
  back_.acquire();
}

void Flow::run() {
  try {
    body_(*this);
  } catch (const Unwound&) {
  } catch (...) {
    error_ = std::current_exception();
  }
  ended_ = true;
  back_.release();
}

void Flow::pause() {
  if (unwinding_) return;  // called by a destructor
  back_.release();
  go_.acquire();
  if (unwinding_) throw Unwound{};
}

}  // namespace verp::session
