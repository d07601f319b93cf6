#include "host/study/signals/csv.hpp"

#include <ostream>

#include "host/os/files/csv_field.hpp"

namespace verp::signals {

void write_csv(Table& table, std::ostream& out) {
  std::string line;
  for (const Column& column : table.columns()) {
    if (!line.empty()) line += ',';
    line += files::csv_field(column.name);
  }
  out << line << '\n';
  while (table.next()) {
    line.clear();
    for (std::size_t i = 0; i < table.columns().size(); ++i) {
      if (i > 0) line += ',';
      table.append_text(i, line);
    }
    out << line << '\n';
  }
}

}  // namespace verp::signals
