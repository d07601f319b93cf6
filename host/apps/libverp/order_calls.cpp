#include <cmath>

#include "common/model/tuning_ranges.hpp"
#include "host/apps/libverp/failure.hpp"
#include "host/apps/libverp/robot_file.hpp"
#include "host/apps/libverp/sessions.hpp"
#include "host/apps/libverp/text.hpp"
#include "host/apps/libverp/velocity.hpp"

using namespace verp::abi;

namespace {

std::int16_t milli(double value, const char* name) {
  constexpr double kMost = 3.2;  // rad: range of head joints, and of 16 bits
  if (std::abs(finite(value, name)) <= kMost)
    return static_cast<std::int16_t>(std::lround(1e3 * value));
  throw Failure(VERP_BAD_ARGUMENT, std::string(name) + " may be -3.2 to 3.2");
}

/// The quantities exist once all robots are added.
verp::sim::Quantities& quantities_of(Run& run) {
  if (run.seats.empty())
    throw Failure(VERP_BAD_ARGUMENT, "nobody is in the world; call verp_session_add() before");
  run.begun = true;
  return run.session.quantities();
}

int intervene(verp_session session, const verp::session::Intervention& what) {
  const auto run = sessions().use(session);
  quantities_of(*run);
  if (run->ended) throw Failure(VERP_BAD_ARGUMENT, "the run has ended");
  run->session.robot(0).intervene(what);
  return VERP_OK;
}

}  // namespace

int verp_session_command(verp_session session, uint32_t robot, uint32_t request, double vx_m_s,
                         double vy_m_s, double wz_rad_s, double pan_rad, double tilt_rad) {
  return call("verp_session_command", [&] {
    if (request > VERP_GET_UP)
      throw Failure(VERP_BAD_ARGUMENT,
                    "request is none of VERP_RELAX, VERP_STAND, VERP_WALK, VERP_GET_UP");
    verp::Command command = velocity_of(vx_m_s, vy_m_s, wz_rad_s);
    command.request = static_cast<verp::Request>(request);
    command.head_pan_mrad = milli(pan_rad, "pan_rad");
    command.head_tilt_mrad = milli(tilt_rad, "tilt_rad");
    sessions().use(session)->seat(robot).orders().take(command);
  });
}

int verp_session_give_back(verp_session session, uint32_t robot) {
  return call("verp_session_give_back", [&] {
    const auto run = sessions().use(session);
    RobotInstance& seat = run->seat(robot);
    if (seat.own_orders())
      throw Failure(VERP_BAD_ARGUMENT, "nobody else gives this robot orders: its walk_s was 0");
    seat.orders().give_back();
  });
}

int verp_session_emergency_stop(verp_session session, uint32_t robot, int32_t pressed) {
  return call("verp_session_emergency_stop", [&] {
    sessions().use(session)->seat(robot).orders().press_emergency_stop(pressed != 0);
  });
}

int verp_session_tune(verp_session session, uint32_t robot, const char* name, double value) {
  return call("verp_session_tune", [&] {
    need_text(name, "name");
    const int id = tuning_id_of(name);
    const float number = tuning_value_for(id, name, value);
    sessions().use(session)->seat(robot).orders().write(id, number);
  });
}

int verp_session_tuning(verp_session session, uint32_t robot, const char* name, double* value) {
  return call("verp_session_tuning", [&] {
    need_text(name, "name");
    need(value, "value");
    const int id = tuning_id_of(name);
    const auto run = sessions().use(session);
    *value = static_cast<double>(tuning_value(run->seat(robot).tuning(), id));
  });
}

int verp_session_quantities(verp_session session, uint32_t* count) {
  return call("verp_session_quantities", [&] {
    need(count, "count");
    *count = static_cast<std::uint32_t>(quantities_of(*sessions().use(session)).all().size());
  });
}

int verp_session_quantity(verp_session session, uint32_t index, verp_quantity* quantity) {
  return call("verp_session_quantity", [&] {
    need_struct(quantity, "quantity");
    const auto run = sessions().use(session);
    const auto& all = quantities_of(*run).all();
    if (index >= all.size())
      throw Failure(VERP_BAD_ARGUMENT, "there are only " + std::to_string(all.size()));
    const verp::sim::Quantity& from = all[index];
    quantity->settable = from.settable();
    quantity->low = from.low;
    quantity->high = from.high;
    put_text(from.name, quantity->name);
    put_text(from.unit, quantity->unit);
    put_text(from.what, quantity->what);
  });
}

int verp_session_read(verp_session session, const char* quantity, double* value) {
  return call("verp_session_read", [&] {
    need_text(quantity, "quantity");
    need(value, "value");
    *value = quantities_of(*sessions().use(session)).read(quantity);
  });
}

int verp_session_set(verp_session session, const char* quantity, double value) {
  return call("verp_session_set", [&] {
    need_text(quantity, "quantity");
    verp::session::Intervention what;
    what.name = quantity;
    what.value = finite(value, "value");
    return intervene(session, what);
  });
}

int verp_session_push(verp_session session, const char* thing, double fx_n, double fy_n,
                      double fz_n, double for_s) {
  return call("verp_session_push", [&] {
    need_text(thing, "thing");
    constexpr double kLongest_s = 3600;
    if (!(for_s > 0 && for_s <= kLongest_s))
      throw Failure(VERP_BAD_ARGUMENT, "for_s may be above 0, to 3600");
    verp::session::Intervention what;
    what.kind = verp::session::Intervention::Kind::kPush;
    what.name = thing;
    what.force_world_n = {finite(fx_n, "fx_n"), finite(fy_n, "fy_n"), finite(fz_n, "fz_n")};
    what.for_s = for_s;
    return intervene(session, what);
  });
}
