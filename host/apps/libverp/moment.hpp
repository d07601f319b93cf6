#pragma once
#include <thread>

#include "common/action/library.hpp"
#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "host/apps/libverp/verp.h"

namespace verp::abi {

/// One tick, passed to a user's controller. verp_decide() finds it by its token.
class Moment {
 public:
  Moment(const Params& params, const action::Library& actions, State& state, const Inputs& inputs,
         Outputs& outputs);
  ~Moment();
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;

  /// Returns the controller's status. Throws Failure if the controller throws.
  int run(verp_controller controller, void* user, std::uint32_t robot);
  void decide();
  /// After run(): the core decides if it has not, and the outputs become what the robot gets.
  void judge();
  bool decided() const { return decided_; }
  std::thread::id thread() const { return thread_; }

 private:
  const Params& params_;
  const action::Library& actions_;
  State& state_;
  const Inputs& inputs_;
  Outputs& outputs_;
  const Outputs sent_;  ///< in the previous tick
  Outputs core_;        ///< what the core decided in this one
  const std::uint64_t token_;
  const std::thread::id thread_ = std::this_thread::get_id();
  bool decided_ = false;
};

}  // namespace verp::abi
