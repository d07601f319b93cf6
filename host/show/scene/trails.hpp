#pragma once
#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

/// The ways that the centre of mass and the soles of one robot went, up to now.
class Trails {
 public:
  /// Adds this instant, and gives the snapshot its trails.
  void follow(Snapshot& now, const Entity& entity);

 private:
  std::vector<Trail> trails_;
};

}  // namespace verp::scene
