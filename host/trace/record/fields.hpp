#pragma once
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/base/fields.hpp"

/// Names and text of any VERP_FIELDS struct.
namespace verp::record {

/// A differing scalar; `path` reads like the source: "gait.step[1].x_m".
struct FieldDifference {
  std::string path;
  std::string left;
  std::string right;
};

/// "0.1 (0x3dcccccd)", "-12 (0xfff4)": decimal and bits. Floats have the fewest digits that
/// identify them.
template <class Scalar>
std::string scalar_text(Scalar value) {
  if constexpr (std::is_same_v<Scalar, float>) {
    return fmt::format("{} (0x{:08x})", value, std::bit_cast<std::uint32_t>(value));
  } else if constexpr (std::is_same_v<Scalar, bool>) {
    return value ? "1 (0x01)" : "0 (0x00)";
  } else if constexpr (std::is_enum_v<Scalar>) {
    return scalar_text(static_cast<std::underlying_type_t<Scalar>>(value));
  } else {
    using Bits = std::make_unsigned_t<Scalar>;
    return fmt::format("{} (0x{:0{}x})", static_cast<long long>(value), static_cast<Bits>(value),
                       2 * sizeof(Scalar));
  }
}

template <class Scalar>
std::string scalar_plain(Scalar value) {
  if constexpr (std::is_enum_v<Scalar>) {
    return scalar_plain(static_cast<std::underlying_type_t<Scalar>>(value));
  } else if constexpr (std::is_same_v<Scalar, char>) {
    return fmt::format("{}", static_cast<int>(value));
  } else {
    return fmt::format("{}", value);
  }
}

template <class Scalar>
constexpr const char* scalar_type_name() {
  using Plain = std::remove_cv_t<Scalar>;
  if constexpr (std::is_enum_v<Plain>) {
    return scalar_type_name<std::underlying_type_t<Plain>>();
  } else if constexpr (std::is_same_v<Plain, float>) {
    return "float32";
  } else if constexpr (std::is_same_v<Plain, char>) {
    return "char";
  } else {
    constexpr bool kSigned = std::is_signed_v<Plain>;
    constexpr std::size_t kBits = 8 * sizeof(Plain);
    if constexpr (kBits == 8) return kSigned ? "int8" : "uint8";
    if constexpr (kBits == 16) return kSigned ? "int16" : "uint16";
    if constexpr (kBits == 32) return kSigned ? "int32" : "uint32";
    return kSigned ? "int64" : "uint64";
  }
}

/// Calls leaf(path, scalar) in field order. `path` is a reused buffer: copy it.
template <class T, class Leaf>
void for_each_named_leaf(T& value, std::string& path, Leaf&& leaf) {
  using Plain = std::remove_const_t<T>;
  const std::size_t length = path.size();
  if constexpr (std::is_array_v<Plain>) {
    for (std::size_t i = 0; i < std::extent_v<Plain>; ++i) {
      path += fmt::format("[{}]", i);
      for_each_named_leaf(value[i], path, leaf);
      path.resize(length);
    }
  } else if constexpr (HasFields<Plain>) {
    Plain::fields(value, [&](const char* name, auto& field) {
      if (length > 0) path += '.';
      path += name;
      for_each_named_leaf(field, path, leaf);
      path.resize(length);
    });
  } else {
    leaf(path, value);
  }
}

/// At most `limit` differences, in field order. Bitwise, like the digest: 0 and -0 differ, equal
/// NaNs don't.
template <class T>
std::vector<FieldDifference> diff_fields(const T& left, const T& right, std::size_t limit = 64) {
  std::vector<FieldDifference> differences;
  if (std::memcmp(&left, &right, sizeof(T)) == 0) return differences;
  const auto* right_bytes = reinterpret_cast<const unsigned char*>(&right);
  std::size_t offset = 0;  // field order is memory order
  std::string path;
  for_each_named_leaf(left, path, [&](const std::string& name, const auto& scalar) {
    auto other = scalar;
    std::memcpy(&other, right_bytes + offset, sizeof(other));
    offset += sizeof(other);
    if (std::memcmp(&scalar, &other, sizeof(other)) == 0 || differences.size() >= limit) return;
    differences.push_back({name, scalar_text(scalar), scalar_text(other)});
  });
  return differences;
}

/// Path and decimal value of every scalar.
template <class T>
std::vector<std::pair<std::string, std::string>> print_fields(const T& value) {
  std::vector<std::pair<std::string, std::string>> rows;
  std::string path;
  for_each_named_leaf(value, path, [&](const std::string& name, const auto& scalar) {
    rows.emplace_back(name, scalar_plain(scalar));
  });
  return rows;
}

namespace detail {
template <class T>
void describe(const T& value, std::size_t& offset, std::string& path, std::string& out) {
  if constexpr (std::is_array_v<T>) {
    if constexpr (!std::is_array_v<std::remove_extent_t<T>> &&
                  !HasFields<std::remove_extent_t<T>>) {
      using Scalar = std::remove_cv_t<std::remove_extent_t<T>>;
      out += fmt::format("{:6} {:8} {}[{}]\n", offset, scalar_type_name<Scalar>(), path,
                         std::extent_v<T>);
      offset += sizeof(T);
    } else {
      const std::size_t length = path.size();
      for (std::size_t i = 0; i < std::extent_v<T>; ++i) {
        path += fmt::format("[{}]", i);
        describe(value[i], offset, path, out);
        path.resize(length);
      }
    }
  } else if constexpr (HasFields<T>) {
    const std::size_t length = path.size();
    T::fields(value, [&](const char* name, const auto& field) {
      if (length > 0) path += '.';
      path += name;
      describe(field, offset, path, out);
      path.resize(length);
    });
  } else {
    out += fmt::format("{:6} {:8} {}\n", offset, scalar_type_name<T>(), path);
    offset += sizeof(T);
  }
}
}  // namespace detail

/// One line per scalar or array: "byte-offset type path". It is a trace channel's schema: two
/// builds can exchange T if and only if it is equal.
template <class T>
std::string describe_layout(const char* name) {
  const T value{};
  std::size_t offset = 0;
  std::string path;
  std::string out =
      fmt::format("# {}: little-endian, packed, {} bytes\n# offset type field\n", name, sizeof(T));
  detail::describe(value, offset, path, out);
  return out;
}

}  // namespace verp::record
