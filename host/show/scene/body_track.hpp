#pragma once
#include "common/control/state.hpp"
#include "host/show/scene/snapshot.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::scene {

/// Poses at a tick's measured angles.
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
/// `part` runs from 0 to 1.
Transform between(const Transform& from, const Transform& to, double part);

/// The body's pose tick by tick. Interpolates the trace's true poses, if any. Else tilt and heading
/// are the estimate, and position follows from the lower sole, which does not slide.
class BodyTrack {
 public:
  BodyTrack(const record::Trace& trace, const TickPoses& poses) : trace_(trace), poses_(poses) {}
  /// Call it tick after tick; state and outputs are those after the tick.
  Transform at(std::size_t index, const State& state, const Outputs& outputs);

 private:
  Transform between(std::size_t index);
  Transform by_feet(const Inputs& inputs, const State& state, const Outputs& outputs);

  const record::Trace& trace_;
  const TickPoses& poses_;
  std::size_t next_ = 0;  ///< first in Trace::bodies after the tick
  int standing_ = -1;     ///< last carrying foot
  Vec2 stands_m_ = Vec2::Zero();
};

}  // namespace verp::scene
