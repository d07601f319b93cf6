#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "host/robot/model/facts.hpp"
#include "host/robot/model/xml_source.hpp"

/// Prepares URDF files for urdfdom, and for libsdformat's import, which drops links without mass
/// and everything beyond, forgets names of fixed links, and has one name space for links and
/// joints.
namespace verp::model {

struct UrdfNames {
  std::set<std::string> massless_links;      ///< have a stand-in mass
  std::map<std::string, std::string> joint;  ///< changed -> the file's
  const std::string& joint_name(const std::string& imported) const {
    const auto changed = joint.find(imported);
    return changed == joint.end() ? imported : changed->second;
  }
};

/// The copies are deleted with this object.
class PreparedUrdfs {
 public:
  /// Throws LoadError if a copy cannot be written.
  PreparedUrdfs(const XmlSource& source, const Facts& facts);
  ~PreparedUrdfs();
  PreparedUrdfs(const PreparedUrdfs&) = delete;
  PreparedUrdfs& operator=(const PreparedUrdfs&) = delete;

  std::string copy_of(const std::string& path) const;
  /// A copy with the file's own names and masses, for urdfdom.
  std::string plain_copy_of(const std::string& path) const;
  /// Its line numbers mean nothing to users.
  bool is_copy(const std::string& path) const;
  const UrdfNames& names() const { return names_; }
  /// One line for each part that is left out.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void prepare(const XmlElement& robot, const Facts& facts);
  void untie(tinyxml2::XMLElement& robot);
  void rename_and_weigh(tinyxml2::XMLElement& robot);

  std::map<std::string, std::string> copy_of_, plain_copy_of_;
  UrdfNames names_;
  std::vector<std::string> notes_;
};

}  // namespace verp::model
