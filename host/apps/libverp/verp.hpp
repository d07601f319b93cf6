#pragma once
// libverp in C++: handles that close themselves, exceptions for errors. It uses only verp.h, so a
// program works with any library of the same ABI.
#include <algorithm>
#include <array>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "host/apps/libverp/verp.h"

namespace verp_lib {

class Error : public std::runtime_error {
 public:
  explicit Error(int given) : std::runtime_error(verp_last_error()), status(given) {}
  Error(int given, const std::string& why) : std::runtime_error(why), status(given) {}
  int status;
};

inline int checked(int status) {
  return status < 0 ? throw Error(status) : status;
}

/// The text for C. Throws for a text with a zero character.
inline const char* c_text(const std::string& text, const char* what) {
  if (text.find('\0') == std::string::npos) return text.c_str();
  throw Error(VERP_BAD_ARGUMENT, std::string(what) + " has a zero character in it");
}

class Core {
 public:
  explicit Core(const std::string& model = "generic21", const char* bus = nullptr,
                const char* tuning = nullptr) {
    verp_core core = nullptr;
    checked(verp_core_open(c_text(model, "verp_core_open: model"), bus, tuning, &core));
    core_.reset(core);
  }

  verp_core handle() const { return core_.get(); }
  void reset() { checked(verp_core_reset(handle())); }
  void step(const verp_inputs& in, verp_outputs& out) {
    checked(verp_core_step(handle(), &in, &out));
  }
  std::uint64_t digest() const { return get<std::uint64_t>(verp_core_digest); }
  std::uint32_t joints() const { return get<std::uint32_t>(verp_core_joints); }
  double period_s() const { return get<double>(verp_core_period); }
  std::string joint_name(std::uint32_t joint) const {
    char name[VERP_NAME];
    checked(verp_core_joint_name(handle(), joint, name, sizeof name));
    return name;
  }
  std::int32_t count(std::uint32_t joint, float angle_rad) const {
    std::int32_t count = 0;
    checked(verp_core_count(handle(), joint, angle_rad, &count));
    return count;
  }
  using Pose = std::array<float, VERP_POSE>;
  /// Poses of all links, the body's first.
  std::vector<Pose> forward(std::span<const float> angle_rad) const {
    std::vector<Pose> poses(angle_rad.size() + 1);
    checked(verp_core_forward(handle(), angle_rad.data(), size_of(angle_rad), poses[0].data()));
    return poses;
  }
  std::array<float, 3> com(std::span<const float> angle_rad) const {
    std::array<float, 3> com_m{};
    checked(verp_core_com(handle(), angle_rad.data(), size_of(angle_rad), com_m.data()));
    return com_m;
  }
  struct Leg {
    std::array<float, VERP_LEG_JOINTS> angle_rad{};
    std::uint32_t flags = 0;
  };
  Leg leg_ik(std::uint32_t side, const Pose& sole) const {
    Leg leg;
    checked(
        verp_core_leg_ik(handle(), side, sole.data(), nullptr, leg.angle_rad.data(), &leg.flags));
    return leg;
  }
  std::vector<verp_plan> plan(double vx_m_s, double vy_m_s, double wz_rad_s, std::uint32_t ticks,
                              std::uint32_t stop = 0) const {
    std::vector<verp_plan> plan(ticks <= VERP_MOST_PLANNED ? ticks : 1);  // refused if more
    checked(verp_core_plan(handle(), vx_m_s, vy_m_s, wz_rad_s, plan.data(), ticks, stop));
    return plan;
  }

 private:
  struct Close {
    using pointer = verp_core;
    void operator()(verp_core core) const { verp_core_close(core); }
  };
  static std::uint32_t size_of(std::span<const float> angles) {
    return static_cast<std::uint32_t>(angles.size());
  }
  template <class Value>
  Value get(int (*call)(verp_core, Value*)) const {
    Value value{};
    checked(call(handle(), &value));
    return value;
  }
  std::unique_ptr<verp_core, Close> core_;
};

class Moment {
 public:
  explicit Moment(const verp_moment& moment) : moment_(moment) {}
  std::uint32_t robot() const { return moment_.robot; }
  const verp_inputs& inputs() const { return *moment_.inputs; }
  verp_outputs& outputs() const { return *moment_.outputs; }
  void decide() const { checked(verp_decide(moment_.token)); }

