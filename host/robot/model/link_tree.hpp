#pragma once
#include <map>
#include <optional>
#include <sdf/sdf.hh>
#include <string>
#include <utility>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/facts.hpp"
#include "host/robot/model/urdf_prepare.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

class PictureFiles;

/// Throws at the definition of `about`.
[[noreturn]] void fail_at(const XmlSource& source, const std::string& about,
                          const std::string& message, const std::string& fix);

/// Nodes and joints from links: lumps fixed links, transforms frames to the body's axes at the zero
/// pose, attaches collision shapes and checks masses. Throws LoadError.
class LinkTree {
 public:
  /// The arguments must outlive the tree.
  LinkTree(const XmlSource& source, const Facts& facts, const sdf::Model& model,
           const UrdfNames& names, Entity& entity)
      : source_(source), facts_(facts), model_(model), names_(names), e_(entity) {}

  void grow();

  struct Located {
    int node;
    Transform pose;  ///< in the node's frame
  };
  /// Link or frame; without it an error at `at`.
  Located locate(const std::string& name, const XmlElement& at) const;

 private:
  /// A link before lumping, in the body frame at the zero pose.
  struct RawLink {
    const sdf::Link* sdf = nullptr;
    Transform pose = Transform::Identity();
    Transform turned = Transform::Identity();  ///< by fixed joints from the body
    double mass_kg = 0;
    Vec3 com_m = Vec3::Zero();
    Mat3 inertia_kg_m2 = Mat3::Zero();
    int node = -1;
  };

  [[noreturn]] void fail(const std::string& about, const std::string& message,
                         const std::string& fix) const {
    fail_at(source_, about, message, fix);
  }
  void read_links();
  bool is_urdf_link(const std::string& name) const;
  bool is_of_urdf(const std::string& link) const;
  double inertia_scale(const std::string& link) const;
  std::optional<Vec3> corrected_com(const std::string& link) const;
  void read_joints();
  void check_fixes() const;
  void put_followers_last();
  bool is_fixed(const sdf::Joint& joint) const;
  Transform turn_of(const sdf::Joint& joint, const Transform& turned) const;
  void place_links();
  void place_link(const std::string& name, int node, const Transform& turned);
  static void lump(Node& node, const RawLink& link, const Vec3& origin);
  int add_joint(const sdf::Joint& sdf, const std::string& child, int parent,
                const Transform& turned);
  Vec3 axis_of(const sdf::Joint& joint) const;
  void add_node(const std::string& name, const Vec3& origin);
  static Vec3 snapped(const Vec3& axis);
  void attach_shapes(const RawLink& link);
  void attach_looks(const RawLink& link, const PictureFiles& files);
  void add_collision(int node, Transform body_pose, Collision collision);
  void add_boxes();
  void check_inertias() const;

  const XmlSource& source_;
  const Facts& facts_;
  const sdf::Model& model_;
  const UrdfNames& names_;
  Entity& e_;
  Transform model_body_ = Transform::Identity();
  std::map<std::string, RawLink> links_;
  std::map<std::string, const sdf::Joint*> parent_joint_;
  std::map<std::string, std::vector<std::pair<const sdf::Joint*, std::string>>> children_;
  std::vector<Vec3> origin_;  ///< body frame, zero pose
};

}  // namespace verp::model
