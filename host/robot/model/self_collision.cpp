#include "host/robot/model/self_collision.hpp"

#include <ode/ode.h>

#include <algorithm>
#include <memory>

namespace verp::model {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

struct Shape {
  dGeomID geom;
  int node;
};

/// Shapes without physics; ODE tests for contact.
class Shapes {
 public:
  Shapes() {
    static const int kReady = dInitODE2(0);  // never closed: worlds come and go
    static_cast<void>(kReady);
  }
  ~Shapes() {
    for (const Shape& shape : shapes_) dGeomDestroy(shape.geom);
  }
  Shapes(const Shapes&) = delete;
  Shapes& operator=(const Shapes&) = delete;

  void add(const Collision& collision, const Transform& link, int node) {
    const Transform pose = link * collision.pose;
    const dGeomID geom = make(collision);
    dMatrix3 rotation{};
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        rotation[4 * row + column] = pose.linear()(row, column);
    }
    dGeomSetPosition(geom, pose.translation().x(), pose.translation().y(), pose.translation().z());
    dGeomSetRotation(geom, rotation);
    shapes_.push_back({geom, node});
  }

  template <class Each>
  void for_each_contact(const Each& each) const {
    constexpr int kMost = 8;
    for (std::size_t a = 0; a < shapes_.size(); ++a) {
      for (std::size_t b = a + 1; b < shapes_.size(); ++b) {
        dContactGeom contact[kMost];
        const int count =
            dCollide(shapes_[a].geom, shapes_[b].geom, kMost, contact, sizeof contact[0]);
        for (int i = 0; i < count; ++i) each(shapes_[a].node, shapes_[b].node, contact[i].depth);
      }
    }
  }

 private:
  static dGeomID make(const Collision& collision) {
    const Vec3& size = collision.size_m;
    switch (collision.shape) {
      case Collision::Shape::kSphere:
        return dCreateSphere(nullptr, size.x());
      case Collision::Shape::kCapsule:
        return dCreateCapsule(nullptr, size.x(), size.z());
      case Collision::Shape::kCylinder:
        return dCreateCylinder(nullptr, size.x(), size.z());
      case Collision::Shape::kBox:
        break;
    }
    return dCreateBox(nullptr, size.x(), size.y(), size.z());
  }
  std::vector<Shape> shapes_;
};

int parent_of(const Entity& entity, int node) {
  return entity.joints[at(node - 1)].parent;
}

bool declared(const Entity& entity, int link, int other) {
  return std::any_of(
      entity.no_collide.begin(), entity.no_collide.end(),
      [&](const NoCollide& pair) { return pair.link == link && pair.other == other; });
}

}  // namespace

int joints_between(const Entity& entity, int link, int other) {
  for (const auto& [top, tip] : {std::pair{link, other}, std::pair{other, link}}) {
    int joints = 0;
    for (int node = tip; node != top; node = parent_of(entity, node)) {
      ++joints;
      if (node == 0) {
        joints = kMaxJoints;
        break;
      }
    }
    if (joints < kMaxJoints) return joints;
  }
  return kMaxJoints;
}

std::vector<Overlap> overlaps(const Entity& entity, const std::vector<double>& joint_rad) {
  std::vector<Transform> pose(entity.nodes.size(), Transform::Identity());
  for (const std::size_t j : outward(entity)) {
    const Joint& joint = entity.joints[j];
    pose[j + 1] = pose[at(joint.parent)] * Eigen::Translation3d(joint.origin_m) *
                  Eigen::AngleAxisd(joint_rad[j], joint.axis);
  }
  Shapes shapes;
  for (std::size_t n = 0; n < entity.nodes.size(); ++n) {
    for (const Collision& collision : entity.nodes[n].collisions)
      shapes.add(collision, pose[n], static_cast<int>(n));
  }
  std::vector<Overlap> found;
  shapes.for_each_contact([&](int a, int b, double depth_m) {
    const int link = std::min(a, b), other = std::max(a, b);
    if (joints_between(entity, link, other) <= 1) return;
    const auto known = std::find_if(found.begin(), found.end(), [&](const Overlap& o) {
      return o.link == link && o.other == other;
    });
    if (known == found.end()) {
      found.push_back({link, other, depth_m});
    } else {
      known->depth_m = std::max(known->depth_m, depth_m);
    }
  });
  return found;
}

std::vector<Clash> find_near_overlaps(Entity& entity) {
  std::vector<double> zero(entity.joints.size(), 0.0), stand, sit;
  for (const Joint& joint : entity.joints) {
    stand.push_back(joint.stand_rad);
    sit.push_back(joint.sit_rad);
  }
  std::vector<Clash> clashes;
  const auto look = [&](const std::vector<double>& joint_rad, const char* pose, bool held) {
    for (const Overlap& overlap : overlaps(entity, joint_rad)) {
      if (declared(entity, overlap.link, overlap.other)) continue;
      if (joints_between(entity, overlap.link, overlap.other) <= kNearJoints) {
        entity.no_collide.push_back(
            {overlap.link, overlap.other, std::string("they overlap in the ") + pose + " pose"});
      } else if (held) {
        clashes.push_back({overlap, pose});
      }
    }
  };
  look(zero, "zero", false);
  look(stand, "standing", true);
  look(sit, "sitting", true);
  return clashes;
}

}  // namespace verp::model
