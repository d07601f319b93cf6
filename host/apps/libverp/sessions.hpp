#pragma once
#include "host/apps/libverp/handles.hpp"
#include "host/apps/libverp/run.hpp"

namespace verp::abi {

Handles<Run>& sessions();

/// Marks a session that ticks on this thread. Until it ends, any caller on this thread is a
/// callback of that session.
class Ticking {
 public:
  Ticking(verp_session session, Run& run) : session_(session), run_(run), before_(last()) {
    last() = this;
  }
  ~Ticking() { last() = before_; }
  Ticking(const Ticking&) = delete;
  Ticking& operator=(const Ticking&) = delete;

  /// Null: the session does not tick on this thread.
  static Run* find(verp_session session);

 private:
  static Ticking*& last();
  const verp_session session_;
  Run& run_;
  Ticking* const before_;  ///< nested: a callback of one session may tick another
};

}  // namespace verp::abi