 private:
  const verp_moment& moment_;
};

/// Rows from the top. Colour: red, green, blue per pixel. Depth: mm, 0 where there is nothing.
template <class Pixel>
struct Picture {
  std::uint32_t width = 0, height = 0;
  double time_s = 0;  ///< simulated time of a camera's picture
  std::vector<Pixel> pixels;
};

/// A world and its robots. Also rethrows the exceptions of a user's controllers.
class Session {
 public:
  using Controller = std::function<void(const Moment&)>;

  explicit Session(const char* world = nullptr) {
    const verp_world what = {sizeof(verp_world), 0, world};
    verp_session session = nullptr;
    checked(verp_session_open(&what, &session));
    session_.reset(session);
  }

  static verp_robot defaults() {
    verp_robot robot;
    checked(verp_robot_defaults(&robot));
    return robot;
  }

  verp_session handle() const { return session_.get(); }
  std::uint32_t add(const verp_robot& what) {
    std::uint32_t robot = 0;
    checked(verp_session_add(handle(), &what, &robot));
    ticks_.push_back(std::make_unique<verp_tick>());
    ticks_.back()->size = sizeof(verp_tick);
    checked(verp_session_view(handle(), robot, ticks_.back().get()));
    return robot;
  }
  /// Runs at most `count` ticks. False: the run has ended.
  bool tick(std::uint32_t count = 1) {
    const int status = verp_session_tick(handle(), count, nullptr, nullptr);
    // With another status, the exception may be another thread's.
    if (status == VERP_CALLBACK_FAILED && *thrown_)
      std::rethrow_exception(std::exchange(*thrown_, nullptr));
    return checked(status) == VERP_OK;
  }
  const verp_tick& seen(std::uint32_t robot = 0) const {
    if (robot < ticks_.size()) return *ticks_[robot];
    throw Error(VERP_BAD_ARGUMENT, "Session::seen: there is no robot " + std::to_string(robot) +
                                       ": the session has " + std::to_string(ticks_.size()));
  }
  std::uint64_t digest(std::uint32_t robot = 0) const {
    std::uint64_t digest = 0;
    checked(verp_session_digest(handle(), robot, &digest));
    return digest;
  }
  verp_result result(std::uint32_t robot = 0) {
    verp_result result;
    result.size = sizeof result;
    checked(verp_session_result(handle(), robot, &result));
    return result;
  }

