// An SDF file of another maker, read and written again as URDF.
#include "host/author/plain_sdf/plain_sdf.hpp"
#include "host/robot/model/load_error.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const auto file = fuzz::in_file("robot.sdf", {reinterpret_cast<const char*>(data), size});
  fuzz::refuses_only_by<model::LoadError>([&] {
    mjcf::Robot robot = plain_sdf::read_robot(file.string());
    mjcf::urdf_of(robot, file.parent_path().string());
  });
  return 0;
}
