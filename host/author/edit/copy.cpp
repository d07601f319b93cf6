#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>
#include <set>

#include "host/author/edit/change.hpp"
#include "host/author/edit/mirror_numbers.hpp"
#include "host/author/edit/names.hpp"

namespace verp::edit {
namespace {

using Rename = std::function<std::string(const std::string&)>;

constexpr std::array kNamedKinds = {Kind::kLink, Kind::kJoint, Kind::kFrame, Kind::kSensor};

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_within(const Document& document, int inner, int outer) {
  const Range a = document.markup()[inner].whole, b = document.markup()[outer].whole;
  return a.begin >= b.begin && a.end <= b.end;
}

/// Copies with other names, ids and numbers.
class Copier {
 public:
  Copier(const Document& document, int element, Rename renamed, bool mirrored)
      : document_(document),
        sources_(what_hangs_on(document, element)),
        renamed_(std::move(renamed)),
        mirrored_(mirrored) {
    for (const Kind kind : kNamedKinds) learn(kind);
    for (const auto& each : document.markup()[document.model()].children) {
      if (kind_of(document, each) != Kind::kJoint || !is_source(each)) continue;
      const std::string name = document.attribute(each, "name");
      joints_.insert(name);
      if (angle_changes_sign(document, each)) sign_changes_.insert(name);
    }
  }

  Edit copies(const std::string& what) {
    std::map<int, std::pair<int, std::string>>
        of_parent;  // the last original, and the text behind it
    for (const int each : sources_) {
      const Element& element = document_.markup()[each];
      auto& [last, text] = of_parent[element.parent];
      if (!text.empty()) text += lead(each);
      text += copy_of(each);
      last = each;
    }
    Edit edit{what, {}};
    for (const auto& [parent, made] : of_parent) {
      const auto& [last, text] = made;
      edit.splices.push_back({behind(document_, last), "", lead(last) + text});
    }
    std::sort(edit.splices.begin(), edit.splices.end(),
              [](const Splice& a, const Splice& b) { return a.at < b.at; });
    return edit;
  }

 private:
  bool is_source(int element) const {
    return std::any_of(sources_.begin(), sources_.end(),
                       [&](int each) { return is_within(document_, element, each); });
  }

  void learn(Kind kind) {
    auto& map = names_[kind];
    for (const Mention& each : mentions(document_, kind)) {
      if (!each.defines || !is_source(each.element)) continue;
      const std::string name = renamed_(each.name);
      // A sensor without a side keeps its name: its link distinguishes it.
      if (name.empty() && kind == Kind::kSensor) continue;
      if (name.empty()) {
        throw model::LoadError(document_.file().string(), document_.markup()[each.element].line,
                               "'" + each.name + "' has no side in its name",
                               "name it left or l_, right or r_ first");
      }
      if (kind != Kind::kSensor && is_taken(document_, kind, name)) {
        throw model::LoadError(document_.file().string(), document_.markup()[each.element].line,
                               "'" + name + "' is there already", "delete or rename it first");
      }
      map[each.name] = name;
    }
  }

  /// Line break and indentation; empty within a line.
  std::string lead(int element) const {
    const std::string& text = document_.text();
    const std::size_t at = document_.markup()[element].whole.begin;
    std::size_t begin = at;
    while (begin > 0 && (text[begin - 1] == ' ' || text[begin - 1] == '\t')) --begin;
    if (begin == 0 || text[begin - 1] != '\n') return "";
    const bool carriage = begin > 1 && text[begin - 2] == '\r';
    return (carriage ? "\r\n" : "\n") + text.substr(begin, at - begin);
  }
  std::string copy_of(int element) {
    std::vector<Splice> changes;
    if (mirrored_) changes = mirrored_numbers(document_, element, sign_changes_, joints_);
    for (const Kind kind : kNamedKinds) rename_in(element, kind, changes);
    plain_names(element, changes);
    new_id(element, changes);
    std::sort(changes.begin(), changes.end(),
              [](const Splice& a, const Splice& b) { return a.at < b.at; });
    const Range whole = document_.markup()[element].whole;
    const std::string& text = document_.text();
    std::string out;
    std::size_t from = whole.begin;
    for (const Splice& each : changes) {
      if (each.at < from) continue;  // a name of two kinds
      out += text.substr(from, each.at - from) + each.after;
      from = each.at + each.before.size();
    }
    return out + text.substr(from, whole.end - from);
  }

  void rename_in(int element, Kind kind, std::vector<Splice>& changes) const {
    const auto& map = names_.at(kind);
    for (const Mention& each : mentions(document_, kind)) {
      const auto found = map.find(each.name);
      if (found == map.end() || !is_within(document_, each.element, element)) continue;
      changes.push_back({each.at.begin, document_.text().substr(each.at.begin, each.at.size()),
                         escaped(found->second)});
    }
  }

  /// Renames limbs, shapes and others, also where contact sensors name shapes.
  void plain_names(int element, std::vector<Splice>& changes) const {
    const auto& all = document_.markup().elements();
    const auto put = [&](Range at, const std::string& name) {
      if (!name.empty())
        changes.push_back({at.begin, document_.text().substr(at.begin, at.size()), escaped(name)});
    };
    for (std::size_t i = std::size_t(element);
         i < all.size() && is_within(document_, int(i), element); ++i) {
      const bool of_contact =
          all[i].parent >= 0 && document_.markup()[all[i].parent].name == "contact";
      if (mirrored_ && of_contact && all[i].name == "collision") {
        put(document_.markup().text_at(int(i), document_.text()),
            renamed_(document_.text_of(int(i))));
      }
      const Attribute* name = all[i].attribute("name");
      const bool known = all[i].name == "verp:joint" || kind_of(document_, int(i)) != Kind::kNone;
      if (name == nullptr || known) continue;
      const bool alone = all[i].parent == document_.model();  // a limb
      put(name->value_at, mirrored_ || alone ? renamed_(name->value) : "");
    }
  }

