#include "host/apps/libverp/moment.hpp"

#include <map>
#include <mutex>

#include "common/control/guard.hpp"
#include "common/control/step.hpp"
#include "host/apps/libverp/failure.hpp"

namespace verp::abi {
namespace {

/// Moments that run now, on any thread.
struct Moments {
  std::mutex mutex;
  std::map<std::uint64_t, Moment*> running;
  std::uint64_t last = 0;
};

Moments& moments() {
  static Moments all;
  return all;
}

std::uint64_t next_token() {
  const std::lock_guard lock(moments().mutex);
  return ++moments().last;
}

}  // namespace

Moment::Moment(const Params& params, const action::Library& actions, State& state,
               const Inputs& inputs, Outputs& outputs)
    : params_(params),
      actions_(actions),
      state_(state),
      inputs_(inputs),
      outputs_(outputs),
      sent_(outputs),
      token_(next_token()) {
  const std::lock_guard lock(moments().mutex);
  moments().running.emplace(token_, this);
}

Moment::~Moment() {
  const std::lock_guard lock(moments().mutex);
  moments().running.erase(token_);
}

int Moment::run(verp_controller controller, void* user, std::uint32_t robot) {
  const verp_moment seen = {.size = sizeof(verp_moment),
                            .robot = robot,
                            .token = token_,
                            .inputs = reinterpret_cast<const verp_inputs*>(&inputs_),
                            .outputs = reinterpret_cast<verp_outputs*>(&outputs_)};
  try {
    return controller(&seen, user);
  } catch (const std::exception& error) {
    throw Failure(VERP_CALLBACK_FAILED, std::string("the controller threw: ") + error.what());
  } catch (...) {
    throw Failure(VERP_CALLBACK_FAILED, "the controller threw");
  }
}

void Moment::decide() {
  if (decided_) throw Failure(VERP_BAD_ARGUMENT, "it has decided this moment already");
  step(params_, actions_, state_, inputs_, outputs_);
  core_ = outputs_;
  decided_ = true;
}

void Moment::judge() {
  if (!decided_) step(params_, actions_, state_, inputs_, core_);
  control::guard(params_, inputs_, sent_, core_, outputs_);
}

}  // namespace verp::abi

int verp_decide(std::uint64_t token) {
  using namespace verp::abi;
  return call("verp_decide", [&] {
    Moment* moment = nullptr;
    {
      const std::lock_guard lock(moments().mutex);
      const auto found = moments().running.find(token);
      if (found != moments().running.end()) moment = found->second;
      // On another thread the moment could end first.
      if (moment != nullptr && moment->thread() != std::this_thread::get_id()) {
        throw Failure(VERP_BUSY,
                      "that moment is in the hands of a controller in another thread; "
                      "decide it there");
      }
    }
    if (moment == nullptr) {
      throw Failure(VERP_BAD_ARGUMENT,
                    "no controller is deciding the moment of this token; call it from inside one");
    }
    moment->decide();
  });
}
