#pragma once
#include "common/control/state.hpp"
#include "host/show/scene/snapshot.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::scene {

/// Poses of all links at a tick's measured angles.
class TickPoses {
 public:
  TickPoses(const Entity& entity, const Params& params) : entity_(entity), params_(params) {}
  std::vector<Transform> operator()(const Inputs& inputs, const Transform& body) const;
  const Entity& entity() const { return entity_; }

 private:
  const Entity& entity_;
  const Params& params_;
};

Transform to_transform(const record::ros::BodyPose& pose);
/// A part of the way from one pose to another.
Transform between(const Transform& from, const Transform& to, double part);

/// Where the body was, tick by tick: as the trace's twin knew, between its poses in a straight
/// line; else by the controller's own estimate of tilt and heading, and by the lower sole, which
/// stays where it stands.
class BodyTrack {
 public:
  BodyTrack(const record::Trace& trace, const TickPoses& poses) : trace_(trace), poses_(poses) {}
  /// Of one tick after the other; state and outputs are of after it.
  Transform at(std::size_t index, const State& state, const Outputs& outputs);

 private:
  Transform between(std::size_t index);
  Transform by_feet(const Inputs& inputs, const State& state, const Outputs& outputs);

  const record::Trace& trace_;
  const TickPoses& poses_;
  std::size_t next_ = 0;  ///< of Trace::bodies: the first after the tick
  int standing_ = -1;     ///< the foot that stood last
  Vec2 stands_m_ = Vec2::Zero();
};

}  // namespace verp::scene
