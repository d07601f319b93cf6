#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/trace/record/cdr.hpp"

/// Frames in ROS 2 messages of any type, by the type's definition. Private to this folder.
namespace verp::record::ros {

/// Which fields a message has, in the order of its bytes.
class Definition {
 public:
  /// Of the text that MCAP's "ros2msg" encoding has: the type, then those it is made of.
  explicit Definition(std::string_view schema);
  /// The message with `prefix` before every frame but "world". Nothing: it is no such message.
  std::optional<std::string> with_frames(std::string_view message, std::string_view prefix) const;

 private:
  struct Field {
    std::string_view type, name;
    bool list = false;                 ///< any number of it, or
    std::optional<std::size_t> count;  ///< that many
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

/// A URDF with `prefix` before the name of every link, as frames have it.
std::string urdf_with_links(std::string urdf, std::string_view prefix);

}  // namespace verp::record::ros
