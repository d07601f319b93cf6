#pragma once
#include <iosfwd>

#include "host/study/signals/table.hpp"

namespace verp::signals {

/// What is left of a table: a line of names, and one a tick.
void write_csv(Table& table, std::ostream& out);

}  // namespace verp::signals
