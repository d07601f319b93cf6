#pragma once
#include "host/apps/libverp/handles.hpp"
#include "host/apps/libverp/run.hpp"

namespace verp::abi {

Handles<Run>& sessions();

/// A session that ticks on this thread: callers on this thread are its callbacks.
class Ticking {
 public:
  Ticking(verp_session session, Run& run) : session_(session), run_(run), before_(last()) {
    last() = this;
  }
  ~Ticking() { last() = before_; }
  Ticking(const Ticking&) = delete;
  Ticking& operator=(const Ticking&) = delete;

  /// Null: it does not tick on this thread.
  static Run* find(verp_session session);

 private:
  static Ticking*& last();
  const verp_session session_;
  Run& run_;
  Ticking* const before_;  ///< a callback may tick another session
};

}  // namespace verp::abi
