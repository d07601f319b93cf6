#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "host/author/edit/change.hpp"
#include "host/author/edit/names.hpp"
#include "host/author/edit/parts.hpp"
#include "host/robot/model/number.hpp"

namespace verp::edit {
namespace {

struct KindWords {
  const char *name, *words;
  bool plain;  ///< verp: element with the words as attributes
};
constexpr KindWords kKinds[] = {
    {"link", "name mass shape size radius length centre on", false},
    {"joint", "name parent child at axis lower upper type mass shape size radius length centre",
     false},
    {"frame", "name on at", false},
    {"sensor", "name link type", false},
    {"servo",
     "joint id type direction offset backlash_rad p_gain i_gain d_gain profile_ms lower_rad "
     "upper_rad bus",
     true},
    {"bus", "name protocol baud period_us rise_torque_percent", true},
    {"body", "link", true},
    {"limb", "name base tip", true},
    {"imu", "sensor link id type latency_s", true},
    {"latency", "sensor s", true},
    {"truth",
     "name link rate_hz latency_s position_noise_m angle_noise_rad velocity_noise_m_s "
     "rate_noise_rad_s",
     true},
    {"feet", "left_id right_id newton_per_count", true},
    {"tuning", "name value", true},
    {"box", "frame centre size friction stiffness_n_m damping_n_s_m", true},
    {"inertia", "link scale com reason", true},
    {"no_collide", "link other reason", true},
    {"drop", "what name reason", true},
    {"fix", "joint rad reason", true}};

bool names_word(std::string_view words, const std::string& word) {
  std::istringstream all{std::string(words)};
  for (std::string each; all >> each;) {
    if (each == word) return true;
  }
  return false;
}

std::string indented(const std::string& block) {
  std::string out = "  ";
  for (const char c : block) out += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return out;
}

class Adder {
 public:
  Adder(const Document& document, const KindWords& kind, const Words& words)
      : document_(document), kind_(kind), words_(words) {
    for (const auto& [name, value] : words) {
      if (!names_word(kind.words, name))
        fail("a " + std::string(kind.name) + " has no '" + name + "'");
    }
  }

  Edit add() const {
    const std::string kind = kind_.name;
    if (kind == "link") {
      new_name(Kind::kLink);
      return add_link(document_, word("name"), body(), word("on", ""));
    }
    if (kind == "joint") return joint();
    if (document_.is_urdf())
      fail("a URDF has no such part; add it to the SDF file that includes it");
    if (kind == "frame") {
      new_name(Kind::kFrame);
      return last(fmt::format("<frame name=\"{}\" attached_to=\"{}\"><pose>{} 0 0 0</pose></frame>",
                              xml("name"), xml("on"), row("at", 3)));
    }
    if (kind == "sensor") {
      return insert(document_, document_.find("link:" + word("link")),
                    fmt::format("<sensor name=\"{}\" type=\"{}\"/>", xml("name"), xml("type")));
    }
    return plain();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw model::LoadError(document_.file().string(), 0, what,
                           std::string("add ") + kind_.name + " takes: " + kind_.words);
  }
  std::string word(const std::string& name) const {
    const auto found = words_.find(name);
    if (found == words_.end()) fail(std::string("a ") + kind_.name + " needs " + name + "=...");
    return found->second;
  }
  std::string word(const std::string& name, const std::string& fallback) const {
    return words_.contains(name) ? word(name) : fallback;
  }
  std::string xml(const std::string& name) const { return escaped(word(name)); }

  std::string row(const std::string& name, std::size_t count,
                  const std::string& fallback = "") const {
    std::string text = fallback.empty() ? word(name) : word(name, fallback);
    std::replace(text.begin(), text.end(), ',', ' ');
    const auto values = model::parse_numbers(text);
    if (!values || values->size() != count)
      fail(fmt::format("{}='{}' is not {} number{}", name, text, count, count == 1 ? "" : "s"));
    return text;
  }
  Vec3 vector(const std::string& name, const std::string& fallback = "") const {
    const auto v = *model::parse_numbers(row(name, 3, fallback));
    return {v[0], v[1], v[2]};
  }
  double positive(const std::string& name) const {
    const double value = *model::parse_number(row(name, 1));
    if (value <= 0) fail(name + " has to be more than 0");
    return value;
  }
  void new_name(Kind kind) const {
    if (is_taken(document_, kind, word("name"))) fail("'" + word("name") + "' is there already");
  }

  Body body() const {
    Solid solid;
    try {
      solid.kind = solid_kind(word("shape", words_.contains("radius") ? "sphere" : "box"));
    } catch (const std::invalid_argument& error) {
      fail(error.what());
    }
    solid.centre_m = vector("centre", "0 0 0");
    if (solid.kind == Solid::Kind::kBox) {
      solid.size_m = vector("size");
      if (solid.size_m.minCoeff() <= 0) fail("size has to be three lengths more than 0");
    } else {
      solid.size_m.x() = positive("radius");
      if (solid.kind != Solid::Kind::kSphere) solid.size_m.z() = positive("length");
    }
    return body_of(solid, positive("mass"));
  }

