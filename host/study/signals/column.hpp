#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/model/params.hpp"

/// A row per tick, a column per signal.
namespace verp::signals {

enum class Format : std::uint8_t {
  kWhole,
  kFixed4,
  kFixed6,
  kDigits5,  ///< five significant digits
  kDigits6,
  kState,  ///< a field of State
};

/// SI units; sensor axes are those of the IMU.
struct Column {
  std::string name;     ///< may contain a joint name from a file
  std::string unit;     ///< empty: no unit
  std::string subject;  ///< same for measured and goal of a joint
  Format format = Format::kWhole;
};

/// Columns in CSV order; `states` adds all fields of State.
std::vector<Column> columns_of(const Params& params, bool states);

/// The column of that name, else all that match with `*` and `?`.
std::vector<std::size_t> matching(const std::vector<Column>& columns, std::string_view pattern);

}  // namespace verp::signals
