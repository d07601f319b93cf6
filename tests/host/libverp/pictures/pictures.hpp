#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "host/apps/libverp/verp.h"
#include "tests/host/libverp/opened.hpp"

namespace verp::abi::test {

struct Looking : Opened {
  explicit Looking(const char* world = "demo") : Opened(world) {}

  verp_camera camera(std::uint32_t robot = 0) const {
    verp_camera camera = {};
    camera.size = sizeof camera;
    EXPECT_EQ(verp_session_camera(session, robot, 0, &camera), VERP_OK) << verp_last_error();
    return camera;
  }
  void tick(std::uint32_t count) {
    ASSERT_EQ(verp_session_tick(session, count, nullptr, nullptr), VERP_OK) << verp_last_error();
  }
  /// Empty before the first picture.
  template <class Pixel>
  std::vector<Pixel> picture(std::uint32_t what, std::uint32_t robot = 0,
                             double* time_s = nullptr) const {
    const verp_camera by = camera(robot);
    std::vector<Pixel> pixels((what == VERP_COLOUR ? 3 : 1) * by.width * by.height);
    const int status = verp_session_picture(session, robot, 0, what, pixels.data(),
                                            pixels.size() * sizeof(Pixel), time_s);
    EXPECT_GE(status, VERP_OK) << verp_last_error();
    return status == VERP_OK ? pixels : std::vector<Pixel>();
  }
  std::vector<std::uint8_t> colour(std::uint32_t robot = 0) const {
    return picture<std::uint8_t>(VERP_COLOUR, robot);
  }
  static verp_view view(const char* name) {
    verp_view view = {};
    view.size = sizeof view;
    view.width = 320;
    view.height = 240;
    view.name = name;
    return view;
  }
  std::vector<std::uint8_t> render(const verp_view& from) const {
    std::vector<std::uint8_t> pixels(std::size_t{3} * from.width * from.height);
    EXPECT_EQ(verp_session_render(session, &from, pixels.data(), pixels.size()), VERP_OK)
        << verp_last_error();
    return pixels;
  }
};

}  // namespace verp::abi::test
