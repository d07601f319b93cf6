#pragma once
#include "host/robot/model/world.hpp"
#include "host/show/scene/scene.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::scene {

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

}  // namespace verp::scene
