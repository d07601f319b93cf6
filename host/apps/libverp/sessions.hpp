#pragma once
#include "host/apps/libverp/handles.hpp"
#include "host/apps/libverp/run.hpp"

namespace verp::abi {

/// All that are open.
Handles<Run>& sessions();

/// A call in this thread has a session tick. Until it returns, who calls in the same thread is a
/// callback of that session.
class Ticking {
 public:
  Ticking(verp_session session, Run& run) : session_(session), run_(run), before_(last()) {
    last() = this;
  }
  ~Ticking() { last() = before_; }
  Ticking(const Ticking&) = delete;
  Ticking& operator=(const Ticking&) = delete;

  /// Null: it does not tick here.
  static Run* find(verp_session session);

 private:
  static Ticking*& last();
  const verp_session session_;
  Run& run_;
  Ticking* const before_;  ///< a callback of one session may have another one tick
};

}  // namespace verp::abi
