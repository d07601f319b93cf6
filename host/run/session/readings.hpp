#pragma once
#include <cstdint>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"
#include "host/trace/record/trace_writer.hpp"
#include "host/twin/sim/probes.hpp"

namespace verp::session {

/// The frames of a robot's force-torque sensors, each on its link.
void place_frames(record::TraceWriter& trace, const model::Entity& entity, const Params& params);

/// What its force-torque, contact and truth sensors told by now, a channel for each. Messages stand
/// at `tick_ns`, which is now_us of the twin's time; their headers have when it was measured. What
/// was measured before the trace's beginning is left out.
void append(record::TraceWriter& trace, const model::Entity& entity,
            const sim::ProbeReadings& readings, std::uint64_t tick_ns, std::uint64_t now_us);

}  // namespace verp::session
