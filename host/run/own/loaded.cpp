#include "host/run/own/loaded.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "common/model/counts.hpp"
#include "host/run/own/crash_words.hpp"
#include "host/run/own/module.hpp"

namespace verp::own {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

const Module& module_at(const void* place) {
  return *static_cast<const Module*>(place);
}

std::string refused(const std::string& folder, const Params& params, int joint, std::uint32_t tick,
                    std::int32_t count) {
  const JointParams& of = params.joint[joint];
  constexpr auto kNoNumber = INT32_MIN;
  const std::string goal = count == kNoNumber
                               ? "not a number"
                               : fmt::format("{} counts ({:.1f} degrees)", count,
                                             kDegrees * double{model::angle_of(of, count)});
  return fmt::format(
      "{}: at tick {} the controller's goal for {} is {}, and the joint goes from "
      "{:.1f} to {:.1f} degrees; mend controller.cpp",
      folder, tick, of.name, goal, kDegrees * double{of.lower_rad},
      kDegrees * double{of.upper_rad});
}

}  // namespace

Loaded::Loaded(const std::filesystem::path& folder, const std::filesystem::path& file)
    : folder_(folder.string()), library_(::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (library_ == nullptr) throw OwnError(fmt::format("{}: {}", folder_, ::dlerror()));
  module_ = ::dlsym(library_, "verp_own_module");
  const bool fits = module_ != nullptr && module_at(module_).params_bytes == sizeof(Params) &&
                    module_at(module_).state_bytes == sizeof(State) &&
                    module_at(module_).inputs_bytes == sizeof(Inputs) &&
                    module_at(module_).outputs_bytes == sizeof(Outputs);
  if (!fits) {
    ::dlclose(library_);
    throw OwnError(file.string() +
                   ": is no controller of this program's revision; remove the "
                   "folder build/ beside its sources");
  }
  name_crashes();
}

Loaded::~Loaded() {
  ::dlclose(library_);
}

session::Decide Loaded::controller(const std::shared_ptr<const Loaded>& loaded) {
  const Module& module = module_at(loaded->module_);
  const std::shared_ptr<void> self(module.make(),
                                   [loaded, &module](void* made) { module.unmake(made); });
  if (self == nullptr) throw OwnError(loaded->folder_ + ": no memory for a controller");
  return [loaded, &module, self](const Params& params, State& state, const Inputs& inputs,
                                 Outputs& outputs) {
    std::int32_t count = 0;
    int joint = 0;
    {
      const Inside inside(loaded->folder_.c_str(), inputs.tick);
      joint = module.decide(self.get(), &params, &state, &inputs, &outputs, &count);
    }
    if (joint >= 0) throw OwnError(refused(loaded->folder_, params, joint, inputs.tick, count));
  };
}

}  // namespace verp::own
