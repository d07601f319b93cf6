#pragma once
#include <cstdint>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"
#include "host/trace/record/trace_writer.hpp"
#include "host/twin/sim/probes.hpp"

namespace verp::session {

/// Frames of force-torque sensors, relative to their links.
void place_frames(record::TraceWriter& trace, const model::Entity& entity, const Params& params);

/// New readings of force-torque, contact and truth sensors, one channel each. Messages are at
/// `tick_ns`; headers hold the measurement's time. Omits those from before the trace.
void append(record::TraceWriter& trace, const model::Entity& entity,
            const sim::ProbeReadings& readings, std::uint64_t tick_ns, std::uint64_t now_us);

}  // namespace verp::session
