#pragma once
#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

/// Paths of one robot's centre of mass and soles.
class Trails {
 public:
  /// Adds this instant; writes the trails into the snapshot.
  void follow(Snapshot& now, const Entity& entity);

 private:
  std::vector<Trail> trails_;
};

}  // namespace verp::scene
