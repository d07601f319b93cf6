#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/trace/record/cdr.hpp"

/// Renames frames in any ROS 2 message, by its type's definition; private to this folder.
namespace verp::record::ros {

/// A type's fields, in byte order.
class Definition {
 public:
  /// "ros2msg" schema: the type, then its dependencies.
  explicit Definition(std::string_view schema);
  /// `prefix` before every frame but "world"; nullopt: not of this type.
  std::optional<std::string> with_frames(std::string_view message, std::string_view prefix) const;

 private:
  struct Field {
    std::string_view type, name;
    bool list = false;                 ///< any length, or
    std::optional<std::size_t> count;  ///< this length
  };
  using Fields = std::vector<Field>;

  static std::optional<Field> field_of(std::string_view line);
  const Fields* find(std::string_view type) const;
  bool copy(const Fields& fields, CdrReader& in, Cdr& out, std::string_view prefix) const;
  bool copy_one(const Field& field, CdrReader& in, Cdr& out, std::string_view prefix) const;

  std::string schema_;
  Fields root_;
  std::map<std::string_view, Fields> types_;
};

/// A URDF with `prefix` before every link name, to match the frames.
std::string urdf_with_links(std::string urdf, std::string_view prefix);

}  // namespace verp::record::ros
