#include "host/run/scenario/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "common/model/tuning_ranges.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/session/plan.hpp"

namespace verp::scenario {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::pair<const char*, sim::Lies> kStarts[] = {
    {"standing", sim::Lies::kNo},       {"lying:front", sim::Lies::kFront},
    {"lying:back", sim::Lies::kBack},   {"lying:left", sim::Lies::kLeft},
    {"lying:right", sim::Lies::kRight}, {"lying:any", sim::Lies::kAny}};

struct Limits {
  double low, high;
};
constexpr Limits kAny{-1e12, 1e12}, kPlace{-1000, 1000}, kSpeed{-2, 2}, kTurn{-6.3, 6.3};

class Writer {
 public:
  static constexpr bool kReads = false;
  explicit Writer(Json& to) : to_(to) {}

  template <class T>
  void value(const char* key, const T& value) {
    to_[key] = value;
  }
  void number(const char* key, double value, Limits) { to_[key] = value; }
  void seed(const char* key, std::uint64_t value) { to_[key] = value; }

  template <class T, class Fields>
  void object(const char* key, T& value, Fields&& fields) {
    Json& inner = to_[key] = Json::object();
    Writer writer(inner);
    fields(writer, value);
  }
  template <class T, class Fields>
  void list(const char* key, std::vector<T>& all, Fields&& fields) {
    Json& inner = to_[key] = Json::array();
    for (T& each : all) {
      Writer writer(inner.emplace_back(Json::object()));
      fields(writer, each);
    }
  }

 private:
  Json& to_;
};

/// Keys that no field took are unknown.
class Reader {
 public:
  static constexpr bool kReads = true;
  Reader(const Json& from, std::string file, std::string path)
      : from_(from), file_(std::move(file)), path_(std::move(path)) {
    if (!from_.is_object()) fail("", "is no object {...}");
  }

  bool has(const char* key) const { return from_.contains(key); }

  void value(const char* key, std::string& value) { take(key, value, &Json::is_string, "a text"); }
  void value(const char* key, bool& value) { take(key, value, &Json::is_boolean, "true or false"); }
  void value(const char* key, std::uint64_t& value) {
    take(key, value, &Json::is_number_unsigned, "a whole number, 0 or more");
  }
  void number(const char* key, double& value, Limits limits) {
    take(key, value, &Json::is_number, "a number");
    if (!has(key) || (value >= limits.low && value <= limits.high)) return;
    fail(key, fmt::format("{} is out of range; give {:g} to {:g}", value, limits.low, limits.high));
  }
  void seed(const char* key, std::uint64_t& seed) {
    value(key, seed);
    if (seed > kMostSeed)
      fail(key, fmt::format("{} is out of range; give 0 to {}", seed, kMostSeed));
  }

  template <class T, class Fields>
  void object(const char* key, T& value, Fields&& fields) {
    if (const Json* inner = find(key)) {
      Reader reader(*inner, file_, join(key));
      fields(reader, value);
      reader.end();
    }
  }
  template <class T, class Fields>
  void list(const char* key, std::vector<T>& all, Fields&& fields) {
    const Json* inner = find(key);
    if (inner == nullptr) return;
    if (!inner->is_array()) fail(key, "is no list [...]");
    all.clear();
    for (const Json& each : *inner) {
      Reader reader(each, file_, fmt::format("{}[{}]", join(key), all.size()));
      fields(reader, all.emplace_back());
      reader.end();
    }
  }

  const Json* find(const char* key) {
    known_.insert(key);
    const auto at = from_.find(key);
    return at == from_.end() ? nullptr : &*at;
  }

  /// Fails at a key that no field took.
  void end(const std::string& remedy = "") const {
    for (const auto& [key, value] : from_.items()) {
      if (known_.contains(key)) continue;
      if (!remedy.empty()) fail(key, "there is no such key; " + remedy);
      std::string names;
      for (const std::string& name : known_) names += (names.empty() ? "" : ", ") + name;
      fail(key, "there is no such key; give one of: " + names);
    }
  }

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw model::LoadError(file_, 0, join(key) + ": " + what,
                           "`verp walk --print-scenario` prints one with all keys");
  }

