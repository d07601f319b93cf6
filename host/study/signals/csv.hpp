#pragma once
#include <iosfwd>

#include "host/study/signals/table.hpp"

namespace verp::signals {

void write_csv(Table& table, std::ostream& out);

}  // namespace verp::signals
