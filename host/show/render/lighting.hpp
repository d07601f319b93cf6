#pragma once
#include <map>
#include <string>
#include <vector>

#include "host/show/render/gl.hpp"
#include "host/show/render/projection.hpp"
#include "host/show/render/shaders.hpp"

/// Lights and shadows; private to this folder.
namespace verp::render {

/// Converts from sRGB.
Eigen::Vector3f linear(const scene::Colour& colour);

class Lighting {
 public:
  Lighting() { make_shadow_map(kShadowTexels); }

  static int shadow_light(const scene::Scene& scene, const Effects& effects);
  void draw_shadows(const std::vector<Placed>& placed, const Mat4& sun, const Effects& effects);
  /// The program in use, with a picture's shared uniforms.
  Program& program(const scene::Scene& scene, const View& view, const Effects& effects,
                   bool of_floor, bool textured);

 private:
  void make_shadow_map(int texels);
  void set_lights(const scene::Scene& scene, Program& program, double sun_radius_m);
  void set_common(const scene::Scene& scene, Program& program, const View& view);

  static constexpr int kShadowTexels = 2048, kQuickShadowTexels = 1024;

  std::map<std::string, Program> lit_;  ///< by header
  Program shade_{kShadowVertex, kShadowFragment};
  Texture shadow_ = new_texture();
  int shadow_texels_ = 0;
  FrameBuffer shadow_frame_ = new_frame();
};

}  // namespace verp::render
