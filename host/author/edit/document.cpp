#include "host/author/edit/document.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>

#include "host/author/edit/names.hpp"
#include "host/robot/model/encoding.hpp"
#include "host/robot/model/load.hpp"

namespace verp::edit {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 16u << 20;  // a robot's file has 50 kB

std::string empty_robot(const fs::path& file) {
  std::string name = file.stem().string();
  if (name == "robot" && file.has_parent_path()) name = file.parent_path().filename().string();
  return "<?xml version=\"1.0\" ?>\n<sdf version=\"1.9\" xmlns:verp=\"https://verp.dev/sdf/1\">\n"
         "  <model name=\"" +
         escaped(name) + "\">\n  </model>\n</sdf>\n";
}

}  // namespace

Edit Edit::reversed() const {
  Edit back{"undo " + what, {}};
  std::ptrdiff_t moved = 0;
  for (const Splice& splice : splices) {
    const auto at = std::ptrdiff_t(splice.at) + moved;
    back.splices.push_back({std::size_t(at), splice.after, splice.before});
    moved += std::ptrdiff_t(splice.after.size()) - std::ptrdiff_t(splice.before.size());
  }
  return back;
}

Document Document::open(const fs::path& file, bool may_be_new) {
  std::error_code error;
  const bool is_new = may_be_new && !fs::exists(file, error);
  std::string text;
  if (!is_new) {
    std::ifstream in(file, std::ios::binary);
    const bool regular = fs::is_regular_file(file, error);
    if (!in || !regular || fs::file_size(file, error) > kMostBytes) {
      throw model::LoadError(file.string(), 0, regular ? "cannot be read" : "is not a file here",
                             "give the path of an SDF or URDF file");
    }
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  const bool nothing = text.find_first_not_of(" \t\r\n") == text.npos;
  Document document(file, nothing ? empty_robot(file) : model::utf8_of(file.string(), text));
  if (!is_new) document.on_disk_ = std::move(text);
  document.model();
  return document;
}

Document::Document(fs::path file, std::string text)
    : file_(std::move(file)), text_(std::move(text)), markup_(text_, file_.string()) {}

int Document::model() const {
  const Element& root = markup_[markup_.root()];
  if (root.name == "robot") return markup_.root();
  for (const int child : root.children) {
    if (root.name == "sdf" && markup_[child].name == "model") return child;
  }
  throw model::LoadError(file_.string(), root.line, "there is no robot in it",
                         "give a file with <sdf> and <model>, or a URDF");
}

std::string Document::with(const Edit& edit) const {
  std::string out;
  std::size_t from = 0;
  for (const Splice& splice : edit.splices) {
    if (splice.at < from || text_.compare(splice.at, splice.before.size(), splice.before) != 0) {
      throw model::LoadError(file_.string(), line_at(text_, splice.at),
                             "the text is not what this change was made for", "make it anew");
    }
    out.append(text_, from, splice.at - from);
    out += splice.after;
    from = splice.at + splice.before.size();
  }
  return out.append(text_, from);
}

void Document::apply(const Edit& edit) {
  std::string text = with(edit);
  markup_ = Markup(text, file_.string());
  text_ = std::move(text);
}

int Document::child(int element, std::string_view name) const {
  for (const int each : markup_[element].children) {
    if (markup_[each].name == name) return each;
  }
  return -1;
}

std::string Document::child_text(int element, std::string_view name) const {
  const int found = child(element, name);
  return found < 0 ? "" : text_of(found);
}

std::string Document::attribute(int element, std::string_view name) const {
  const Attribute* found = markup_[element].attribute(name);
  return found == nullptr ? "" : found->value;
}

std::string Document::path(int element) const {
  if (element == model() || element == markup_.root()) return "model";
  const Element& own = markup_[element];
  std::string name = short_name(own.name);
  const std::string key = key_of(own);
  std::vector<int> alike;
  for (const int each : markup_[own.parent].children) {
    if (markup_[each].name == own.name) alike.push_back(each);
  }
  const auto same_key = std::count_if(alike.begin(), alike.end(),
                                      [&](int each) { return key_of(markup_[each]) == key; });
  if (!key.empty() && same_key == 1 && key.find_first_of("/@=") == key.npos) {
    name += ":" + key;
  } else if (alike.size() > 1) {
    const auto at = std::find(alike.begin(), alike.end(), element) - alike.begin();
    name += ":" + std::to_string(at + 1);
  }
  return own.parent == model() ? name : path(own.parent) + "/" + name;
}

namespace {

struct Segment {
  std::string_view name, key;
};

Segment parted(std::string_view text) {
  if (text.starts_with("verp:")) text.remove_prefix(5);
  const std::size_t colon = text.find(':');
  if (colon == text.npos) return {text, {}};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

}  // namespace

/// Empty if several match without a key.
std::optional<int> Document::step(int from, std::string_view text) const {
  const Segment wanted = parted(text);
  std::vector<int> alike;
  for (const int each : markup_[from].children) {
    if (short_name(markup_[each].name) == wanted.name) alike.push_back(each);
  }
  if (wanted.key.empty()) return alike.size() == 1 ? std::optional(alike.front()) : std::nullopt;
  for (const int each : alike) {
    if (key_of(markup_[each]) == wanted.key) return each;
  }
  std::size_t number = 0;
  const char* end = wanted.key.data() + wanted.key.size();
  const bool is_number = std::from_chars(wanted.key.data(), end, number).ptr == end;
  if (is_number && number >= 1 && number <= alike.size()) return alike[number - 1];
  return std::nullopt;
}

std::optional<int> Document::look_for(const std::string& path) const {
  std::string_view rest = path;
  int at = model();
  for (bool first = true; !rest.empty(); first = false) {
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string_view segment = rest.substr(0, slash);
    rest.remove_prefix(std::min(slash + 1, rest.size()));
    if (first && segment == "model") continue;
    std::optional<int> next = step(at, segment);
    // A name that only one part has needs no longer path.
    for (std::size_t i = 0; first && !next && i < markup_.elements().size(); ++i) {
      if (int(i) == at) continue;
      const auto inner = step(int(i), segment);
      const bool another = inner && std::any_of(markup_.elements().begin() + std::ptrdiff_t(i) + 1,
                                                markup_.elements().end(), [&](const Element& e) {
                                                  return step(int(&e - &markup_[0]), segment);
                                                });
      if (inner && !another) next = inner;
    }
    if (!next) return std::nullopt;
    at = *next;
  }
  return at;
}

int Document::find(const std::string& path) const {
  if (const auto found = look_for(path)) return *found;
  // Lists what exists where the path ends.
  const std::size_t slash = path.rfind('/');
  const auto whole = slash == path.npos ? std::optional(model()) : look_for(path.substr(0, slash));
  if (!whole) return find(path.substr(0, slash));  // throws nearer to the mistake
  const Segment wanted = parted(std::string_view(path).substr(slash + 1));  // npos + 1 is 0
  std::string same, any;
  for (std::size_t i = 0; i < markup_.elements().size(); ++i) {
    const int each = int(i);
    const bool is_child = markup_[each].parent == *whole;
    const bool alike = short_name(markup_[each].name) == wanted.name;
    if (alike && (is_child || *whole == model())) same += " " + this->path(each);
    const std::string word = this->path(each);
    if (is_child && any.size() < 300) any += " " + word.substr(word.rfind('/') + 1);
  }
  throw model::LoadError(file_.string(), markup_[*whole].line,
                         "'" + path + "' names no part, or several",
                         same.empty() ? "there is:" + (any.empty() ? " nothing" : any)
                                      : "one of:" + same.substr(0, 600));
}

int Document::at_line(int line) const {
  int found = markup_.root();
  for (std::size_t i = 0; i < markup_.elements().size(); ++i) {
    const Element& element = markup_[int(i)];
    if (element.line > line || line_at(text_, element.whole.end) < line) continue;
    // The first element that begins on the line, else the innermost.
    if (markup_[found].line < element.line || found == markup_.root()) found = int(i);
  }
  return found;
}

std::string Complaint::line_of_text() const {
  return model::LoadError(file, line, message, fix).what();
}

std::optional<Complaint> check(const Document& document) {
  bool unfinished = false;
  try {
    model::check_numbers(document.file().string(), document.text());
    unfinished = true;
    if (document.is_urdf()) return std::nullopt;
    model::load_robot_text(document.file().string(), document.text());
  } catch (const model::LoadError& error) {
    Complaint complaint{error.file, error.line, error.message, error.fix, "", unfinished};
    if (error.file == document.file().string()) {
      complaint.part = document.path(document.at_line(error.line));
    }
    return complaint;
  }
  return std::nullopt;
}

}  // namespace verp::edit