  std::string axis() const {
    const std::string word_ = word("axis");
    if (word_ == "x") return "1 0 0";
    if (word_ == "y") return "0 1 0";
    return word_ == "z" ? "0 0 1" : row("axis", 3);
  }

  /// With a mass, adds its link, too.
  Edit joint() const {
    new_name(Kind::kJoint);
    const std::string type = word("type", "revolute"), name = word("name"),
                      child = word("child", name + "_link");
    const bool fixed = type == "fixed";
    const auto limit = [&](const char* which) { return row(which, 1); };
    std::string block;
    if (document_.is_urdf()) {
      block = fmt::format(
          "<joint name=\"{}\" type=\"{}\">\n  <parent link=\"{}\"/>\n  <child link=\"{}\"/>\n  "
          "<origin xyz=\"{}\"/>\n",
          xml("name"), escaped(type), xml("parent"), escaped(child), row("at", 3, "0 0 0"));
      if (!fixed)
        block += fmt::format(
            "  <axis xyz=\"{}\"/>\n  <limit lower=\"{}\" upper=\"{}\" effort=\"0\" "
            "velocity=\"0\"/>\n",
            axis(), limit("lower"), limit("upper"));
    } else {
      block = fmt::format(
          "<joint name=\"{}\" type=\"{}\">\n  <pose relative_to=\"{}\">{} 0 0 0</pose>\n  "
          "<parent>{}</parent>\n  <child>{}</child>\n",
          xml("name"), escaped(type), xml("parent"), row("at", 3, "0 0 0"), xml("parent"),
          escaped(child));
      if (!fixed)
        block += fmt::format(
            "  <axis>\n    <xyz>{}</xyz>\n    <limit><lower>{}</lower><upper>{}</upper></limit>\n  "
            "</axis>\n",
            axis(), limit("lower"), limit("upper"));
    }
    block += "</joint>";
    const Edit edit = last(block);
    if (!words_.contains("mass")) return edit;
    if (is_taken(document_, Kind::kLink, child)) fail("link '" + child + "' is there already");
    return together(document_, edit.what, [&](Document& copy) {
      copy.apply(edit);
      copy.apply(add_link(copy, child, body(), name));
    });
  }

  /// Inserts behind the last of its kind.
  Edit last(const std::string& block, int parent = -1) const {
    if (parent < 0) parent = document_.model();
    const std::string tag = block.substr(1, block.find_first_of(" >/", 1) - 1);
    int after = -1;
    for (const int each : document_.markup()[parent].children) {
      const std::string& name = document_.markup()[each].name;
      const bool tree = (tag == "link" || tag == "joint") && (name == "link" || name == "joint");
      if (name == tag || tree) after = each;
    }
    Edit edit = insert(document_, parent, block, after);
    edit.what =
        std::string("add ") + kind_.name + " " + word("name", word("joint", word("link", "")));
    return edit;
  }

  Edit plain() const {
    std::string block = std::string("<verp:") + kind_.name;
    std::istringstream order(kind_.words);
    for (std::string name; order >> name;) {
      if (!words_.contains(name) || (name == "bus" && std::string(kind_.name) == "servo")) continue;
      block += " " + name + "=\"" + xml(name) + "\"";
    }
    block += "/>";
    if (std::string(kind_.name) != "servo") return last(block);
    const std::string bus = word("bus", "");
    const auto found = document_.look_for(bus.empty() ? "bus" : "bus:" + bus);
    if (!found)
      fail(bus.empty() ? "one bus is needed: add it, or name it with bus=..."
                       : "there is no bus '" + bus + "'");
    return last(block, *found);
  }

  const Document& document_;
  const KindWords& kind_;
  const Words& words_;
};

}  // namespace

Edit add_link(const Document& document, const std::string& name, const Body& body,
              const std::string& on) {
  std::string block = "<link name=\"" + escaped(name) + "\">\n";
  if (!document.is_urdf() && !on.empty()) {
    block += "  <pose relative_to=\"" + escaped(on) + "\">0 0 0 0 0 0</pose>\n";
  }
  block += indented(link_content(document, name, body)) + "\n</link>";
  int after = -1;
  for (const int each : document.markup()[document.model()].children) {
    const Kind kind = kind_of(document, each);
    if (kind == Kind::kLink || kind == Kind::kJoint) after = each;
  }
  Edit edit = insert(document, document.model(), block, after);
  edit.what = "add link " + name;
  return edit;
}

std::vector<std::string> kinds() {
  std::vector<std::string> all;
  for (const KindWords& each : kKinds) all.emplace_back(each.name);
  return all;
}

std::string words_of(const std::string& kind) {
  for (const KindWords& each : kKinds) {
    if (kind == each.name) return each.words;
  }
  return "";
}

Edit add(const Document& document, const std::string& kind, const Words& words) {
  for (const KindWords& each : kKinds) {
    if (kind == each.name) return Adder(document, each, words).add();
  }
  std::string all;
  for (const KindWords& each : kKinds) all += std::string(" ") + each.name;
  throw model::LoadError(document.file().string(), 0, "'" + kind + "' is no part of a robot",
                         "add one of:" + all);
}

}  // namespace verp::edit
