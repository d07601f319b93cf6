#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/trace/record/cdr.hpp"

/// Renames frames in ROS 2 messages of any type, by the type's definition. Private to this folder.
namespace verp::record::ros {

/// The fields of a message type, in byte order.
class Definition {
 public:
  /// Parses a "ros2msg" schema of MCAP: the type, then its dependencies.
  explicit Definition(std::string_view schema);
  /// The message with `prefix` before every frame except "world"; nullopt: not of this type.
  std::optional<std::string> with_frames(std::string_view message, std::string_view prefix) const;

 private:
  struct Field {
    std::string_view type, name;
    bool list = false;                 ///< a list of any length, or
    std::optional<std::size_t> count;  ///< an array of this length
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
