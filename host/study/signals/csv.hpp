#pragma once
#include <iosfwd>

#include "host/study/signals/table.hpp"

namespace verp::signals {

/// Writes the remaining rows of a table, after a line of names.
void write_csv(Table& table, std::ostream& out);

}  // namespace verp::signals
