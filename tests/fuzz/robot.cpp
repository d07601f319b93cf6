// A robot's file, SDF with our elements. What is accepted gives Params that the boot check accepts.
#include "common/model/image.hpp"
#include "host/robot/model/check.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::string path = VERP_SOURCE_DIR "/common/robots/generic21/fuzz.sdf";
  fuzz::refuses_only_by<model::LoadError>([&] { model::check_numbers(path, text); });
  fuzz::refuses_only_by<model::LoadError>([&] {
    const model::Entity entity = model::load_robot_text(path, text);
    model::describe_json(entity);
    ParamsImage image;
    image.params = model::make_params(entity);
    seal_image(image);
    fuzz::require(check_image(&image, sizeof image) == ImageFault::kNone,
                  "a robot that loads has sound Params");
  });
  return 0;
}
