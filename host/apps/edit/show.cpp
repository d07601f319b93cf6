#include "host/apps/edit/commands.hpp"

namespace verp::edit {

std::string show(const Document& document, int element) {
  std::string out;
  const std::string path = document.path(element);
  const Element& own = document.markup()[element];
  for (const Attribute& each : own.attributes)
    out += path + "@" + each.name + "=" + each.value + "\n";
  if (own.children.empty()) {
    const std::string text = document.text_of(element);
    if (!text.empty()) out += path + "=" + text + "\n";
    if (text.empty() && own.attributes.empty()) out += path + "\n";
  }
  for (const int child : own.children) out += show(document, child);
  return out;
}

}  // namespace verp::edit
