#include "host/trace/record/ros_frames.hpp"

#include <charconv>

namespace verp::record::ros {
namespace {

std::size_t size_of(std::string_view type) {
  static const std::map<std::string_view, std::size_t> kSizes = {
      {"bool", 1},   {"byte", 1},    {"char", 1},   {"int8", 1},   {"uint8", 1},
      {"int16", 2},  {"uint16", 2},  {"int32", 4},  {"uint32", 4}, {"int64", 8},
      {"uint64", 8}, {"float32", 4}, {"float64", 8}};
  const auto found = kSizes.find(type);
  return found == kSizes.end() ? 0 : found->second;
}

void copy_number(std::size_t size, CdrReader& in, Cdr& out) {
  if (size == 1) out.put(in.get<std::uint8_t>());
  if (size == 2) out.put(in.get<std::uint16_t>());
  if (size == 4) out.put(in.get<std::uint32_t>());
  if (size == 8) out.put(in.get<std::uint64_t>());
}

std::string frame(std::string_view name, std::string_view prefix) {
  const bool own = !name.empty() && name != "world";
  return std::string(own ? prefix : "") + std::string(name);
}

std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(text.size(), line.size() + 1));
  return line;
}

}  // namespace

Definition::Definition(std::string_view schema) : schema_(schema) {
  Fields* fields = &root_;
  for (std::string_view left = schema_; !left.empty();) {
    const std::string_view line = next_line(left);
    if (line.starts_with("MSG: ")) {
      fields = &types_[line.substr(5)];
    } else if (const auto field = field_of(line)) {
      fields->push_back(*field);
    }
  }
}

/// "float64[9] covariance"; nullopt: separator, comment or constant.
std::optional<Definition::Field> Definition::field_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  const std::size_t space = line.find(' ');
  if (space == std::string_view::npos || line.find('=') != std::string_view::npos) return {};
  Field field{.type = line.substr(0, space), .name = line.substr(space + 1), .count = {}};
  field.name = field.name.substr(0, field.name.find(' '));
  const std::size_t bracket = field.type.find('[');
  if (bracket == std::string_view::npos) return field;
  std::size_t count = 0;
  const std::string_view inside = field.type.substr(bracket + 1);
  const auto read = std::from_chars(inside.data(), inside.data() + inside.size(), count);
  if (read.ec == std::errc{}) field.count = count;
  field.list = !field.count;
  field.type = field.type.substr(0, bracket);
  return field;
}

const Definition::Fields* Definition::find(std::string_view type) const {
  const auto found = types_.find(type);
  return found == types_.end() ? nullptr : &found->second;
}

std::optional<std::string> Definition::with_frames(std::string_view message,
                                                   std::string_view prefix) const {
  CdrReader in(message);
  Cdr out;
  if (!message.starts_with(std::string_view("\0\1", 2)) || !copy(root_, in, out, prefix)) return {};
  return out.take();
}

bool Definition::copy(const Fields& fields, CdrReader& in, Cdr& out,
                      std::string_view prefix) const {
  for (const Field& field : fields) {
    const std::size_t count = field.list ? in.get<std::uint32_t>() : field.count.value_or(1);
    if (field.list) out.put(static_cast<std::uint32_t>(count));
    if (size_of(field.type) == 1) {  // fast path for pictures
      out.bytes(in.bytes(count));
    } else {
      for (std::size_t i = 0; i < count && in.good; ++i) {
        if (!copy_one(field, in, out, prefix)) return false;
      }
    }
  }
  return in.good;
}

bool Definition::copy_one(const Field& field, CdrReader& in, Cdr& out,
                          std::string_view prefix) const {
  if (field.type == "string") {
    const std::string_view text = in.text();
    out.text(field.name.ends_with("frame_id") ? frame(text, prefix) : std::string(text));
  } else if (const std::size_t size = size_of(field.type)) {
    copy_number(size, in, out);
  } else {
    const Fields* inner = find(field.type);
    return inner != nullptr && copy(*inner, in, out, prefix);
  }
  return in.good;
}

std::string urdf_with_links(std::string urdf, std::string_view prefix) {
  for (const std::string_view before : {"<link name=\"", "<parent link=\"", "<child link=\""}) {
    for (std::size_t at = urdf.find(before); at != std::string::npos; at = urdf.find(before, at)) {
      at += before.size();
      urdf.insert(at, prefix);
    }
  }
  return urdf;
}

}  // namespace verp::record::ros
