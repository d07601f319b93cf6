#pragma once
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "host/twin/sim/robot.hpp"
#include "host/twin/sim/scenery.hpp"
#include "host/twin/sim/world.hpp"

/// A new value acts from the next step on.
namespace verp::sim {

/// A named number of the physics: `body.mass_kg`, `world.gravity_m_s2`. Only the world's thread may
/// read or set it, between steps.
struct Quantity {
  std::string name;
  std::string unit;          ///< "": a pure number
  std::string what;          ///< the same for all of its kind
  double low = 0, high = 0;  ///< range of settable values
  std::function<double()> read;
  std::function<void(double)> set;  ///< empty: read only

  bool settable() const { return static_cast<bool>(set); }
};

/// A robot's link or an object.
struct Thing {
  std::string name;
  dBodyID body = nullptr;
  std::vector<GeomTag*> tags;
  std::function<Transform()> pose;
  std::function<void(double mass_kg)> set_mass;
  std::function<void(int axis, double inertia_kg_m2)> set_inertia;
  /// Only free-standing things; a link follows its robot.
  std::function<void(const Transform& by_world)> move;
  std::function<void(const Vec3& linear_world_m_s, const Vec3& angular_world_rad_s)> add_velocity;

  Vec3 force_world_n = Vec3::Zero(), torque_world_n_m = Vec3::Zero();  ///< until changed
  Vec3 impulse_world_n_s = Vec3::Zero();                               ///< for the next step
  double linear_damping_1_s = 0, angular_damping_1_s = 0;

  Vec3 applied_n = Vec3::Zero(), applied_n_m = Vec3::Zero();  ///< in the last step
  Vec3 given_n_s = Vec3::Zero();                              ///< total
  Vec3 velocity_m_s = Vec3::Zero(), rate_rad_s = Vec3::Zero();
  Vec3 acceleration_m_s2 = Vec3::Zero(), angular_rad_s2 = Vec3::Zero();
};

class Quantities final : private Actor {
 public:
  /// The world must outlive this object.
  explicit Quantities(World& world);
  ~Quantities() override;
  Quantities(const Quantities&) = delete;
  Quantities& operator=(const Quantities&) = delete;

  /// `prefix` of its names ("red.") distinguishes robots.
  void add(TwinRobot& robot, const std::string& prefix = "");

  /// Moving objects become things; the others only surfaces.
  void add(Scenery& scenery);

  const std::vector<Quantity>& all() const { return all_; }
  /// Null: unknown name.
  const Quantity* find(const std::string& name) const;
  std::vector<std::string> names() const;
  std::vector<std::string> things() const;

  /// These throw std::invalid_argument with the valid names or range.
  double read(const std::string& name) const;
  void set(const std::string& name, double value);
  void check(const std::string& name, double value) const;
  /// Pushes at the centre of mass, in world axes, from the next step on.
  void push(const std::string& thing, const Vec3& force_world_n, double for_s);
  void check_push(const std::string& thing) const;

 private:
  struct Push {
    Thing* thing;
    Vec3 force_world_n;
    std::uint64_t until_us;
  };
  void before_step(double step_s) override;
  void after_step(double step_s) override;
  Thing& add_thing(Thing thing);
  Thing* thing(const std::string& name);
  const Quantity& get(const std::string& name) const;

  World& world_;
  std::deque<Thing> things_;  ///< quantities point to these
  std::vector<Push> pushes_;
  std::vector<Quantity> all_;
};

std::vector<Quantity> quantities_of(Thing& thing, const World& world);
std::vector<Quantity> quantities_of(const std::string& name, TwinRobot& robot, int joint);
std::vector<Quantity> quantities_of(const std::string& name, TwinRobot& robot, const World& world);
std::vector<Quantity> quantities_of(World& world);
std::vector<Quantity> surface_quantities(const std::string& name,
                                         const std::vector<GeomTag*>& tags);

}  // namespace verp::sim
