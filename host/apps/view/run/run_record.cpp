#include "host/apps/view/run/run_record.hpp"

#include <fmt/format.h>

#include "common/control/step.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::view {

void RunRecord::add(const session::Tick& tick) {
  const sim::Truth& truth = tick.seen.truth;
  const sim::Transform& body = truth.body_world;
  const Eigen::Quaterniond q(body.linear());
  const auto& p = body.translation();
  ticks_.push_back(
      {*tick.record, {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}}, truth.torque_n_m});
}

void RunRecord::note(const std::string& what) {
  if (!ticks_.empty()) ticks_.back().notes.push_back(what);
}

void RunRecord::save(const std::filesystem::path& file, const Params& params,
                     const record::mcap::StringMap& metadata,
                     const std::vector<std::uint32_t>& actions) const {
  record::TraceWriter writer(file, params, metadata, record::TraceOptions{.actions = actions});
  const action::Library library(actions.data(), 4 * actions.size());
  State state;
  Outputs outputs;
  for (const Kept& kept : ticks_) {
    step(params, library, state, kept.record.inputs, outputs);
    writer.append(kept.record, state, outputs, &kept.body, kept.effort_n_m);
    for (const std::string& what : kept.notes) writer.note(kept.record.inputs.tick, what);
  }
  writer.close({{"digest", fmt::format("0x{:016x}", state.digest.chain)}, {"failure", ""}});
}

}  // namespace verp::view
