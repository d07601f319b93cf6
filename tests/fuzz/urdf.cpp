// A URDF file, included by a robot's file of ours: tests/host/model/odd_robot.
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace {

std::string wrapper() {
  std::ifstream in(VERP_SOURCE_DIR "/tests/host/model/odd_robot/robot.sdf");
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  static const std::string robot = fuzz::in_file("robot.sdf", wrapper()).string();
  fuzz::in_file("odd.urdf", {reinterpret_cast<const char*>(data), size});
  fuzz::refuses_only_by<model::LoadError>(
      [&] { model::make_params(model::load_robot_on_any_bus(robot, "")); });
  return 0;
}
