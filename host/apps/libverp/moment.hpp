#pragma once
#include <thread>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "host/apps/libverp/verp.h"

namespace verp::abi {

/// One tick in the hands of a user's controller. While it runs, verp_decide() finds it by its
/// token.
class Moment {
 public:
  Moment(const Params& params, State& state, const Inputs& inputs, Outputs& outputs);
  ~Moment();
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;

  /// What the controller gives. Throws Failure if it throws.
  int run(verp_controller controller, void* user, std::uint32_t robot);
  /// The core's own decision, once.
  void decide();
  bool decided() const { return decided_; }
  /// Where it runs, and lives no longer than that.
  std::thread::id thread() const { return thread_; }

 private:
  const Params& params_;
  State& state_;
  const Inputs& inputs_;
  Outputs& outputs_;
  const std::uint64_t token_;
  const std::thread::id thread_ = std::this_thread::get_id();
  bool decided_ = false;
};

}  // namespace verp::abi
