#pragma once
#include <map>
#include <set>
#include <string>

#include "host/robot/model/xml_source.hpp"

/// What libsdformat's URDF import would lose or not take, made good before it reads: it drops links
/// without mass and all that hang on them, forgets the names of links that fixed joints join, and
/// has one space of names for links and joints.
namespace verp::model {

/// What an import must know of the changes.
struct UrdfNames {
  std::set<std::string> massless_links;      ///< got a stand-in mass: theirs is none
  std::map<std::string, std::string> joint;  ///< names that were changed, as the file has them
  const std::string& joint_name(const std::string& imported) const {
    const auto changed = joint.find(imported);
    return changed == joint.end() ? imported : changed->second;
  }
};

/// Copies of a robot's URDF files as libsdformat shall read them; they vanish with this.
class PreparedUrdfs {
 public:
  /// Throws LoadError when a copy cannot be written.
  explicit PreparedUrdfs(const XmlSource& source);
  ~PreparedUrdfs();
  PreparedUrdfs(const PreparedUrdfs&) = delete;
  PreparedUrdfs& operator=(const PreparedUrdfs&) = delete;

  /// The copy of this file; where there is none, the file.
  std::string copy_of(const std::string& path) const;
  /// True for the copies: their lines mean nothing to anybody.
  bool is_copy(const std::string& path) const;
  const UrdfNames& names() const { return names_; }

 private:
  void prepare(const XmlElement& robot);

  std::map<std::string, std::string> copy_of_;
  UrdfNames names_;
};

}  // namespace verp::model
