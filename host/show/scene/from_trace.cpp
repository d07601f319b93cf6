#include "host/show/scene/from_trace.hpp"

#include <algorithm>
#include <cmath>

#include "common/control/step.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/show/scene/body_track.hpp"
#include "host/show/scene/measured.hpp"
#include "host/show/scene/object_track.hpp"
#include "host/show/scene/params_entity.hpp"
#include "host/show/scene/plan_marks.hpp"
#include "host/twin/sim/body.hpp"
#include "host/twin/sim/planned_zmp.hpp"

namespace verp::scene {
namespace {

constexpr std::size_t kEvery = 125;  // between States: most that a seek recomputes

bool is_same_robot(const Entity& entity, const Params& params) {
  if (entity.joints.size() != params.joint_count) return false;
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    if (entity.joints[j].name != text_of(params.joint[j].name)) return false;
  }
  return true;
}

}  // namespace

struct TracePlayer::Film {
  record::Trace trace;
  Entity entity;
  std::string note;
  std::vector<State> states;  ///< before every kEvery-th tick
  std::vector<Transform> bodies;
  std::optional<model::World> world;
  std::optional<ObjectTrack> objects;

  explicit Film(const std::filesystem::path& file) : trace(record::read_trace(file)) {
    find_entity();
    find_world();
    const TickPoses poses(entity, trace.params);
    BodyTrack track(trace, poses);
    const action::Library actions = trace.library();
    State state = trace.start();
    Outputs outputs;
    for (std::size_t i = 0; i < trace.ticks.size(); ++i) {
      if (i % kEvery == 0) states.push_back(state);
      step(trace.params, actions, state, trace.ticks[i].inputs, outputs);
      bodies.push_back(track.at(i, state, outputs));
    }
  }

  void find_entity() {
    const std::string name = text_of(trace.params.name);
    const auto named = trace.metadata.find("model_file");
    for (const std::string& file : {named == trace.metadata.end() ? "" : named->second, name}) {
      if (file.empty()) continue;
      try {
        entity = model::load_robot_on_any_bus(model::find_model(file), "");
        if (is_same_robot(entity, trace.params)) return;
      } catch (const model::LoadError&) {  // try the next file
      }
    }
    note = trace.file.string() + ": there is no robot file with the joints of '" + name +
           "': drawn from the controller's numbers, without its looks";
    entity = entity_of(trace.params);
  }

  void find_world() {
    const auto named = trace.metadata.find("world_file");
    if (named == trace.metadata.end() || named->second.empty()) return;
    try {
      world = model::load_world(model::find_world(named->second));
      objects.emplace(trace, *world);
    } catch (const model::LoadError& error) {
      note += (note.empty() ? "" : "; ") + std::string(error.what()) + "; drawn without its world";
    }
  }

  void run_to(std::size_t index, State& state, Outputs& outputs) const {
    const action::Library actions = trace.library();
    state = states[index / kEvery];
    for (std::size_t i = index - index % kEvery; i <= index; ++i) {
      step(trace.params, actions, state, trace.ticks[i].inputs, outputs);
    }
  }
};

TracePlayer::TracePlayer(const std::filesystem::path& file) : film_(std::make_unique<Film>(file)) {
  if (film_->trace.ticks.empty()) {
    throw record::TraceError(file, "holds no tick", "give the trace of a longer run");
  }
}

TracePlayer::~TracePlayer() = default;

const record::Trace& TracePlayer::trace() const {
  return film_->trace;
}
const Entity& TracePlayer::entity() const {
  return film_->entity;
}
const model::World* TracePlayer::world() const {
  return film_->world ? &*film_->world : nullptr;
}
const std::string& TracePlayer::note() const {
  return film_->note;
}
std::size_t TracePlayer::size() const {
  return film_->trace.ticks.size();
}
double TracePlayer::begin_s() const {
  return film_->trace.ticks.front().inputs.tick * film_->trace.period_s();
}
double TracePlayer::end_s() const {
  return film_->trace.ticks.back().inputs.tick * film_->trace.period_s();
}

std::size_t TracePlayer::index_at(double t_s) const {
  const auto& ticks = film_->trace.ticks;
  const double period_s = film_->trace.period_s();
  const auto after = std::upper_bound(
      ticks.begin(), ticks.end(), t_s + 1e-9,
      [&](double at_s, const TickRecord& tick) { return at_s < tick.inputs.tick * period_s; });
  return after == ticks.begin() ? 0 : static_cast<std::size_t>(after - ticks.begin()) - 1;
}

void TracePlayer::controller_at(std::size_t index, State& state, Outputs& outputs) const {
  film_->run_to(std::min(index, film_->trace.ticks.size() - 1), state, outputs);
}

Snapshot TracePlayer::at(std::size_t index) const {
  const Film& film = *film_;
  index = std::min(index, film.trace.ticks.size() - 1);
  const Inputs& inputs = film.trace.ticks[index].inputs;
  State state;
  Outputs outputs;
  film.run_to(index, state, outputs);
  Snapshot now;
  now.tick = inputs.tick;
  now.t_s = inputs.tick * film.trace.period_s();
  if (film.objects) now.body_world = film.objects->at(index);
  RobotView& view = now.robots.emplace_back();
  view.joint_rad = measured_rad(inputs, film.trace.params);
  view.link_world = sim::link_poses(film.entity, film.bodies[index], view.joint_rad);
  add_outputs(view, outputs, film.trace.params);
  add_imu(view, inputs, film.trace.params);
  add_measured(view, film.entity, film.trace.params, inputs);
  const sim::Truth feet = soles_of(view, film.entity);
  view.zmp_planned_world_m = sim::planned_zmp_world_m(state.tuning, state.gait, feet);
  view.footsteps = footsteps(state.gait, feet.foot[0].sole_world, feet.foot[1].sole_world);
  return now;
}

}  // namespace verp::scene