 private:
  template <class T>
  void take(const char* key, T& value, bool (Json::*is)() const noexcept, const char* type) {
    const Json* at = find(key);
    if (at == nullptr) return;
    if (!(at->*is)()) fail(key, fmt::format("{} is not {}", at->dump(), type));
    value = at->get<T>();
  }
  std::string join(const std::string& key) const {
    if (key.empty()) return path_.empty() ? "the scenario" : path_;
    return path_.empty() ? key : path_ + "." + key;
  }

  const Json& from_;
  const std::string file_, path_;
  std::set<std::string> known_;
};

// One list of fields for both ways; `if constexpr` covers differences.

template <class Io>
void fields(Io& io, World& world) {
  io.value("file", world.file);
  io.number("physics_step_ms", world.physics_step_ms, {0.25, 2});
  if constexpr (Io::kReads) {
    constexpr double kSteps_ms[] = {0.25, 0.5, 1, 2};
    if (std::ranges::find(kSteps_ms, world.physics_step_ms) == std::end(kSteps_ms))
      io.fail("physics_step_ms", "give one of: 0.25, 0.5, 1, 2");
  }
}

template <class Io>
void fields(Io& io, Place& at) {
  io.number("x_m", at.x_m, kPlace);
  io.number("y_m", at.y_m, kPlace);
  io.number("yaw_rad", at.yaw_rad, kPlace);
}

template <class Io>
void fields(Io& io, Velocity& velocity) {
  io.number("vx_m_s", velocity.vx_m_s, kSpeed);
  io.number("vy_m_s", velocity.vy_m_s, kSpeed);
  io.number("wz_rad_s", velocity.wz_rad_s, kTurn);
}

template <class Io>
void fields(Io& io, Controller& controller) {
  io.value("folder", controller.folder);
  io.value("board", controller.board);
  io.value("link", controller.link);
  if constexpr (Io::kReads) {
    if (!controller.board.empty() && !controller.link.empty())
      io.fail("", "give one of board, link");
  }
}

template <class Io>
void fields(Io& io, Orders& orders) {
  if constexpr (Io::kReads) {
    const int given = io.has("step_m") + io.has("velocity") + io.has("stand");
    if (given > 1) io.fail("", "give one of step_m, velocity, stand");
  }
  const auto choice = [&]<class T>(const char* key, T fresh, auto&& each) {
    if constexpr (Io::kReads) {
      if (io.find(key) == nullptr) return;
      orders = fresh;
    }
    if (T* chosen = std::get_if<T>(&orders)) each(*chosen);
  };
  choice("step_m", Ahead{}, [&](Ahead& a) { io.number("step_m", a.step_m, {0, 0.15}); });
  choice("velocity", Velocity{}, [&](Velocity& v) {
    io.object("velocity", v, [](auto& inner, Velocity& velocity) { fields(inner, velocity); });
  });
  choice("stand", Stand{}, [&](Stand&) {
    bool stand = true;
    io.value("stand", stand);
    if constexpr (Io::kReads) {
      if (!stand) io.fail("stand", "is false; leave it out, or give step_m or velocity");
    }
  });
}

template <class Io>
void fields(Io& io, session::Intervention& what) {
  using Kind = session::Intervention::Kind;
  io.number("at_s", what.at_s, {0, 86400});
  if constexpr (Io::kReads) {
    if (io.has("push") == io.has("set")) io.fail("", "give one of push, set");
    what.kind = io.has("push") ? Kind::kPush : Kind::kSet;
  }
  if (what.kind == Kind::kSet) {
    io.value("set", what.name);
    io.number("value", what.value, kAny);
    return;
  }
  io.value("push", what.name);
  io.number("x_n", what.force_world_n.x(), {-1e5, 1e5});
  io.number("y_n", what.force_world_n.y(), {-1e5, 1e5});
  io.number("z_n", what.force_world_n.z(), {-1e5, 1e5});
  io.number("for_s", what.for_s, {0.001, 3600});
}

