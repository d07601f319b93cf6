#pragma once
#include <tinyxml2.h>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/robot/model/picture_files.hpp"
#include "host/robot/model/xml_source.hpp"

/// The file and those that it includes; their leaves as numbers.
namespace verp::plain_sdf {

using model::Transform;
using model::Vec3;
using model::XmlElement;

std::optional<XmlElement> first(const XmlElement& parent, const char* child);
/// Trimmed; empty: there is no such child, or nothing in it.
std::string text_in(const XmlElement& parent, const char* child);
bool flag_in(const XmlElement& parent, const char* child);
/// Each throws LoadError at the child: it is no number, or beyond any robot (bounds.hpp).
double number_in(const XmlElement& parent, const char* child, double fallback);
/// It may be inf.
double free_number_in(const XmlElement& parent, const char* child, double fallback);
Vec3 vector_in(const XmlElement& parent, const char* child, const Vec3& fallback);
/// Its <pose>: six numbers, or seven with rotation_format="quat_xyzw".
Transform pose_in(const XmlElement& parent);
/// The frame that the <pose> names; empty: none.
std::string frame_of_pose(const XmlElement& parent);

class Document {
 public:
  /// Throws LoadError for a file that is not there, not well formed, or no <sdf>.
  explicit Document(const std::string& path);

  XmlElement root() const;
  /// The <model> of an <include>; nothing: the file is not there. Throws LoadError at the <include>
  /// for a file without a model, and for includes without an end.
  std::optional<XmlElement> included(const XmlElement& include);
  /// 1.6, of the file that the element stands in.
  double version_of(const XmlElement& element) const;
  /// The file of a mesh's <uri>; empty: it is not there.
  std::string picture(const std::string& uri, const XmlElement& at) const;

 private:
  struct File {
    std::string path;
    tinyxml2::XMLDocument xml;
    double version = 0;
  };
  File& read(const std::string& path);
  std::string model_file(const std::string& uri, const std::string& from) const;

  std::vector<std::unique_ptr<File>> files_;
};

}  // namespace verp::plain_sdf
