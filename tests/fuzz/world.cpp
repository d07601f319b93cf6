// A world's file.
#include "host/robot/model/load_world.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const auto file = fuzz::in_file("world.sdf", {reinterpret_cast<const char*>(data), size});
  fuzz::refuses_only_by<model::LoadError>([&] {
    const model::World world = model::load_world(file);
    model::describe(world);
    model::describe_json(world);
  });
  return 0;
}
