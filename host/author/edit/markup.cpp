#include "host/author/edit/markup.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "host/robot/model/load_error.hpp"

namespace verp::edit {
namespace {

constexpr std::string_view kSpace = " \t\r\n";
constexpr std::size_t kDeepest = 200;  // nesting; a robot has ten
constexpr std::array<std::pair<std::string_view, char>, 5> kNamed = {
    {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}}};

std::string unescaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto* named = std::find_if(kNamed.begin(), kNamed.end(), [&](const auto& each) {
      return text.starts_with(each.first);
    });
    out += named == kNamed.end() ? text.front() : named->second;
    text.remove_prefix(named == kNamed.end() ? 1 : named->first.size());
  }
  return out;
}

/// A stack, no recursion: the file must not choose its depth.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file, std::vector<Element>& out)
      : text_(text), file_(file), out_(out) {}

  void run() {
    while (at_ < text_.size()) {
      const std::size_t tag = text_.find('<', at_);
      if (tag == text_.npos) break;
      count_lines(tag);
      if (skip("<!--", "-->") || skip("<![CDATA[", "]]>") || skip("<?", "?>") || skip("<!", ">"))
        continue;
      text_.substr(at_).starts_with("</") ? close() : open();
    }
    if (!stack_.empty()) fail("<" + top().name + "> is never closed");
    if (out_.empty()) fail("there is no element in it");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw model::LoadError(file_, line_, "malformed XML: " + what,
                           "up to this line, close every tag and quote");
  }

  Element& top() { return out_[std::size_t(stack_.back())]; }

  void count_lines(std::size_t to) {
    line_ += int(
        std::count(text_.begin() + std::ptrdiff_t(at_), text_.begin() + std::ptrdiff_t(to), '\n'));
    at_ = to;
  }

  bool skip(std::string_view begin, std::string_view end) {
    if (!text_.substr(at_).starts_with(begin)) return false;
    const std::size_t found = text_.find(end, at_ + begin.size());
    if (found == text_.npos) fail("'" + std::string(begin) + "' has no end");
    count_lines(found + end.size());
    return true;
  }

  std::string word() {
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n=/>\"'<", at_), text_.size());
    std::string found(text_.substr(at_, end - at_));
    at_ = end;
    return found;
  }

  void pass_space() { count_lines(std::min(text_.find_first_not_of(kSpace, at_), text_.size())); }

  void close() {
    const std::size_t begin = at_;
    at_ += 2;
    const std::string name = word();
    pass_space();
    if (stack_.empty() || top().name != name) fail("</" + name + "> closes nothing");
    if (at_ >= text_.size() || text_[at_] != '>') fail("</" + name + " has no >");
    top().content.end = begin;
    top().whole.end = ++at_;
    stack_.pop_back();
  }

  void open() {
    if (stack_.empty() && !out_.empty()) fail("a second element beside the first");
    if (stack_.size() == kDeepest) fail("elements in more than 200 others");
    Element element;
    element.whole.begin = at_++;
    element.line = line_;
    element.name = word();
    if (element.name.empty()) fail("'<' without a name");
    element.parent = stack_.empty() ? -1 : stack_.back();
    while (read_attribute(element)) {
    }
    element.closed_at_once = text_[at_] == '/';
    at_ += element.closed_at_once ? 2 : 1;
    element.content = {at_, at_};
    element.whole.end = at_;
    const int index = int(out_.size());
    if (!stack_.empty()) top().children.push_back(index);
    if (!element.closed_at_once) stack_.push_back(index);
    out_.push_back(std::move(element));
  }

  bool read_attribute(Element& element) {
    pass_space();
    if (at_ >= text_.size()) fail("<" + element.name + " has no >");
    if (text_[at_] == '>' || text_.substr(at_).starts_with("/>")) return false;
    Attribute attribute;
    attribute.at.begin = at_;
    attribute.name = word();
    pass_space();
    if (attribute.name.empty() || at_ >= text_.size() || text_[at_] != '=')
      fail("an attribute of <" + element.name + "> that is not name=\"value\"");
    ++at_;
    pass_space();
    const char quote = at_ < text_.size() ? text_[at_] : ' ';
    const std::size_t end = text_.find(quote, at_ + 1);
    if ((quote != '"' && quote != '\'') || end == text_.npos)
      fail(attribute.name + " of <" + element.name + "> is not in quotes");
    if (element.attribute(attribute.name)) fail(attribute.name + " is given twice");
    attribute.value_at = {at_ + 1, end};
    attribute.value = unescaped(text_.substr(at_ + 1, end - at_ - 1));
    count_lines(end + 1);
    attribute.at.end = at_;
    element.attributes.push_back(std::move(attribute));
    return true;
  }

  std::string_view text_;
  const std::string& file_;
  std::vector<Element>& out_;
  std::vector<int> stack_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

const Attribute* Element::attribute(std::string_view wanted) const {
  for (const Attribute& each : attributes) {
    if (each.name == wanted) return &each;
  }
  return nullptr;
}

Markup::Markup(const std::string& text, const std::string& file) {
  Scanner(text, file, elements_).run();
}

Range Markup::text_at(int index, std::string_view of) const {
  const Element& element = (*this)[index];
  Range at = element.content;
  if (!element.children.empty()) return {at.end, at.end};
  while (at.begin < at.end) {
    if (of.substr(at.begin).starts_with("<!--")) {
      at.begin = of.find("-->", at.begin) + 3;
    } else if (kSpace.find(of[at.begin]) != kSpace.npos) {
      ++at.begin;
    } else {
      break;
    }
  }
  at.end = std::min(at.end, std::max(at.begin, of.find('<', at.begin)));
  while (at.begin < at.end && kSpace.find(of[at.end - 1]) != kSpace.npos) --at.end;
  return at;
}

std::string Markup::text(int index, std::string_view of) const {
  const Range at = text_at(index, of);
  return unescaped(of.substr(at.begin, at.size()));
}

std::string escaped(std::string_view value) {
  std::string out;
  for (const char c : value) {
    const auto* named = std::find_if(kNamed.begin(), kNamed.end(),
                                     [c](const auto& each) { return each.second == c; });
    out += named == kNamed.end() || c == '\'' || c == '>' ? std::string(1, c)
                                                          : std::string(named->first);
  }
  return out;
}

int line_at(std::string_view text, std::size_t byte) {
  return 1 + int(std::count(text.begin(),
                            text.begin() + std::ptrdiff_t(std::min(byte, text.size())), '\n'));
}

}  // namespace verp::edit
