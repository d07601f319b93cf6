#pragma once
#include <cstdint>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"
#include "host/trace/record/trace_writer.hpp"
#include "host/twin/sim/probes.hpp"

namespace verp::session {

/// Records the frames of a robot's force-torque sensors, relative to their links.
void place_frames(record::TraceWriter& trace, const model::Entity& entity, const Params& params);

/// Records new readings of force-torque, contact and truth sensors, one channel each. Messages are
/// at `tick_ns`, which is now_us of the twin's time; their headers hold the time of measurement.
/// Omits measurements from before the trace.
void append(record::TraceWriter& trace, const model::Entity& entity,
            const sim::ProbeReadings& readings, std::uint64_t tick_ns, std::uint64_t now_us);

}  // namespace verp::session