  void command(verp_request request, double vx_m_s, double vy_m_s, double wz_rad_s,
               std::uint32_t robot = 0) {
    checked(verp_session_command(handle(), robot, request, vx_m_s, vy_m_s, wz_rad_s, 0, 0));
  }
  void tune(const std::string& name, double value, std::uint32_t robot = 0) {
    checked(verp_session_tune(handle(), robot, c_text(name, "verp_session_tune: name"), value));
  }
  double tuning(const std::string& name, std::uint32_t robot = 0) const {
    double value = 0;
    checked(
        verp_session_tuning(handle(), robot, c_text(name, "verp_session_tuning: name"), &value));
    return value;
  }
  double read(const std::string& quantity) const {
    double value = 0;
    checked(verp_session_read(handle(), c_text(quantity, "verp_session_read: quantity"), &value));
    return value;
  }
  void set(const std::string& quantity, double value) {
    checked(verp_session_set(handle(), c_text(quantity, "verp_session_set: quantity"), value));
  }
  void push(const std::string& thing, const std::array<double, 3>& force_n, double for_s) {
    checked(verp_session_push(handle(), c_text(thing, "verp_session_push: thing"), force_n[0],
                              force_n[1], force_n[2], for_s));
  }
  std::vector<verp_camera> cameras(std::uint32_t robot = 0) const {
    std::uint32_t count = 0;
    checked(verp_session_cameras(handle(), robot, &count));
    std::vector<verp_camera> all(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      all[i].size = sizeof all[i];
      checked(verp_session_camera(handle(), robot, i, &all[i]));
    }
    return all;
  }
  /// The camera's last picture; nullopt: none taken yet.
  std::optional<Picture<std::uint8_t>> colour(std::uint32_t camera = 0,
                                              std::uint32_t robot = 0) const {
    return picture<std::uint8_t>(VERP_COLOUR, camera, robot);
  }
  std::optional<Picture<std::uint16_t>> depth(std::uint32_t camera = 0,
                                              std::uint32_t robot = 0) const {
    return picture<std::uint16_t>(VERP_DEPTH, camera, robot);
  }
  std::optional<Picture<std::uint16_t>> labels(std::uint32_t camera = 0,
                                               std::uint32_t robot = 0) const {
    return picture<std::uint16_t>(VERP_LABELS, camera, robot);
  }
  /// Draws the world as it is now; time_s stays 0.
  Picture<std::uint8_t> render(verp_view view) const {
    view.size = sizeof view;
    Picture<std::uint8_t> out{view.width, view.height, 0, {}};
    if (std::max(view.width, view.height) <= VERP_MOST_PIXELS)
      out.pixels.resize(std::size_t{3} * view.width * view.height);
    if (out.pixels.empty()) out.pixels.resize(1);  // the library refuses it
    checked(verp_session_render(handle(), &view, out.pixels.data(), out.pixels.size()));
    return out;
  }
  Picture<std::uint8_t> render(const char* view, std::uint32_t width, std::uint32_t height,
                               std::uint32_t robot = 0) const {
    verp_view what = {};
    what.width = width;
    what.height = height;
    what.name = view;
    what.robot = robot;
    return render(what);
  }
  static verp_radio radio_defaults() {
    verp_radio radio;
    checked(verp_radio_defaults(&radio));
    return radio;
  }
  void radio(const verp_radio& what) { checked(verp_session_radio(handle(), &what)); }
  /// False: too many messages wait to be sent.
  bool send(std::uint32_t robot, const std::string& data, std::int32_t to = VERP_EVERYBODY) {
    return checked(verp_session_send(handle(), robot, to, data.data(), data.size())) == VERP_OK;
  }
  struct Message {
    std::uint32_t from = 0;
    std::string data;
  };
  /// The next message that the robot received up to its last tick; nullopt: there is none.
  std::optional<Message> take(std::uint32_t robot) {
    Message message;
    message.data.resize(65536);
    std::uint64_t size = 0;
    const int status = checked(verp_session_take(handle(), robot, message.data.data(),
                                                 message.data.size(), &size, &message.from));
    message.data.resize(size);
    return status == VERP_NO_MESSAGE ? std::nullopt : std::optional(std::move(message));
  }
  /// An empty function restores the robot's own controller.
  void control(Controller controller, std::uint32_t robot = 0) {
    if (!controller) {
      checked(verp_session_control(handle(), robot, nullptr, nullptr));
      return;
    }
    auto next = std::make_unique<Attached>(std::move(controller), thrown_.get());
    checked(verp_session_control(handle(), robot, &Attached::run, next.get()));
    controllers_[robot] = std::move(next);
  }

 private:
  struct Attached {
    Attached(Controller body, std::exception_ptr* where)
        : controller(std::move(body)), thrown(where) {}
    static int run(const verp_moment* moment, void* self) {
      auto* const attached = static_cast<Attached*>(self);
      try {
        attached->controller(Moment(*moment));
        return 0;
      } catch (...) {
        *attached->thrown = std::current_exception();
        return 1;
      }
    }
    Controller controller;
    std::exception_ptr* thrown;
  };
  template <class Pixel>
  std::optional<Picture<Pixel>> picture(std::uint32_t what, std::uint32_t camera,
                                        std::uint32_t robot) const {
    verp_camera by = {};
    by.size = sizeof by;
    checked(verp_session_camera(handle(), robot, camera, &by));
    Picture<Pixel> out{by.width, by.height, 0, {}};
    out.pixels.resize((what == VERP_COLOUR ? std::size_t{3} : 1) * by.width * by.height);
    const int status =
        checked(verp_session_picture(handle(), robot, camera, what, out.pixels.data(),
                                     out.pixels.size() * sizeof(Pixel), &out.time_s));
    return status == VERP_NO_PICTURE ? std::nullopt : std::optional(std::move(out));
  }
  struct Close {
    using pointer = verp_session;
    void operator()(verp_session session) const { verp_session_close(session); }
  };
  std::unique_ptr<std::exception_ptr> thrown_ = std::make_unique<std::exception_ptr>();
  std::map<std::uint32_t, std::unique_ptr<Attached>> controllers_;
  std::vector<std::unique_ptr<verp_tick>> ticks_;
  std::unique_ptr<verp_session, Close> session_;  ///< destroyed before the memory that it uses
};

/// Tick count and digest of a trace that replays bit for bit; throws Error if it does not.
struct Replayed {
  std::uint64_t ticks = 0, digest = 0;
};
inline Replayed replay(const std::string& trace) {
  Replayed replayed;
  if (const int status =
          verp_replay(c_text(trace, "verp_replay: file"), &replayed.ticks, &replayed.digest))
    throw Error(status);
  return replayed;
}

}  // namespace verp_lib
