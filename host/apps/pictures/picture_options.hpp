#pragma once
#include <string>

#include "host/show/render/renderer.hpp"

namespace CLI {
class App;
}

namespace verp::pictures {

struct PictureOptions {
  std::string file;
  std::string camera = "three-quarter";
  std::string size_text = "1280x720";
  bool marks = false;
  render::Effects effects;
};

void declare_picture(CLI::App& app, PictureOptions& options, const std::string& file_help);

/// Throws ToolError.
render::Size size_of(const std::string& command, const PictureOptions& options);

/// Includes --marks.
render::Effects effects_of(const PictureOptions& options);

/// The view of --camera. Throws ToolError with the known views.
scene::Camera camera_of(const std::string& command, const PictureOptions& options,
                        const scene::Scene& scene, const scene::Snapshot& now, render::Size size);

/// The folder must exist, and the name have one of these endings.
void require_place(const std::string& command, const std::string& file,
                   const std::vector<std::string>& endings);

}  // namespace verp::pictures
