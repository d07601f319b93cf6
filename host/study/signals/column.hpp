#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/model/params.hpp"

/// A trace as columns of numbers: a row per tick, a column per signal.
namespace verp::signals {

enum class Format : std::uint8_t {
  kWhole,
  kFixed4,
  kFixed6,
  kDigits5,  ///< five significant digits
  kDigits6,
  kState,  ///< a field of State, as in fields.hpp
};

/// SI units; sensor axes are those of the IMU.
struct Column {
  std::string name;     ///< may contain a joint name, which comes from a file
  std::string unit;     ///< empty: no unit, for example a phase
  std::string subject;  ///< measured and goal of a joint have the same subject
  Format format = Format::kWhole;
};

/// In CSV order; `states` adds every field of the controller's State.
std::vector<Column> columns_of(const Params& params, bool states);

/// Indices that match `pattern`, in order: the column of that name, else all that match it with `*`
/// for any characters and `?` for one. Empty: none.
std::vector<std::size_t> matching(const std::vector<Column>& columns, std::string_view pattern);

}  // namespace verp::signals
