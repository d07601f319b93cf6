#pragma once
#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

/// Centre of mass and soles.
class Trails {
 public:
  /// Writes the trails into the snapshot, too.
  void follow(Snapshot& now, const Entity& entity);

 private:
  std::vector<Trail> trails_;
};

}  // namespace verp::scene
