#pragma once
#include <vector>

#include "host/show/render/gl.hpp"
#include "host/show/render/shaders.hpp"
#include "host/show/render/shapes.hpp"
#include "host/show/render/stage.hpp"

/// Depth and item per pixel; private to this folder.
namespace verp::render {

void begin_pass();

class Meter {
 public:
  enum class Names {
    kLabels,  ///< scene::label_of; floor: 0
    kItems    ///< Scene::items; floor: -1
  };
  /// Four floats a pixel, rows from the bottom: depth along the axis (infinity: nothing), name, two
  /// unused.
  std::vector<float> measure(const Stage& stage, const scene::Snapshot& now,
                             const scene::Camera& camera, Size size, const Effects& effects,
                             Names names);

 private:
  Program meter_{kSolidVertex, kMeasureFragment};
  GpuMesh floor_{plane(1, 1)};
  Canvas measured_;
};

}  // namespace verp::render
