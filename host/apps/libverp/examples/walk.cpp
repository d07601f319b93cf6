// walk [SECONDS]: the walk of `verp walk`, and its digest.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "host/apps/libverp/verp.hpp"

int main(int argc, char** argv) {
  verp_robot robot = verp_lib::Session::defaults();
  if (argc > 1) robot.walk_s = std::atof(argv[1]);
  verp_lib::Session session;
  session.add(robot);
  while (session.tick(100)) {
  }
  const verp_result result = session.result();
  std::printf("%.2f m 0x%016" PRIx64 "\n", result.distance_m, result.digest);
  return result.failure[0] != '\0';
}
