#include <gtest/gtest.h>

#include <malloc.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "host/os/files/places.hpp"
#include "host/show/scene/build.hpp"
#include "host/show/scene/camera.hpp"
#include "tests/host/scene/meshes.hpp"
#include "tests/host/session/plans.hpp"

namespace verp::scene {
namespace {

Entity generic21() {
  return model::load_robot(model::find_model("generic21"));
}

std::size_t drawn_on(const Scene& scene, int node) {
  std::size_t count = 0;
  for (const Item& item : scene.items) count += item.node == node && !item.collision;
  return count;
}

TEST(Scene, EachLinkOfARobotIsDrawnAndHasALabelOfItsOwn) {
  const Entity entity = generic21();
  Scene scene = studio();
  EXPECT_EQ(add_robot(scene, entity), 0);
  EXPECT_EQ(add_robot(scene, entity), 1);
  std::set<std::string> names;
  for (std::size_t n = 0; n < entity.nodes.size(); ++n) {
    EXPECT_FALSE(entity.nodes[n].visuals.empty()) << entity.nodes[n].name;
    EXPECT_GE(drawn_on(scene, static_cast<int>(n)), 2u) << entity.nodes[n].name;
  }
  for (const Item& item : scene.items) names.insert(label_name(scene, label_of(scene, item)));
  EXPECT_EQ(names.size(), entity.nodes.size());  // robots of one name share theirs
  EXPECT_EQ(label_of(scene, scene.items.back()), static_cast<int>(2 * entity.nodes.size()) -
                                                     static_cast<int>(entity.nodes.size()) + 1 +
                                                     scene.items.back().node);
}

TEST(Scene, ALinkWithoutLooksShowsItsCollisionShapesOrItsInertia) {
  Entity entity = generic21();
  entity.nodes[3].visuals.clear();
  entity.nodes[4].visuals.clear();
  entity.nodes[4].collisions.clear();
  model::Visual gone;
  gone.shape = model::Visual::Shape::kMesh;  // its file is missing
  entity.nodes[5].visuals = {gone};
  Scene scene = studio();
  add_robot(scene, entity);
  for (const int node : {3, 4, 5}) EXPECT_GE(drawn_on(scene, node), 1u) << node;
  for (const Item& item : scene.items) {
    EXPECT_TRUE(item.size_m.allFinite() && item.pose.matrix().allFinite()) << item.name;
    EXPECT_NE(item.shape, Shape::kMesh);
  }
}

TEST(Scene, APublishedRobotKeepsItsMaterialsAndTheMeshesThatAreThere) {
  const Entity entity = model::load_robot(
      (files::source_dir() / "tests/host/model/published_robot/robot.sdf").string());
  const MeshCount count = meshes_of(entity);
  EXPECT_EQ(count.there, 2u) << "the feet's";
  EXPECT_EQ(count.missing, 4u) << "all others";
  EXPECT_EQ(count.coloured, count.there + count.missing);
}

TEST(Camera, EachViewLooksAtTheRobotAndItsOwnCameraLooksAhead) {
  const Entity entity = generic21();
  Scene scene = studio();
  add_robot(scene, entity);
  Snapshot now;
  now.robots.push_back(standing(entity, Vec3(3, -2, 0), 1.1));
  for (const std::string& name : view_names(scene)) {
    const auto camera = view(name, scene, now, 0, 1.5);
    ASSERT_TRUE(camera) << name;
    const Vec3 body = now.robots[0].link_world[0].translation();
    if (name == "head" || name == "camera") {
      EXPECT_GT((camera->target_m - camera->eye_m)
                    .normalized()
                    .dot(Vec3(std::cos(1.1), std::sin(1.1), 0)),
                0.9);
      EXPECT_LT((camera->eye_m - body).norm(), 0.4);
    } else {
      EXPECT_LT((camera->target_m - body).norm(), 0.2) << name;
      EXPECT_GT((camera->eye_m - body).norm(), 0.5) << name;
    }
  }
  EXPECT_FALSE(view("nobody", scene, now, 0, 1.5));
}

/// In many foreign files only the feet collide, and arms reach to the sides.
TEST(Camera, WhatIsDrawnIsInThePictureEvenIfNothingCollides) {
  Entity entity = generic21();
  for (model::Node& node : entity.nodes) node.collisions.clear();
  model::Visual rod;
  rod.shape = model::Visual::Shape::kBox;
  rod.size_m = Vec3(0.02, 0.9, 0.02);
  entity.nodes[0].visuals.push_back(rod);
  Scene scene = studio();
  add_robot(scene, entity);
  Snapshot now;
  now.robots.push_back(standing(entity, Vec3(3, -2, 0), 1.1));
  for (const char* name : {"three-quarter", "front", "side", "back", "follow"}) {
    const Camera camera = view(name, scene, now, 0, 1).value();
    const Vec3 ahead = (camera.target_m - camera.eye_m).normalized();
    const Vec3 right = ahead.cross(Vec3::UnitZ()).normalized(), up = right.cross(ahead);
    for (const Item& item : scene.items) {
      const Transform pose = now.robots[0].link_world[static_cast<std::size_t>(item.node)];
      for (const double side_m : {-0.45, 0.0, 0.45}) {
        const double reach_m = item.size_m.y() == 0.9 ? side_m : 0;
        const Vec3 seen = pose * item.pose * Vec3(0, reach_m, 0) - camera.eye_m;
        const double edge = std::tan(camera.vertical_fov_rad / 2) * seen.dot(ahead);
        EXPECT_LT(std::abs(seen.dot(right)), edge) << name << " " << item.name;
        EXPECT_LT(std::abs(seen.dot(up)), edge) << name << " " << item.name;
      }
    }
  }
}

std::string large_stl(const char* name, double half_width_m) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / name;
  std::ofstream out(file);
  out << "solid s\n";
  for (int i = 0; i < 60000; ++i) {
    out << "facet normal 0 0 1\nouter loop\nvertex 0 " << -half_width_m << " 0\nvertex 0 "
        << half_width_m << " 0\nvertex " << 1e-7 * i << " 0 0.01\nendloop\nendfacet\n";
  }
  out << "endsolid s\n";
  return file.string();
}

TEST(Camera, ALargeMeshIsInThePicture) {
  ::mallopt(M_MMAP_THRESHOLD, 1 << 16);  // what is freed is gone, and reading it ends the program
  Entity entity = generic21();
  model::Visual wide;
  wide.shape = model::Visual::Shape::kMesh;
  wide.mesh = wide.mesh_uri = large_stl("verp-wide.stl", 0.7);
  wide.size_m = Vec3::Ones();
  entity.nodes[0].visuals.push_back(wide);
  Scene scene = studio();
  add_robot(scene, entity, Meshes::kFromFiles);
  std::filesystem::remove(wide.mesh);
  EXPECT_NEAR(scene.robots[0].drawn_m.sizes().y(), 1.4, 0.01);
}

}  // namespace
}  // namespace verp::scene
