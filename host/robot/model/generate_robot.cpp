#include <cstdio>

#include "host/robot/model/load_error.hpp"
#include "host/robot/model/robot_table.hpp"

/// verp_generate_robot TABLE: prints the robot's SDF. Exit status 0, or 2 with one line of error.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: verp_generate_robot TABLE > robot.sdf\n", stderr);
    return 2;
  }
  try {
    verp::model::RobotTable table(argv[1]);
    const std::string sdf = verp::model::generate_sdf(table);
    table.require_all_read();
    std::fputs(sdf.c_str(), stdout);
  } catch (const verp::model::LoadError& error) {
    std::fprintf(stderr, "verp_generate_robot: %s\n", error.what());
    return 2;
  }
  return 0;
}