template <class Io>
void start(Io& io, sim::Lies& lies) {
  std::string name;
  for (const auto& [text, value] : kStarts) {
    if (lies == value) name = text;
  }
  io.value("start", name);
  if constexpr (Io::kReads) {
    std::string names;
    for (const auto& [text, value] : kStarts)
      names += (names.empty() ? "" : ", ") + std::string(text);
    const auto found = start_of(name);
    if (!found) io.fail("start", fmt::format("'{}' is none; give one of: {}", name, names));
    lies = *found;
  }
}

template <class Io>
void fields(Io& io, std::map<std::string, double>& tuning) {
  if constexpr (Io::kReads) {
    for (const std::string& name : model::tuning_names()) {
      if (!io.has(name.c_str())) continue;
      const Range& range = kTuningRanges[*model::tuning_id(name)];
      const auto decimal = [](float value) { return std::stod(fmt::format("{:g}", value)); };
      io.number(name.c_str(), tuning[name], {decimal(range.low), decimal(range.high)});
    }
    io.end("`verp parameters` lists them");
  } else {
    for (const auto& [name, value] : tuning) io.number(name.c_str(), value, kAny);
  }
}

template <class Io>
void fields(Io& io, Robot& robot) {
  const auto each = [](auto& inner, auto& value) { fields(inner, value); };
  io.value("name", robot.name);
  io.value("model", robot.model);
  io.value("bus", robot.bus);
  io.object("tuning", robot.tuning, each);
  io.object("orders", robot.orders, each);
  io.object("controller", robot.controller, each);
  io.seed("seed", robot.seed);
  io.value("vary", robot.vary);
  io.object("at", robot.at, each);
  start(io, robot.lies);
  io.value("get_up", robot.get_up);
  io.value("fault", robot.fault);
  io.list("disturbances", robot.disturbances, each);
}

template <class Io>
void fields(Io& io, Radio& radio) {
  constexpr Limits kPositive{0, 1e9};
  radio::Conditions& air = radio.conditions;
  io.number("range_m", air.range_m, kPositive);
  io.number("loss", air.loss, kPositive);
  io.number("fade", air.fade, kPositive);
  io.number("fade_s", air.fade_s, kPositive);
  io.number("delay_s", air.delay_s, kPositive);
  io.number("jitter_s", air.jitter_s, kPositive);
  io.number("bytes_s", air.bytes_s, kPositive);
  io.value("overhead", air.overhead);
  io.value("most_bytes", air.most_bytes);
  io.value("most_waiting", air.most_waiting);
  io.seed("seed", radio.seed);
  if constexpr (Io::kReads) {
    try {
      radio::check(air);
    } catch (const std::invalid_argument& error) {
      io.fail("", error.what());
    }
  }
}

template <class Io>
void fields(Io& io, Scenario& scenario) {
  const auto each = [](auto& inner, auto& value) { fields(inner, value); };
  io.object("world", scenario.world, each);
  io.number("length_s", scenario.length_s, {3, 86400});
  io.value("real_time", scenario.real_time);
  io.list("robots", scenario.robots, each);
  if constexpr (Io::kReads) {
    if (io.find("radio") != nullptr) scenario.radio.emplace();
  }
  if (scenario.radio) io.object("radio", *scenario.radio, each);
  io.value("if_lost_go_on", scenario.if_lost_go_on);
  io.number("patience_s", scenario.patience_s, {0.1, 3600});
}

