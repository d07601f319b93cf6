// record FILE [SECONDS]: records a walk, and replays it bit for bit.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "host/apps/libverp/verp.hpp"

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: record FILE [SECONDS]\n"), 2;
  verp_robot robot = verp_lib::Session::defaults();
  robot.record = argv[1];
  if (argc > 2) robot.walk_s = std::atof(argv[2]);
  {
    verp_lib::Session session;
    session.add(robot);
    while (session.tick(100)) {
    }
  }  // closing the session completes the file
  const verp_lib::Replayed replayed = verp_lib::replay(argv[1]);
  std::printf("%" PRIu64 " ticks 0x%016" PRIx64 "\n", replayed.ticks, replayed.digest);
}
