// A robot's table of proportions.
#include "host/robot/model/robot_table.hpp"

#include "host/robot/model/load_error.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const auto file = fuzz::in_file("robot.table", {reinterpret_cast<const char*>(data), size});
  fuzz::refuses_only_by<model::LoadError>([&] {
    model::RobotTable table(file);
    model::generate_sdf(table);
    table.require_all_read();
  });
  return 0;
}
