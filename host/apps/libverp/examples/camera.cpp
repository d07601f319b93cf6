// camera FILE.ppm [SECONDS]: walks through a room, writes the robot's last view to FILE and renders
// a picture of the robot.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numeric>

#include "host/apps/libverp/verp.hpp"

static double mean(const std::vector<std::uint8_t>& pixels) {
  return std::accumulate(pixels.begin(), pixels.end(), 0.0) / static_cast<double>(pixels.size());
}

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: camera FILE.ppm [SECONDS]\n"), 2;
  verp_robot robot = verp_lib::Session::defaults();
  if (argc > 2) robot.walk_s = std::atof(argv[2]);
  verp_lib::Session session("demo");
  session.add(robot);
  while (session.tick(100)) {
  }
  const auto seen = session.colour().value();
  const auto outside = session.render("follow", 320, 240);
  std::printf("%s: %ux%u at %.2f s, mean %.1f; from outside %.1f\n", session.cameras()[0].name,
              seen.width, seen.height, seen.time_s, mean(seen.pixels), mean(outside.pixels));
  std::ofstream(argv[1]) << "P6\n"
                         << seen.width << ' ' << seen.height << "\n255\n"
                         << std::string(seen.pixels.begin(), seen.pixels.end());
}
