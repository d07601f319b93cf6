#pragma once
#include "host/author/mjcf/mjcf.hpp"
#include "host/author/plain_sdf/gather.hpp"

namespace verp::plain_sdf {

/// Mass, shapes and IMU of links, and what joints say of themselves.
class LinkReader {
 public:
  LinkReader(const Document& document, Flat& flat, mjcf::Robot& robot)
      : document_(document), flat_(flat), out_(robot) {}

  /// Without its name and its place in the tree.
  mjcf::Body body_of(const FoundPart& link);
  /// Places of the IMU sensors on a link.
  std::vector<Transform> imus_on(const FoundPart& link) const;
  Transform place_of(const FoundPart& joint) const;
  /// Limits, damping and friction of one axis; the direction in the robot's frame. `axis`: its
  /// name.
  mjcf::Joint joint_of(const FoundPart& joint, const char* axis);

 private:
  Transform pose_on(const FoundPart& link, const XmlElement& part) const;
  std::optional<mjcf::Inertial> inertial_of(const FoundPart& link, const mjcf::Body& body);
  void add_geom(const FoundPart& link, const XmlElement& part, mjcf::Body& body);
  bool read_shape(const XmlElement& geometry, mjcf::Geom& geom);
  void read_mesh(const XmlElement& mesh, mjcf::Geom& geom);
  Vec3 direction_of(const FoundPart& joint, const XmlElement& axis) const;

  const Document& document_;
  Flat& flat_;
  mjcf::Robot& out_;
};

}  // namespace verp::plain_sdf
