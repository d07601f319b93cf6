#pragma once
#include <memory>
#include <vector>

#include "host/robot/model/world.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::sim {

/// Replaces the level floor by `file`.
WorldOptions furnished(WorldOptions options, model::World file);

class Scenery final : private Actor {
 public:
  struct Item {
    const model::WorldObject* object;
    dBodyID body = nullptr;  ///< null: it never moves
    std::vector<dGeomID> geoms;
    std::vector<GeomTag*> tags;
  };

  /// The world must outlive it.
  Scenery(World& world, std::shared_ptr<const model::World> data);
  ~Scenery() override;
  Scenery(const Scenery&) = delete;
  Scenery& operator=(const Scenery&) = delete;

  const model::World& data() const { return *data_; }
  /// In the order of data().objects.
  const std::vector<Item>& items() const { return items_; }
  Transform pose(std::size_t index) const;
  /// Poses in the order of model::moving().
  std::vector<Transform> moving_poses() const;
  /// For a dynamic object: moves it at once; its velocity stays.
  void place(std::size_t index, const Transform& pose_world);

 private:
  void before_step(double step_s) override;
  void after_step(double) override {}
  void add(const model::WorldObject& object);
  void add_shape(Item& item, const model::WorldCollision& collision, int owner);
  dGeomID make_geom(const model::Shape& shape);
  dGeomID make_mesh(const model::Mesh& mesh);
  dGeomID make_heightfield(const model::Heightfield& field);

  World& world_;
  std::shared_ptr<const model::World> data_;
  std::vector<Item> items_;
  std::vector<dTriMeshDataID> meshes_;
  std::vector<dHeightfieldDataID> heightfields_;
  std::vector<std::vector<double>> numbers_;  ///< storage for ODE's pointers
  std::vector<std::vector<dTriIndex>> triangles_;
};

Transform pose_at(const model::WorldObject& object, double t_s);

}  // namespace verp::sim
