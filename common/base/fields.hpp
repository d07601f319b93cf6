#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

/// One field list, many uses. A plain struct names its fields once:
///
///     struct Tilt { float roll_rad = 0; float pitch_rad = 0; VERP_FIELDS(roll_rad, pitch_rad) };
///     VERP_PACKED(Tilt);
///
/// Digest, trace, print, diff and the Params image use that list. VERP_PACKED rejects a missing
/// field or padding: the memory *is* the canonical little-endian image.
#define VERP_FIELDS(...)                                    \
  template <class Self, class Visit>                        \
  static constexpr void fields(Self& self, Visit&& visit) { \
    VERP_EXPAND(VERP_EACH_FIELD(__VA_ARGS__))               \
  }
#define VERP_PACKED(Type)                                                \
  static_assert(::verp::packed_size<Type>() == sizeof(Type),             \
                #Type ": padding, or a field missing from VERP_FIELDS"); \
  static_assert(std::is_trivially_copyable_v<Type>, #Type " must be plain data")

#define VERP_PARENS ()
#define VERP_EACH_FIELD(name, ...) \
  visit(#name, self.name);         \
  __VA_OPT__(VERP_EACH_AGAIN VERP_PARENS(__VA_ARGS__))
#define VERP_EACH_AGAIN() VERP_EACH_FIELD
#define VERP_EXPAND(...) VERP_EXPAND3(VERP_EXPAND3(VERP_EXPAND3(VERP_EXPAND3(__VA_ARGS__))))
#define VERP_EXPAND3(...) VERP_EXPAND2(VERP_EXPAND2(VERP_EXPAND2(VERP_EXPAND2(__VA_ARGS__))))
#define VERP_EXPAND2(...) VERP_EXPAND1(VERP_EXPAND1(VERP_EXPAND1(VERP_EXPAND1(__VA_ARGS__))))
#define VERP_EXPAND1(...) __VA_ARGS__

namespace verp {

template <class T>
concept HasFields = requires(T& t) {
  T::fields(t, [](const char*, auto&) {});
};

template <class T>
consteval std::size_t packed_size() {
  if constexpr (std::is_array_v<T>) {
    return std::extent_v<T> * packed_size<std::remove_extent_t<T>>();
  } else if constexpr (HasFields<T>) {
    std::size_t bytes = 0;
    T value{};
    T::fields(value, [&]<class Field>(const char*, Field&) { bytes += packed_size<Field>(); });
    return bytes;
  } else {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    return sizeof(T);
  }
}

/// Calls leaf(value) for every scalar, in field order.
template <class T, class Leaf>
constexpr void for_each_leaf(T& value, Leaf&& leaf) {
  using Plain = std::remove_const_t<T>;
  if constexpr (std::is_array_v<Plain>) {
    for (auto& element : value) for_each_leaf(element, leaf);
  } else if constexpr (HasFields<Plain>) {
    Plain::fields(value, [&](const char*, auto& field) { for_each_leaf(field, leaf); });
  } else {
    leaf(value);
  }
}

}  // namespace verp
