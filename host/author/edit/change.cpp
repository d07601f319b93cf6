#include "host/author/edit/change.hpp"

#include <algorithm>

#include "host/author/edit/names.hpp"

namespace verp::edit {
namespace {

constexpr std::string_view kBlank = " \t\r";

bool is_blank(std::string_view text) {
  return text.find_first_not_of(kBlank) == text.npos;
}

std::size_t line_begin(const std::string& text, std::size_t at) {
  return at == 0 ? 0 : text.rfind('\n', at - 1) + 1;  // npos + 1 is 0
}

std::string indent_at(const std::string& text, std::size_t at) {
  const std::size_t begin = line_begin(text, at);
  const std::size_t end = std::min(text.find_first_not_of(" \t", begin), at);
  return text.substr(begin, end - begin);
}

std::string line_break(const std::string& text) {
  return text.find("\r\n") != text.npos ? "\r\n" : "\n";
}

std::string indented(const std::string& block, const std::string& indent, const std::string& end) {
  std::string out;
  for (const char c : block) out += c == '\n' ? end + indent : std::string(1, c);
  return out;
}

/// The element owns comments up to the line's end.
std::size_t end_of_line_of(const std::string& text, std::size_t at, std::size_t limit) {
  std::size_t end = at;
  while (end < limit) {
    if (text.compare(end, 4, "<!--") == 0) {
      const std::size_t close = text.find("-->", end);
      if (std::count(text.begin() + std::ptrdiff_t(end), text.begin() + std::ptrdiff_t(close),
                     '\n'))
        return at;
      end = close + 3;
    } else if (text[end] == '\n') {
      return end > at && text[end - 1] == '\r' ? end - 1 : end;
    } else if (kBlank.find(text[end]) != kBlank.npos) {
      ++end;
    } else {
      return at;
    }
  }
  return at;
}

void require_words(const Document& document, const std::string& what, const std::string& value) {
  const bool control = std::any_of(value.begin(), value.end(), [](unsigned char c) {
    return c < 0x20 && c != '\t' && c != '\n';
  });
  if (!control && value.size() < 10'000) return;
  throw model::LoadError(document.file().string(), 0, what + ": not a text for XML",
                         "leave out control characters");
}

bool is_xml_name(std::string_view name) {
  const auto letter = [](unsigned char c) { return std::isalpha(c) || c == '_' || c >= 0x80; };
  return !name.empty() && letter(static_cast<unsigned char>(name.front())) &&
         std::all_of(name.begin(), name.end(), [&](unsigned char c) {
           return letter(c) || std::isdigit(c) || c == '-' || c == '.' || c == ':';
         });
}

Edit set_attribute(const Document& document, int index, const std::string& name,
                   const std::string& value) {
  const Element& element = document.markup()[index];
  const std::string text = escaped(value);
  if (const Attribute* there = element.attribute(name)) {
    const std::string before =
        document.text().substr(there->value_at.begin, there->value_at.size());
    const char quote = document.text()[there->value_at.end];
    std::string after;
    for (const char c : text) after += c == '\'' && quote == c ? "&apos;" : std::string(1, c);
    if (before == after) return {};
    return {"", {{there->value_at.begin, before, after}}};
  }
  if (!is_xml_name(name)) {
    throw model::LoadError(document.file().string(), element.line,
                           "'" + name + "' cannot be an attribute", "write PATH@name");
  }
  const std::size_t at = element.attributes.empty() ? element.whole.begin + 1 + element.name.size()
                                                    : element.attributes.back().at.end;
  return {"", {{at, "", " " + name + "=\"" + text + "\""}}};
}

Edit set_text(const Document& document, int index, const std::string& value) {
  const Element& element = document.markup()[index];
  if (!element.children.empty()) {
    std::string inner;
    for (const int each : element.children) inner += " " + short_name(document.markup()[each].name);
    throw model::LoadError(document.file().string(), element.line,
                           document.path(index) + " is no number or word",
                           "set one of its parts:" + inner);
  }
  if (element.closed_at_once) {
    const std::size_t at = document.text().rfind('/', element.whole.end);
    return {"", {{at, "/>", ">" + escaped(value) + "</" + element.name + ">"}}};
  }
  const Range at = document.markup().text_at(index, document.text());
  const std::string before = document.text().substr(at.begin, at.size());
  if (before == escaped(value)) return {};
  return {"", {{at.begin, before, escaped(value)}}};
}

/// The elements that a path lacks at its end, nested around a value.
Edit make_missing(const Document& document, const std::string& path, const std::string& attribute,
                  const std::string& value) {
  std::string rest = path, open, close;
  std::optional<int> at;
  while (!at) {
    const std::size_t slash = rest.rfind('/');
    const std::string name = rest.substr(slash + 1);
    if (slash == rest.npos || !is_xml_name(name) || name.find(':') != name.npos)
      document.find(path);
    const bool innermost = open.empty();
    open = "<" + name +
           (innermost && !attribute.empty() ? " " + attribute + "=\"" + escaped(value) + "\"/>"
                                            : ">") +
           open;
    if (!(innermost && !attribute.empty())) close += "</" + name + ">";
    if (innermost && attribute.empty()) open += escaped(value);
    rest = rest.substr(0, slash);
    at = document.look_for(rest);
  }
  return insert(document, *at, open + close);
}

}  // namespace

std::size_t behind(const Document& document, int element) {
  const Element& own = document.markup()[element];
  return end_of_line_of(document.text(), own.whole.end, document.markup()[own.parent].content.end);
}

Edit together(const Document& document, const std::string& what,
              const std::function<void(Document&)>& changes) {
  Document scratch = document;
  changes(scratch);
  const std::string &from = document.text(), &to = scratch.text();
  if (from == to) return {what, {}};
  const auto begin = std::mismatch(from.begin(), from.end(), to.begin(), to.end());
  const auto head = begin.first - from.begin();
  const auto end = std::mismatch(from.rbegin(), from.rend() - head, to.rbegin(), to.rend() - head);
  return {what,
          {{std::size_t(head), std::string(begin.first, end.first.base()),
            std::string(begin.second, end.second.base())}}};
}

Edit set(const Document& document, const std::string& path, const std::string& value) {
  require_words(document, path, value);
  const std::size_t at = path.rfind('@');
  const std::string element = path.substr(0, at);
  const std::string attribute = at == path.npos ? "" : path.substr(at + 1);
  const auto found = document.look_for(element);
  Edit edit = !found              ? make_missing(document, element, attribute, value)
              : attribute.empty() ? set_text(document, *found, value)
                                  : set_attribute(document, *found, attribute, value);
  edit.what = "set " + path;
  return edit;
}

Edit insert(const Document& document, int parent, const std::string& block, int after) {
  const std::string& text = document.text();
  const Element& into = document.markup()[parent];
  const std::string end = line_break(text), outer = indent_at(text, into.whole.begin);
  std::string indent = outer + "  ";
  if (after < 0 && !into.children.empty()) after = into.children.back();
  const auto done = [&](std::size_t at, std::string before, const std::string& made) {
    return Edit{"add", {{at, std::move(before), made}}};
  };
  if (into.closed_at_once) {
    const std::size_t slash = text.rfind('/', into.whole.end);
    return done(
        slash, "/>",
        ">" + end + indent + indented(block, indent, end) + end + outer + "</" + into.name + ">");
  }
  const std::string_view content =
      std::string_view(text).substr(into.content.begin, into.content.size());
  if (after >= 0) {
    const Element& sibling = document.markup()[after];
    const bool one_line = content.find('\n') == content.npos && block.find('\n') == block.npos;
    if (one_line) return done(sibling.whole.end, "", block);
    indent = indent_at(text, sibling.whole.begin);
    return done(behind(document, after), "", end + indent + indented(block, indent, end));
  }
  const std::size_t last = content.rfind('\n');
  if (last != content.npos && is_blank(content.substr(last + 1))) {
    std::size_t at = into.content.begin + last;
    if (at > into.content.begin && text[at - 1] == '\r') --at;
    return done(at, "", end + indent + indented(block, indent, end));
  }
  return done(into.content.end, "", end + indent + indented(block, indent, end) + end + outer);
}

Edit remove(const Document& document, int element) {
  if (element == document.model() || element == document.markup().root()) {
    throw model::LoadError(document.file().string(), document.markup()[element].line,
                           "the robot itself is not a part of it", "remove the file instead");
  }
  const std::string& text = document.text();
  Edit edit{"delete " + document.path(element), {}};
  std::size_t done = 0;
  for (const int each : what_hangs_on(document, element)) {
    Range at = document.markup()[each].whole;
    const std::size_t begin = std::max(done, line_begin(text, at.begin));
    const std::size_t end = text.find('\n', at.end);
    const bool alone = is_blank(std::string_view(text).substr(begin, at.begin - begin)) &&
                       begin == line_begin(text, at.begin) && end != text.npos &&
                       is_blank(std::string_view(text).substr(at.end, end - at.end));
    if (alone) at = {begin, end + 1};
    edit.splices.push_back({at.begin, text.substr(at.begin, at.size()), ""});
    done = at.end;
  }
  return edit;
}

Edit rename(const Document& document, int element, const std::string& name) {
  const Kind kind = kind_of(document, element);
  const std::string old = document.attribute(element, "name");
  Edit edit{"rename " + document.path(element) + " to " + name, {}};
  require_words(document, "the name", name);
  if (name.empty() || kind == Kind::kNone) {
    Edit simple = set_attribute(document, element, "name", name);
    simple.what = edit.what;
    return simple;
  }
  if (old == name) return edit;
  if (is_taken(document, kind, name)) {
    throw model::LoadError(document.file().string(), document.markup()[element].line,
                           "'" + name + "' is there already", "choose another name");
  }
  for (const Mention& each : mentions(document, kind)) {
    if (each.name != old || (each.defines && each.element != element)) continue;
    edit.splices.push_back(
        {each.at.begin, document.text().substr(each.at.begin, each.at.size()), escaped(name)});
  }
  return edit;
}

}  // namespace verp::edit
