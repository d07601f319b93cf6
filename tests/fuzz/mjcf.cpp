// An MJCF file, read and written again in both formats.
#include "host/author/mjcf/mjcf.hpp"
#include "host/robot/model/load_error.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const auto file = fuzz::in_file("robot.xml", {reinterpret_cast<const char*>(data), size});
  fuzz::refuses_only_by<model::LoadError>([&] {
    mjcf::Robot robot = mjcf::read_robot(file.string());
    mjcf::urdf_of(robot, file.parent_path().string());
    mjcf::mjcf_of(robot, file.parent_path().string());
  });
  return 0;
}
