#include "host/robot/model/malformed_xml.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "host/os/files/whole.hpp"
#include "host/robot/model/encoding.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::model {
namespace {

struct Tag {
  std::string name;
  std::size_t at = 0;
};

class Tags {
 public:
  explicit Tags(const std::string& text) : text_(text) {}

  Malformed check() {
    for (std::size_t at = text_.find('<'); at != text_.npos; at = text_.find('<', at)) {
      const std::string_view rest = std::string_view(text_).substr(at);
      const char* const end = rest.starts_with("<!--")        ? "-->"
                              : rest.starts_with("<![CDATA[") ? "]]>"
                              : rest.starts_with("<?")        ? "?>"
                              : rest.starts_with("<!")        ? ">"
                                                              : nullptr;
      const std::size_t next = end != nullptr ? after(end, at) : tag(at);
      if (next == text_.npos && found_.line == 0)
        found_ = {line_of(at), "what begins here does not end"};
      if (found_.line != 0) return found_;
      at = next;
    }
    if (!open_.empty()) {
      found_ = {line_of(text_.size()), "the file ends, and " + words(open_.back()) + " is open"};
    }
    return found_;
  }

 private:
  std::size_t after(std::string_view what, std::size_t from) const {
    const std::size_t at = text_.find(what, from);
    return at == text_.npos ? at : at + what.size();
  }
  int line_of(std::size_t at) const {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at, text_.size()));
    return 1 + static_cast<int>(std::count(text_.begin(), end, '\n'));
  }
  std::string words(const Tag& tag) const {
    return "<" + tag.name + "> of line " + std::to_string(line_of(tag.at));
  }

  /// Position after the tag.
  std::size_t tag(std::size_t at) {
    const bool closes = text_.compare(at, 2, "</") == 0;
    const std::size_t begin = at + (closes ? 2 : 1);
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n/>", begin), text_.size());
    const Tag it{text_.substr(begin, end - begin), at};
    tags_.push_back(at);
    char quote = 0;
    for (std::size_t i = end; i < text_.size(); ++i) {
      const char c = text_[i];
      if (c == '<') {
        found_ = {line_of(at),
                  "the tag <" + it.name + "> " +
                      (quote != 0 ? "has a quote that is not closed" : "is not ended by '>'")};
        return i;
      }
      if (quote != 0) {
        quote = c == quote ? '\0' : quote;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        if (closes) close(it);
        if (!closes && text_[i - 1] != '/') open_.push_back(it);
        return i + 1;
      }
    }
    return text_.npos;
  }

  void close(const Tag& it) {
    if (!open_.empty() && open_.back().name == it.name) return open_.pop_back();
    const auto same = std::find_if(open_.rbegin(), open_.rend(),
                                   [&](const Tag& each) { return each.name == it.name; });
    if (same == open_.rend()) {
      found_ = {line_of(should_be_opened_at(it)),
                "</" + it.name + "> of line " + std::to_string(line_of(it.at)) + " closes nothing" +
                    (open_.empty() ? "" : "; " + words(open_.back()) + " is open")};
    } else {
      const Tag& unclosed = *(same - 1);
      found_ = {line_of(should_be_closed_at(unclosed)),
                words(unclosed) + " is not closed before </" + it.name + "> of line " +
                    std::to_string(line_of(it.at))};
    }
  }

  // Both rely on the usual indentation.
  /// Next tag indented no more than `unclosed`.
  std::size_t should_be_closed_at(const Tag& unclosed) const {
    for (const std::size_t at : tags_) {
      if (at > unclosed.at && is_first(at) && column(at) <= column(unclosed.at)) return at;
    }
    return unclosed.at;
  }
  /// First tag of the more indented block before `end`.
  std::size_t should_be_opened_at(const Tag& end) const {
    std::size_t begin = end.at;
    for (auto at = tags_.rbegin(); at != tags_.rend() && is_first(end.at); ++at) {
      if (*at >= end.at || !is_first(*at)) continue;
      if (column(*at) <= column(end.at)) break;
      begin = *at;
    }
    return begin;
  }
  bool is_first(std::size_t at) const {
    return at == 0 || text_.find_last_not_of(" \t", at - 1) == text_.rfind('\n', at);
  }
  std::size_t column(std::size_t at) const {
    const std::size_t line = text_.rfind('\n', at);
    return line == text_.npos ? at : at - line - 1;
  }

  const std::string& text_;
  std::vector<Tag> open_;
  std::vector<std::size_t> tags_;
  Malformed found_;
};

}  // namespace

Malformed find_malformed(const std::string& text) {
  Malformed found = Tags(text).check();
  // Hide control bytes of a binary file from the terminal.
  std::replace_if(
      found.why.begin(), found.why.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return found;
}

std::string parse_xml(const std::string& path, const std::string& bytes,
                      tinyxml2::XMLDocument& document) {
  std::string text = utf8_of(path, bytes);
  if (document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS &&
      document.RootElement() != nullptr) {
    require_utf8(path, text);
    const auto* const second = document.RootElement()->NextSiblingElement();
    if (second == nullptr) return text;
    throw LoadError(path, second->GetLineNum(),
                    "a second outer element, <" + std::string(second->Name()) + ">, begins here",
                    "XML has one: put what follows into a file of its own, or remove it");
  }
  const Malformed found = find_malformed(text);
  throw LoadError(
      path, found.line > 0 ? found.line : std::max(1, document.ErrorLineNum()),
      "malformed XML (" + (found.line > 0 ? found.why : std::string(document.ErrorName())) + ")",
      "up to this line, close every tag and quote, and give no attribute twice");
}

void load_xml(const std::string& path, tinyxml2::XMLDocument& document) {
  const auto text = files::read(path);
  if (!text) throw LoadError(path, 0, "cannot be read", "check its name, rights and length");
  parse_xml(path, *text, document);
}

}  // namespace verp::model
