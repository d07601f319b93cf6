// A xacro file, expanded.
#include "host/author/xacro/xacro.hpp"
#include "host/robot/model/load_error.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const auto file = fuzz::in_file("robot.xacro", {reinterpret_cast<const char*>(data), size});
  fuzz::refuses_only_by<model::LoadError>(
      [&] { xacro::expand(file.string(), file.parent_path().string()); });
  return 0;
}
