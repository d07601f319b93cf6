#include "host/study/tune/write.hpp"

#include <fmt/format.h>

#include "host/author/edit/change.hpp"

namespace verp::tune {

void write(const std::vector<Number>& numbers, const std::filesystem::path& robot_file,
           const std::filesystem::path& file) {
  edit::Document document(file, edit::Document::open(robot_file).text());
  for (const Number& number : numbers) {
    const std::string value = fmt::format("{}", number.now);
    const int count = static_cast<int>(document.markup().elements().size());
    int there = -1;
    for (int i = 0; i < count; ++i) {
      if (document.markup()[i].name == "verp:tuning" &&
          document.attribute(i, "name") == number.name) {
        there = i;
      }
    }
    document.apply(there >= 0 ? edit::set(document, document.path(there) + "@value", value)
                              : edit::insert(document, document.model(),
                                             fmt::format(R"(<verp:tuning name="{}" value="{}"/>)",
                                                         number.name, value)));
  }
  document.save();
}

}  // namespace verp::tune
