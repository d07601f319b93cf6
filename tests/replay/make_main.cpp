#include <cstdio>
#include <cstdlib>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/replay/trace_file.hpp"

/// replay_make FILE [TICKS]: makes generic21's long trace with this core.
int main(int count, char** argument) {
  using namespace verp;
  if (count < 2) {
    std::fprintf(stderr, "usage: replay_make FILE [TICKS]\n");
    return 2;
  }
  const Params robot = model::make_params(model::load_robot(model::find_model("generic21")));
  const std::uint32_t ticks =
      count > 2 ? static_cast<std::uint32_t>(std::atoi(argument[2])) : replay::kLongTraceTicks;
  if (replay::write_trace_file(argument[1], replay::make_long_trace(robot, ticks))) return 0;
  std::fprintf(stderr, "replay_make: %s: can't be written\n", argument[1]);
  return 1;
}
