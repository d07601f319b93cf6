#include "host/show/scene/from_trace.hpp"

#include <algorithm>
#include <cmath>

#include "common/control/step.hpp"
#include "common/model/params.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/principal.hpp"
#include "host/show/scene/body_track.hpp"
#include "host/show/scene/measured.hpp"
#include "host/show/scene/plan_marks.hpp"
#include "host/show/scene/scene.hpp"
#include "host/twin/sim/body.hpp"
#include "host/twin/sim/planned_zmp.hpp"

namespace verp::scene {
namespace {

Vec3 metres(const Xyz& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

void add_bone(model::Node& node, const Vec3& to_m) {
  const double length_m = to_m.norm();
  model::Visual bone;
  bone.shape = model::Visual::Shape::kCapsule;
  bone.size_m = {0.009, 0, length_m};
  bone.pose = Transform(model::turn_of_z(length_m > 1e-6 ? to_m : Vec3(Vec3::UnitZ())));
  bone.pose.translation() = to_m / 2;
  node.visuals.push_back(bone);
}

void add_leg(Entity& entity, const LegParams& leg, const char* name) {
  if (leg.solver == LegSolver::kNone) return;
  model::Limb limb;
  limb.name = name;
  for (const std::uint8_t joint : leg.joint) {
    if (joint != kNoJoint) limb.joints.push_back(joint);
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      limb.tip.linear()(row, column) = static_cast<double>(leg.sole_foot[3 * row + column]);
    }
  }
  limb.tip.translation() = metres(leg.sole_foot_m);
  limb.sole_min_m = {-static_cast<double>(leg.sole_back_m), -static_cast<double>(leg.sole_right_m),
                     0};
  limb.sole_max_m = {static_cast<double>(leg.sole_front_m), static_cast<double>(leg.sole_left_m),
                     0};
  model::Visual sole;
  sole.size_m = limb.sole_max_m - limb.sole_min_m + Vec3(0, 0, 0.006);
  sole.pose =
      limb.tip * Eigen::Translation3d((limb.sole_min_m + limb.sole_max_m) / 2 + Vec3(0, 0, 0.003));
  entity.nodes[static_cast<std::size_t>(limb.joints.back()) + 1].visuals.push_back(sole);
  entity.limbs.push_back(limb);
}

/// A robot from Params alone: tree, soles, and bones to draw.
Entity entity_of(const Params& params) {
  Entity entity;
  entity.name = text_of(params.name);
  entity.nodes.resize(params.joint_count + std::size_t{1});
  entity.nodes[0].name = "body";
  entity.nodes[0].mass_kg = static_cast<double>(params.body_mass_kg);
  entity.nodes[0].com_m = metres(params.body_com_m);
  for (std::size_t j = 0; j < params.joint_count; ++j) {
    const JointParams& from = params.joint[j];
    model::Joint joint;
    joint.name = text_of(from.name);
    joint.parent = from.parent;
    joint.origin_m = metres(from.origin_parent_m);
    joint.axis = metres(from.axis);
    joint.lower_rad = static_cast<double>(from.lower_rad);
    joint.upper_rad = static_cast<double>(from.upper_rad);
    joint.stand_rad = static_cast<double>(from.stand_rad);
    entity.joints.push_back(joint);
    model::Node& node = entity.nodes[j + 1];
    node.name = joint.name;
    node.mass_kg = static_cast<double>(from.mass_kg);
    node.com_m = metres(from.com_link_m);
    add_bone(entity.nodes[from.parent], joint.origin_m);
  }
  for (std::size_t n = 1; n < entity.nodes.size(); ++n) {
    if (entity.nodes[n].visuals.empty()) add_bone(entity.nodes[n], 2 * entity.nodes[n].com_m);
  }
  add_leg(entity, params.leg[0], "left_leg");
  add_leg(entity, params.leg[1], "right_leg");
  return entity;
}

/// Moving objects' poses, between a trace's. An unnamed object stays where it began.
class ObjectTrack {
 public:
  ObjectTrack(const record::Trace& trace, const model::World& world);
  /// After that tick, in the order of model::moving().
  std::vector<Transform> at(std::size_t tick) const;

 private:
  struct Kept {
    std::size_t tick;
    std::vector<Transform> poses;
  };
  std::vector<Transform> start_;
  std::vector<Kept> kept_;
};

ObjectTrack::ObjectTrack(const record::Trace& trace, const model::World& world) {
  const std::vector<const model::WorldObject*> moving = model::moving(world);
  for (const model::WorldObject* object : moving) start_.push_back(object->pose);
  for (const record::ObjectsAt& recorded : trace.objects) {
    Kept& kept = kept_.emplace_back(Kept{recorded.index, start_});
    for (const record::ros::ObjectPose& object : recorded.objects) {
      const auto found = std::find_if(moving.begin(), moving.end(),
                                      [&](const auto* each) { return each->name == object.name; });
      if (found == moving.end()) continue;
      kept.poses[static_cast<std::size_t>(found - moving.begin())] = to_transform(object.pose);
    }
  }
}

std::vector<Transform> ObjectTrack::at(std::size_t tick) const {
  if (kept_.empty()) return start_;
  const auto after =
      std::upper_bound(kept_.begin(), kept_.end(), tick,
                       [](std::size_t at, const Kept& kept) { return at < kept.tick; });
  if (after == kept_.begin()) return kept_.front().poses;
  if (after == kept_.end()) return kept_.back().poses;
  const Kept& before = *(after - 1);
  const double part =
      static_cast<double>(tick - before.tick) / static_cast<double>(after->tick - before.tick);
  std::vector<Transform> poses;
  for (std::size_t i = 0; i < start_.size(); ++i)
    poses.push_back(between(before.poses[i], after->poses[i], part));
  return poses;
}

constexpr std::size_t kEvery = 125;  // between States: most that a seek recomputes

bool is_same_robot(const Entity& entity, const Params& params) {
  if (entity.joints.size() != params.joint_count) return false;
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    if (model::short_name(entity.joints[j].name) != text_of(params.joint[j].name)) return false;
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

  Film(const std::filesystem::path& file, const Entity* robot) : trace(record::read_trace(file)) {
    if (robot != nullptr) {
      entity = *robot;
    } else {
      find_entity();
    }
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

TracePlayer::TracePlayer(const std::filesystem::path& file, const Entity* robot)
    : film_(std::make_unique<Film>(file, robot)) {
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
