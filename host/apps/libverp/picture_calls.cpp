#include <fmt/format.h>

#include <cstring>

#include "host/apps/libverp/failure.hpp"
#include "host/apps/libverp/sessions.hpp"
#include "host/apps/libverp/text.hpp"

using namespace verp::abi;

namespace {

using verp::model::CameraSensor;

struct What {
  std::uint32_t bit;
  const char* name;
  const char* encoding;  ///< of camera::Picture
  std::uint64_t bytes;   ///< per pixel
};
constexpr What kWhats[] = {{VERP_COLOUR, "colour", "rgb8", 3},
                           {VERP_DEPTH, "depth", "16UC1", 2},
                           {VERP_LABELS, "labels", "mono16", 2}};

std::uint32_t gives(const CameraSensor& camera) {
  std::uint32_t bits = 0;
  if (camera.has_colour()) bits |= VERP_COLOUR;
  if (camera.has_depth()) bits |= VERP_DEPTH;
  if (camera.kind == CameraSensor::Kind::kLabels) bits |= VERP_LABELS;
  return bits;
}

const CameraSensor& camera_of(Run& run, std::uint32_t robot, std::uint32_t index) {
  const verp::model::Entity& entity = run.seat(robot).plan().entity;
  if (index < entity.cameras.size()) return entity.cameras[index];
  throw Failure(VERP_BAD_ARGUMENT, fmt::format("there is no camera {}: robot {}, {}, has {}", index,
                                               robot, entity.name, entity.cameras.size()));
}

const What& what_of(const CameraSensor& camera, std::uint32_t bit) {
  std::string those;
  for (const What& each : kWhats) {
    if ((gives(camera) & each.bit) == 0) continue;
    if (each.bit == bit) return each;
    those += those.empty() ? each.name : std::string(" and ") + each.name;
  }
  throw Failure(VERP_BAD_ARGUMENT,
                fmt::format("camera '{}' gives {}: `what` is not one of it", camera.name, those));
}

std::uint32_t pixels(std::uint32_t value, const char* name) {
  constexpr std::uint32_t kLeast = 16, kMost = VERP_MOST_PIXELS;
  if (value >= kLeast && value <= kMost) return value;
  throw Failure(VERP_BAD_ARGUMENT,
                fmt::format("view->{} may be {} to {}, not {}", name, kLeast, kMost, value));
}

verp::model::Vec3 point(const double (&from)[3], const char* name) {
  return {finite(from[0], name), finite(from[1], name), finite(from[2], name)};
}

verp::camera::Outside outside_of(const verp_view& view) {
  constexpr double kLeast_rad = 0.01, kMost_rad = 3;
  verp::camera::Outside from;
  from.width = pixels(view.width, "width");
  from.height = pixels(view.height, "height");
  if ((view.flags & ~std::uint32_t{VERP_PLAIN}) != 0)
    throw Failure(VERP_BAD_ARGUMENT, "view->flags has more than VERP_PLAIN");
  from.shadows = from.antialias = (view.flags & VERP_PLAIN) == 0;
  if (view.name != nullptr) {
    need_text(view.name, "view->name");
    from.view = view.name;
    return from;
  }
  from.eye_m = point(view.eye_m, "view->eye_m");
  from.target_m = point(view.target_m, "view->target_m");
  if (view.fov_rad != 0) from.vertical_fov_rad = view.fov_rad;
  if (!(from.vertical_fov_rad >= kLeast_rad && from.vertical_fov_rad <= kMost_rad))
    throw Failure(VERP_BAD_ARGUMENT, "view->fov_rad may be 0.01 to 3, or 0");
  if (from.eye_m == from.target_m)
    throw Failure(VERP_BAD_ARGUMENT, "view->eye_m is where view->target_m is");
  return from;
}

}  // namespace

int verp_session_cameras(verp_session session, uint32_t robot, uint32_t* count) {
  return call("verp_session_cameras", [&] {
    need(count, "count");
    const auto run = sessions().use(session);
    *count = static_cast<std::uint32_t>(run->seat(robot).plan().entity.cameras.size());
  });
}

int verp_session_camera(verp_session session, uint32_t robot, uint32_t index, verp_camera* camera) {
  return call("verp_session_camera", [&] {
    need_struct(camera, "camera");
    const auto run = sessions().use(session);
    const CameraSensor& from = camera_of(*run, robot, index);
    *camera = {};
    camera->size = sizeof *camera;
    camera->gives = gives(from);
    camera->width = static_cast<std::uint32_t>(from.width_px);
    camera->height = static_cast<std::uint32_t>(from.height_px);
    camera->rate_hz = from.rate_hz;
    camera->fx_px = from.fx_px;
    camera->fy_px = from.fy_px;
    camera->cx_px = from.cx_px;
    camera->cy_px = from.cy_px;
    std::copy(from.distortion.begin(), from.distortion.end(), camera->distortion);
    camera->near_m = from.near_m;
    camera->far_m = from.far_m;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        camera->pose[3 * row + column] = from.pose.linear()(row, column);
      camera->pose[9 + row] = from.pose.translation()(row);
    }
    camera->link = static_cast<std::uint32_t>(from.node);
    put_text(from.name, camera->name);
  });
}

int verp_session_picture(verp_session session, uint32_t robot, uint32_t camera, uint32_t what,
                         void* picture, uint64_t size, double* time_s) {
  return call("verp_session_picture", [&] {
    need(picture, "picture");
    const auto run = sessions().use(session);
    const CameraSensor& by = camera_of(*run, robot, camera);
    const What& wanted = what_of(by, what);
    const auto area =
        static_cast<std::uint64_t>(by.width_px) * static_cast<std::uint64_t>(by.height_px);
    need_size(size, wanted.bytes * area, "picture");
    const verp::camera::Picture* seen = run->sight.picture(robot, camera, wanted.encoding);
    if (seen == nullptr) return VERP_NO_PICTURE;
    need_size(seen->data.size(), size, "what was drawn");
    std::memcpy(picture, seen->data.data(), size);
    if (time_s != nullptr) *time_s = 1e-6 * static_cast<double>(seen->time_us);
    return VERP_OK;
  });
}

int verp_session_render(verp_session session, const verp_view* view, void* picture, uint64_t size) {
  return call("verp_session_render", [&] {
    need_struct(view, "view");
    need(picture, "picture");
    const verp::camera::Outside from = outside_of(*view);
    need_size(size, std::uint64_t{3} * from.width * from.height, "picture");
    const auto run = sessions().use(session);
    run->seat(view->robot);
    const verp::camera::Picture drawn = run->sight.render(run->session, view->robot, from);
    need_size(drawn.data.size(), size, "what was drawn");
    std::memcpy(picture, drawn.data.data(), size);
  });
}
