// Compiled into a user's controller.so (toolchains/own_controller.cmake), never into verp.
#include "host/run/own/module.hpp"

#include <new>

#include "controller.hpp"
#include "firmware/law/own_law.hpp"

namespace {

using Law = verp::app::OwnLaw<Controller>;

void* make() {
  return new (std::nothrow) Law;
}

void unmake(void* law) {
  delete static_cast<Law*>(law);
}

int decide(void* self, const verp::Params* params, verp::State* state, const verp::Inputs* inputs,
           verp::Outputs* outputs, std::int32_t* refused_count) {
  Law& law = *static_cast<Law*>(self);
  law(*params, *state, *inputs, *outputs);
  *refused_count = law.refused_count();
  return law.refused();
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const verp::own::Module verp_own_module;
const verp::own::Module verp_own_module = {sizeof(verp::Params),
                                           sizeof(verp::State),
                                           sizeof(verp::Inputs),
                                           sizeof(verp::Outputs),
                                           make,
                                           unmake,
                                           decide};
