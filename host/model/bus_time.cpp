#include "host/model/bus_time.hpp"

#include "common/protocol/canopen/robot_load.hpp"
#include "firmware/app/schedule.hpp"

namespace verp::model {

BusTime bus_time(const Params& params) {
  namespace plan = canopen::plan;
  BusTime time;
  if (params.bus_protocol == BusProtocol::kCia402) {
    time.us = plan::tick_us(params);
    time.bits = plan::TickLoad(params, {}).bits(plan::TickKind::kSteady).all();
  } else {
    time.us = app::schedule_us(params);
    time.bytes = app::schedule_bytes(params);
    time.bits = 10 * time.bytes;
  }
  time.share = time.us / params.period_us;
  return time;
}

}  // namespace verp::model