  void new_id(int element, std::vector<Splice>& changes) {
    const Element& servo = document_.markup()[element];
    const Attribute* id = servo.attribute("id");
    if (servo.name != "verp:servo" || id == nullptr) return;
    std::set<std::string>& used = ids_[servo.parent];
    if (used.empty()) {
      for (const Element& each : document_.markup().elements()) {
        const bool elsewhere = each.name == "verp:servo" && each.parent != servo.parent;
        for (const char* name : {"id", "left_id", "right_id"}) {
          const Attribute* other = elsewhere ? nullptr : each.attribute(name);
          if (other != nullptr) used.insert(other->value);
        }
      }
    }
    int next = 1;
    while (used.contains(std::to_string(next))) ++next;
    used.insert(std::to_string(next));
    changes.push_back({id->value_at.begin, id->value, std::to_string(next)});
  }

  const Document& document_;
  const std::vector<int> sources_;
  const Rename renamed_;
  const bool mirrored_;
  std::map<Kind, std::map<std::string, std::string>> names_;
  std::set<std::string> joints_, sign_changes_;
  std::map<int, std::set<std::string>> ids_;
};

std::string free_name(const Document& document, const std::string& name) {
  for (int number = 2;; ++number) {
    const std::string other = name + "_" + std::to_string(number);
    const bool taken = std::any_of(kNamedKinds.begin(), kNamedKinds.end(),
                                   [&](Kind kind) { return is_taken(document, kind, other); });
    if (!taken) return other;
  }
}

}  // namespace

std::string other_side(const std::string& name) {
  struct Pair {
    std::string_view from, to;
    bool word;  ///< also at the end of letters of one case
  };
  constexpr std::array<Pair, 10> kSides = {{{"left", "right", true},
                                            {"right", "left", true},
                                            {"Left", "Right", true},
                                            {"Right", "Left", true},
                                            {"LEFT", "RIGHT", true},
                                            {"RIGHT", "LEFT", true},
                                            {"l", "r", false},
                                            {"r", "l", false},
                                            {"L", "R", false},
                                            {"R", "L", false}}};
  for (const Pair& side : kSides) {
    for (std::size_t at = name.find(side.from); at != name.npos;
         at = name.find(side.from, at + 1)) {
      const std::size_t end = at + side.from.size();
      const bool begins = at == 0 || !is_letter(name[at - 1]);
      const bool ends = end == name.size() || !is_letter(name[end]);
      const bool camel = end < name.size() && std::isupper(static_cast<unsigned char>(name[end]));
      const bool inside = std::isupper(static_cast<unsigned char>(name[at])) && at > 0;
      const bool is_side = side.word ? (begins || inside) && (ends || camel) : begins && ends;
      if (is_side) return name.substr(0, at) + std::string(side.to) + name.substr(end);
    }
  }
  return "";
}

Edit duplicate(const Document& document, int element, const std::string& name) {
  const std::string old = key_of(document.markup()[element]);
  const bool servo = document.markup()[element].name == "verp:servo";
  if (name.empty() || old.empty() || element == document.model()) {
    throw model::LoadError(document.file().string(), document.markup()[element].line,
                           document.path(element) + " cannot be there twice",
                           "choose another part");
  }
  const auto renamed = [&](const std::string& each) {
    if (each == old) return name;
    const std::size_t at = each.find(old);
    const std::string other =
        at == each.npos ? each : each.substr(0, at) + name + each.substr(at + old.size());
    return other == each ? free_name(document, each) : other;
  };
  const std::string what = "duplicate " + document.path(element);
  Edit edit = Copier(document, element, renamed, false).copies(what);
  if (!servo) return edit;
  // A servo's name is its joint's.
  return together(document, what, [&](Document& copy) {
    copy.apply(edit);
    const auto& siblings = copy.markup()[copy.markup()[element].parent].children;
    const auto next = std::find(siblings.begin(), siblings.end(), element) + 1;
    copy.apply(set(copy, copy.path(*next) + "@joint", name));
  });
}

Edit mirror(const Document& document, int element) {
  const std::string key = key_of(document.markup()[element]);
  if (element == document.model() || other_side(key).empty()) {
    throw model::LoadError(document.file().string(), document.markup()[element].line,
                           "'" + key + "' has no side in its name",
                           "mirror a part with left or right, l_ or r_ in its name");
  }
  const std::string what = "mirror " + document.path(element);
  Edit edit = Copier(document, element, other_side, true).copies(what);
  if (kind_of(document, element) != Kind::kNone) return edit;
  // The copy refers to the other side's name.
  return together(document, what, [&](Document& copy) {
    copy.apply(edit);
    const auto& siblings = copy.markup()[copy.markup()[element].parent].children;
    const int next = *(std::find(siblings.begin(), siblings.end(), element) + 1);
    for (const Attribute& each : std::vector<Attribute>(copy.markup()[next].attributes)) {
      const bool names = each.name == "joint" || each.name == "link" || each.name == "frame" ||
                         each.name == "tip" || each.name == "sensor";
      if (!names || other_side(each.value).empty()) continue;
      const Attribute* now = copy.markup()[next].attribute(each.name);
      copy.apply(
          {"",
           {{now->value_at.begin, copy.text().substr(now->value_at.begin, now->value_at.size()),
             escaped(other_side(each.value))}}});
    }
  });
}

}  // namespace verp::edit
