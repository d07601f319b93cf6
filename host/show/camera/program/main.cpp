#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

#include "host/show/camera/program/drawer.hpp"
#include "host/show/camera/wire.hpp"

namespace {

using namespace verp::camera;

constexpr int kSocket = STDIN_FILENO;

std::uint64_t processor_us() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto us = [](const timeval& time) {
    return std::uint64_t{1'000'000} * static_cast<std::uint64_t>(time.tv_sec) +
           static_cast<std::uint64_t>(time.tv_usec);
  };
  return us(used.ru_utime) + us(used.ru_stime);
}

bool answer(Drawer& drawer, const Moment& moment) {
  for (const std::uint32_t camera : moment.cameras) {
    for (const Picture& picture : drawer.draw(moment, camera)) {
      if (!send(kSocket, Kind::kPicture, pack(picture))) return false;
    }
  }
  return send(kSocket, Kind::kDone, pack(processor_us()));
}

bool answer(Drawer& drawer, const Moment& moment, const Outside& from) {
  Picture picture;
  try {
    picture = drawer.draw(moment, from);
  } catch (const std::invalid_argument& error) {
    return send(kSocket, Kind::kRefused, error.what());
  }
  return send(kSocket, Kind::kPicture, pack(picture)) &&
         send(kSocket, Kind::kDone, pack(processor_us()));
}

bool answer(Drawer& drawer, const Message& message) {
  if (message.kind == Kind::kOutside) {
    const auto both = unpack_outside(message.data);
    return both && answer(drawer, both->first, both->second);
  }
  const auto moment = unpack_moment(message.data);
  return moment && answer(drawer, *moment);
}

void serve() {
  const auto first = receive(kSocket);
  if (!first || first->kind != Kind::kStage) return;
  const auto stage = unpack_stage(first->data);
  if (!stage)
    throw std::runtime_error("the program that draws is of another build than who asks it");
  Drawer drawer(*stage);
  if (!send(kSocket, Kind::kReady, "")) return;
  while (const auto message = receive(kSocket)) {
    if (!answer(drawer, *message)) return;
  }
}

}  // namespace

/// Draws for camera::Rig: reads a stage and moments from standard input's socket; answers with
/// pictures.
int main() {
  // One core at low priority: the run goes first.
  ::setenv("LP_NUM_THREADS", "0", 0);
  ::setpriority(PRIO_PROCESS, 0, 5);
  try {
    serve();
    return 0;
  } catch (const std::exception& error) {
    send(kSocket, Kind::kFailed, error.what());
    return 1;
  }
}
