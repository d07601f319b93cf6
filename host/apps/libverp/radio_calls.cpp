#include <string>

#include "host/apps/libverp/air.hpp"
#include "host/apps/libverp/failure.hpp"
#include "host/apps/libverp/run.hpp"
#include "host/apps/libverp/sessions.hpp"

namespace verp::abi {
namespace {

constexpr std::uint64_t kMostBytes = 65'536;  // limit under any conditions

/// Runs `act` between ticks, or inside a controller.
template <class Act>
int with(verp_session session, Act&& act) {
  if (Run* run = Ticking::find(session)) return act(*run);
  const auto run = sessions().use(session);
  return act(*run);
}

Air& air_of(Run& run) {
  if (!run.air)
    throw Failure(VERP_BAD_ARGUMENT, "no robot has a radio; call verp_session_radio() before");
  if (!run.begun || run.ended)
    throw Failure(VERP_BAD_ARGUMENT, "robots talk from their first tick to the end of the run");
  return *run.air;
}

}  // namespace
}  // namespace verp::abi

using namespace verp::abi;

int verp_radio_defaults(verp_radio* radio) {
  return call("verp_radio_defaults", [&] {
    need(radio, "radio");
    const verp::radio::Conditions usual;
    *radio = {sizeof *radio,
              static_cast<std::uint32_t>(usual.most_bytes),
              static_cast<std::uint32_t>(usual.most_waiting),
              static_cast<std::uint32_t>(usual.overhead),
              1,
              usual.range_m,
              usual.loss,
              usual.fade,
              usual.fade_s,
              usual.delay_s,
              usual.jitter_s,
              usual.bytes_s};
  });
}

int verp_session_radio(verp_session session, const verp_radio* radio) {
  return call("verp_session_radio", [&] {
    need_struct(radio, "radio");
    const auto run = sessions().use(session);
    if (run->begun || run->ended)
      throw Failure(VERP_BAD_ARGUMENT, "robots get their radios before the first tick");
    if (run->air) throw Failure(VERP_BAD_ARGUMENT, "the robots have radios already");
    run->air.emplace(*radio);
  });
}

int verp_session_send(verp_session session, uint32_t robot, int32_t to, const void* data,
                      uint64_t size) {
  return call("verp_session_send", [&] {
    if (size > 0) need(data, "data");
    return with(session, [&](Run& run) {
      run.seat(robot);
      Air& air = air_of(run);
      // Avoids a copy of an invalid size.
      if (size > kMostBytes) {
        throw Failure(VERP_BAD_ARGUMENT,
                      "data is of " + std::to_string(size) + " bytes: no message has so many");
      }
      return air.send(run, robot, to, std::string(static_cast<const char*>(data), size));
    });
  });
}

int verp_session_take(verp_session session, uint32_t robot, void* data, uint64_t room,
                      uint64_t* size, uint32_t* from) {
  return call("verp_session_take", [&] {
    need(data, "data");
    need(size, "size");
    return with(session, [&](Run& run) {
      run.seat(robot);
      return air_of(run).take(robot, data, room, size, from);
    });
  });
}
