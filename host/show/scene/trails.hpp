#pragma once
#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

class Trails {
 public:
  /// Writes the trails into the snapshot, too.
  void follow(Snapshot& now, const Entity& entity);

 private:
  std::vector<Trail> trails_;
};

}  // namespace verp::scene