/// Refuses robots that cannot be in one world.
void check_robots(const std::vector<Robot>& robots, const Reader& reader) {
  if (robots.empty() || robots.size() > kMostRobots)
    reader.fail("robots", fmt::format("{} robots; give 1 to {}", robots.size(), kMostRobots));
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Robot& robot = robots[i];
    const auto fail = [&](const char* key, const std::string& what) {
      reader.fail(fmt::format("robots[{}].{}", i, key), what);
    };
    if (robot.name.empty() && robots.size() > 1) fail("name", "each of several robots needs one");
    if (!robot.name.empty() && !is_name(robot.name))
      fail("name", "a name has letters, digits, _ and -");
    for (std::size_t other = 0; other < i; ++other) {
      const Robot& there = robots[other];
      if (there.name == robot.name) fail("name", fmt::format("robots[{}] has it too", other));
      if (std::hypot(there.at.x_m - robot.at.x_m, there.at.y_m - robot.at.y_m) <
          session::kLeastApart_m)
        fail("at", fmt::format("robots[{}] stands there; keep them {:g} m apart", other,
                               session::kLeastApart_m));
    }
  }
}

/// nlohmann-json keeps the last of equal keys.
Json parsed(const std::string& text, const std::string& file) {
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value).second)
      throw model::LoadError(file, 0, value.get<std::string>() + ": the key is there twice",
                             "leave one out");
    return true;
  };
  const auto no_json = [&](const std::string& what) {
    return model::LoadError(file, 0, "no JSON: " + what,
                            "`verp walk --print-scenario` prints a valid file");
  };
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) throw no_json("the file is empty");
  if (text.find('\0') != std::string::npos) throw no_json("a byte is 0");
  try {
    return Json::parse(text, watch);
  } catch (const Json::exception& error) {  // or a number beyond double
    const std::string what = error.what();
    throw no_json(what.substr(what.find("] ") + 2));
  }
}

/// Runs `find`, which looks for the file that a key names. Throws LoadError with the key.
template <class Find>
void look_for(const std::string& file, const std::string& key, Find&& find) {
  try {
    find();
  } catch (const model::LoadError& error) {
    throw model::LoadError(file, 0, fmt::format("{}: {}: {}", key, error.file, error.message),
                           error.fix);
  }
}

void require_files(const Scenario& scenario, const std::string& file) {
  const std::string& world = scenario.world.file;
  if (!world.empty()) look_for(file, "world.file", [&] { model::find_world(world); });
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const Robot& robot = scenario.robots[i];
    const std::string key = fmt::format("robots[{}].", i);
    look_for(file, key + "model", [&] { model::find_model(robot.model); });
    const std::filesystem::path folder = robot.controller.folder;
    if (folder.empty() || std::filesystem::exists(folder / "controller.hpp")) continue;
    throw model::LoadError(file, 0,
                           key + "controller.folder: " + folder.string() + " has no controller.hpp",
                           "`verp new controller NAME` lays out a folder that has");
  }
}

}  // namespace

bool is_name(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  return !text.empty() && std::ranges::all_of(text, plain);
}

std::optional<sim::Lies> start_of(const std::string& name) {
  for (const auto& [text, value] : kStarts) {
    if (name == text) return value;
  }
  return {};
}

std::string print(const Scenario& scenario) {
  Json json = Json::object();
  Writer writer(json);
  Scenario copy = scenario;  // one list for both ways
  fields(writer, copy);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Scenario parse(const std::string& text, const std::string& file) {
  const Json json = parsed(text, file);
  Scenario scenario;
  Reader reader(json, file, "");
  fields(reader, scenario);
  reader.end();
  check_robots(scenario.robots, reader);
  return scenario;
}

Scenario read(const std::string& file) {
  const auto text = std::filesystem::is_directory(file) ? std::nullopt : files::read(file);
  if (!text) throw model::LoadError(file, 0, "cannot be read", "give a scenario's file");
  Scenario scenario = parse(*text, file);
  require_files(scenario, file);
  return scenario;
}

}  // namespace verp::scenario
