#include "host/robot/model/load_world.hpp"

#include <cmath>
#include <sdf/sdf.hh>
#include <stdexcept>

#include "host/robot/model/find.hpp"
#include "host/robot/model/library_console.hpp"
#include "host/robot/model/mesh_file.hpp"
#include "host/robot/model/principal.hpp"
#include "host/robot/model/sdf_parts.hpp"
#include "host/robot/model/world_xml.hpp"

namespace verp::model {
namespace {

Color to_color(const ignition::math::Color& c) {
  return {static_cast<double>(c.R()), static_cast<double>(c.G()), static_cast<double>(c.B()),
          static_cast<double>(c.A())};
}

class WorldLoader {
 public:
  explicit WorldLoader(const std::string& path) : xml_(path) { out_.file = path; }

  World load() {
    const LibraryConsole silence;
    sdf::ParserConfig config;
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
    config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);
    config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
    sdf::Root root;
    const sdf::Errors errors = root.LoadSdfString(xml_.text_without_robots(), config);
    if (!errors.empty()) refuse_library(errors.front());
    const sdf::World& world = *root.WorldByIndex(0);
    out_.name = world.Name();
    out_.gravity_m_s2 = to_vector(world.Gravity());
    if (world.Scene() != nullptr) read_scene(*world.Scene());
    read_effects();
    const sdf::ElementPtr camera = inner(inner(world.Element(), "gui"), "camera");
    if (inner(camera, "pose"))
      out_.view = to_transform(camera->Get<ignition::math::Pose3d>("pose"));
    for (std::uint64_t i = 0; i < world.LightCount(); ++i) add_light(*world.LightByIndex(i));
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) add_model(*world.ModelByIndex(i));
    if (world.ActorCount() > 0)
      fail(world.ActorByIndex(0)->Name(), "an <actor> is not known here", "make it a <model>");
    out_.robots = xml_.robots();
    check_ground();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& about, const std::string& message,
                         const std::string& fix) const {
    throw LoadError(xml_.path(), xml_.line_of(about), message, fix);
  }

  [[noreturn]] void refuse_library(const sdf::Error& error) const {
    const int line = error.LineNumber().value_or(0);
    throw LoadError(xml_.path(), line > 0 ? line : xml_.blame(error.Message()), error.Message(),
                    "see sdformat.org/spec for what SDF allows here");
  }

  void read_scene(const sdf::Scene& scene) {
    out_.ambient = to_color(scene.Ambient());
    out_.background = to_color(scene.Background());
    out_.shadows = scene.Shadows();
    out_.sky = inner(scene.Element(), "sky") != nullptr;
    const sdf::ElementPtr fog = inner(scene.Element(), "fog");
    if (!fog) return;
    Fog read;
    const std::string type = fog->Get<std::string>("type", "linear").first;
    if (type == "none") return;
    read.kind = type == "quadratic"     ? Fog::Kind::kSquared
                : type == "exponential" ? Fog::Kind::kExponential
                                        : Fog::Kind::kLinear;
    if (inner(fog, "color")) read.color = to_color(fog->Get<ignition::math::Color>("color"));
    read.start_m = fog->Get<double>("start", read.start_m).first;
    read.end_m = fog->Get<double>("end", read.end_m).first;
    read.density_1_m = fog->Get<double>("density", read.density_1_m).first;
    out_.fog = read;
  }

  /// <scene> ... <verp:effects antialias="false" textures="true" transparency="true"/>
  void read_effects() {
    for (const XmlElement& scene : xml_.world().children("scene")) {
      for (const XmlElement& effects : scene.children("verp:effects")) {
        effects.allow({"antialias", "textures", "transparency"});
        const auto read = [&](const char* name, bool& effect) {
          const std::string text = effects.text(name, "true");
          if (text != "true" && text != "false")
            effects.fail(std::string(name) + "=\"" + text + "\"", "give true or false");
          effect = text == "true";
        };
        read("antialias", out_.antialias);
        read("textures", out_.textures);
        read("transparency", out_.transparency);
      }
    }
  }

  void add_light(const sdf::Light& light) {
    Light out;
    out.kind = light.Type() == sdf::LightType::POINT  ? Light::Kind::kPoint
               : light.Type() == sdf::LightType::SPOT ? Light::Kind::kSpot
                                                      : Light::Kind::kDirectional;
    out.name = light.Name();
    out.pose = resolved(light.SemanticPose(), "");
    const Vec3 direction = out.pose.linear() * to_vector(light.Direction());
    if (direction.norm() > 0) out.direction = direction.normalized();
    out.diffuse = to_color(light.Diffuse());
    out.specular = to_color(light.Specular());
    out.range_m = light.AttenuationRange();
    out.constant = light.ConstantAttenuationFactor();
    out.linear_1_m = light.LinearAttenuationFactor();
    out.quadratic_1_m2 = light.QuadraticAttenuationFactor();
    out.inner_rad = light.SpotInnerAngle().Radian();
    out.outer_rad = light.SpotOuterAngle().Radian();
    out.falloff = light.SpotFalloff();
    out.casts_shadows = light.CastShadows();
    out_.lights.push_back(std::move(out));
  }

  void add_model(const sdf::Model& model) {
    if (model.ModelCount() > 0)
      fail(model.Name(), "a model within a model is not known here",
           "place it in the world itself");
    if (!model.Static() && (model.JointCount() > 0 || model.LinkCount() > 1)) {
      fail(model.Name(), "a model of several links that moves has to be a robot",
           "make it one link, or <static>true</static>, or <include> a robot's file");
    }
    const Transform pose = resolved(model.SemanticPose(), "");
    const bool several = model.LinkCount() > 1;
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& link = *model.LinkByIndex(i);
      WorldObject object;
      object.name = several ? model.Name() + "/" + link.Name() : model.Name();
      object.line = xml_.line_of(model.Name());
      object.pose = pose * model_pose(link.SemanticPose());
      object.kind = model.Static() ? WorldObject::Kind::kStatic : WorldObject::Kind::kDynamic;
      read_motion(model, object);
      read_mass(link, object);
      for (std::uint64_t c = 0; c < link.CollisionCount(); ++c)
        add_collision(*link.CollisionByIndex(c), link, object);
      for (std::uint64_t v = 0; v < link.VisualCount(); ++v)
        add_visual(*link.VisualByIndex(v), link, object);
      out_.objects.push_back(std::move(object));
    }
  }

  /// <verp:motion loop="true"><verp:waypoint t_s="0" x_m="1" y_m="0" z_m="0" yaw_rad="0"/>...
  void read_motion(const sdf::Model& model, WorldObject& object) const {
    for (const XmlElement& each : xml_.world().children("model")) {
      if (each.text("name", "") != model.Name()) continue;
      for (const XmlElement& motion : each.children("verp:motion")) {
        motion.allow({"loop"}, {"verp:waypoint"});
        object.kind = WorldObject::Kind::kMoving;
        object.loops = motion.text("loop", "false") == "true";
        for (const XmlElement& point : motion.children("verp:waypoint"))
          add_waypoint(point, object);
        if (object.waypoints.size() < 2)
          motion.fail("a motion needs two <verp:waypoint> or more",
                      "give where it is at which t_s");
      }
    }
  }

  static void add_waypoint(const XmlElement& point, WorldObject& object) {
    constexpr double kFar_m = 1000, kDay_s = 86400;
    point.allow({"t_s", "x_m", "y_m", "z_m", "yaw_rad"});
    Waypoint out;
    out.t_s = point.number_within("t_s", 0, kDay_s, " s");
    const Vec3 start = object.pose.translation();
    out.pose = object.pose;
    out.pose.translation() = Vec3(point.number_within("x_m", -kFar_m, kFar_m, " m", start.x()),
                                  point.number_within("y_m", -kFar_m, kFar_m, " m", start.y()),
                                  point.number_within("z_m", -kFar_m, kFar_m, " m", start.z()));
    if (point.has("yaw_rad")) {
      const double yaw_rad = point.number_within("yaw_rad", -1000, 1000, " rad");
      out.pose.linear() = Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()).toRotationMatrix();
    }
    if (!object.waypoints.empty() && out.t_s <= object.waypoints.back().t_s)
      point.fail("t_s does not rise", "give the waypoints in the order of their times");
    object.waypoints.push_back(out);
  }

  void read_mass(const sdf::Link& link, WorldObject& object) const {
    const auto& inertial = link.Inertial();
    object.mass_kg = inertial.MassMatrix().Mass();
    object.com_m = to_vector(inertial.Pose().Pos());
    object.inertia_kg_m2 = to_matrix(inertial.Moi());
    if (object.kind != WorldObject::Kind::kDynamic) return;
    if (link.Element()->HasElement("inertial")) return;
    fail(object.name, "'" + object.name + "' moves and has no <inertial>",
         "give its mass and inertia, or <static>true</static>");
  }

  static ContactSurface read_world_surface(const sdf::ElementPtr& collision) {
    ContactSurface out;
    const auto surface = inner(collision, "surface");
    read_leaf(inner(inner(surface, "friction"), "ode"), "mu", out.friction);
    read_leaf(inner(surface, "bounce"), "restitution_coefficient", out.restitution);
    const auto contact = inner(inner(surface, "contact"), "ode");
    read_leaf(contact, "kp", out.stiffness_n_m);
    if (out.stiffness_n_m > 0) out.damping_n_s_m = 100;
    read_leaf(contact, "kd", out.damping_n_s_m);
    return out;
  }

  void add_collision(const sdf::Collision& sdf, const sdf::Link& link, WorldObject& object) {
    WorldCollision out;
    out.name = sdf.Name();
    out.pose = resolved(sdf.SemanticPose(), link.Name());
    out.shape = read_world_shape(*sdf.Geom(), sdf.Name(), out.pose);
    out.surface = read_world_surface(sdf.Element());
    const bool moves = object.kind != WorldObject::Kind::kStatic;
    using Kind = Shape::Kind;
    if (moves && (out.shape.kind == Kind::kPlane || out.shape.kind == Kind::kHeightfield)) {
      fail(sdf.Name(), "a plane or heightfield cannot move",
           "make its model <static>true</static>");
    }
    if (moves && out.shape.kind == Kind::kMesh) {
      fail(sdf.Name(), "a mesh that moves cannot be touched here",
           "keep it in the <visual>, and give <collision> boxes, cylinders, spheres or capsules");
    }
    object.collisions.push_back(std::move(out));
  }

  void add_visual(const sdf::Visual& sdf, const sdf::Link& link, WorldObject& object) {
    WorldVisual out;
    out.name = sdf.Name();
    out.pose = resolved(sdf.SemanticPose(), link.Name());
    if (const auto* mesh = sdf.Geom()->MeshShape()) {  // the renderer reads it
      out.shape.kind = Shape::Kind::kMesh;
      Mesh named;
      named.file = file_at(mesh->Uri(), sdf.Name());
      out.shape.mesh = std::make_shared<const Mesh>(std::move(named));
      out.shape.size_m = to_vector(mesh->Scale());
    } else {
      out.shape = read_world_shape(*sdf.Geom(), sdf.Name(), out.pose);
    }
    out.casts_shadows = sdf.CastShadows();
    if (const sdf::Material* material = sdf.Material()) {
      out.material.ambient = to_color(material->Ambient());
      out.material.diffuse = to_color(material->Diffuse());
      out.material.specular = to_color(material->Specular());
      out.material.emissive = to_color(material->Emissive());
      out.material.texture = texture_of(*material, sdf.Name());
    }
    out.material.transparency = static_cast<double>(sdf.Transparency());
    object.visuals.push_back(std::move(out));
  }

  std::string texture_of(const sdf::Material& material, const std::string& about) const {
    const auto metal = inner(inner(material.Element(), "pbr"), "metal");
    const auto map = inner(metal, "albedo_map");
    return map ? file_at(map->Get<std::string>(), about) : "";
  }

  std::string file_at(const std::string& uri, const std::string& about) const {
    const std::string found = resolve_model_uri(uri, xml_.path());
    if (!found.empty()) return found;
    fail(about, "there is no file '" + uri + "' beside this one, nor in " + model_path_text(),
         "give its path from here");
  }

  /// Also turns `pose` to a plane's normal and moves it to a heightfield's place.
  Shape read_world_shape(const sdf::Geometry& geometry, const std::string& about, Transform& pose) {
    Shape out;
    if (const auto* plane = geometry.PlaneShape()) {
      out.kind = Shape::Kind::kPlane;
      out.size_m = {plane->Size().X(), plane->Size().Y(), 0};
      const Vec3 normal = to_vector(plane->Normal());
      if (!(normal.norm() > 0.5))
        fail(about, "a plane without a normal", "give <normal>0 0 1</normal>");
      pose.linear() *= turn_of_z(normal).toRotationMatrix();
    } else if (const auto* mesh = geometry.MeshShape()) {
      out.kind = Shape::Kind::kMesh;
      out.mesh = mesh_at(*mesh, about);
    } else if (const auto* field = geometry.HeightmapShape()) {
      out.kind = Shape::Kind::kHeightfield;
      pose.translation() += pose.linear() * to_vector(field->Position());
      const std::string file = file_at(field->Uri(), about);
      out.heightfield =
          in_file<Heightfield>(file, about, "heights are a .pgm of 2 to 2049 samples a side",
                               [&] { return read_pgm(file, to_vector(field->Size())); });
    } else if (!read_solid(geometry, out.kind, out.size_m)) {
      fail(about, "'" + about + "' has a shape that is not known here",
           "use plane, box, sphere, cylinder, capsule, heightmap or mesh");
    }
    return out;
  }

  std::shared_ptr<const Mesh> mesh_at(const sdf::Mesh& mesh, const std::string& about) const {
    const std::string file = file_at(mesh.Uri(), about);
    return in_file<Mesh>(file, about, "touched are meshes of .stl and .obj, of 200000 triangles",
                         [&] { return read_mesh_to_touch(file, to_vector(mesh.Scale())); });
  }

  template <class Thing, class Read>
  std::shared_ptr<const Thing> in_file(const std::string& file, const std::string& about,
                                       const std::string& fix, Read read) const {
    try {
      return read();
    } catch (const std::runtime_error& error) {
      fail(about, file + ": " + error.what(), fix);
    }
  }

  void check_ground() const {
    const WorldObject* ground = nullptr;
    for (const WorldObject& object : out_.objects) {
      for (const WorldCollision& each : object.collisions) {
        const auto kind = each.shape.kind;
        if (kind != Shape::Kind::kPlane && kind != Shape::Kind::kHeightfield) continue;
        if (ground != nullptr) {
          throw LoadError(xml_.path(), object.line,
                          "a second ground, '" + object.name + "', after '" + ground->name +
                              "' in line " + std::to_string(ground->line),
                          "keep one plane or heightfield; make the other a box");
        }
        ground = &object;
      }
    }
    if (ground == nullptr) {
      fail(out_.name, "this world has no ground",
           "add a <static> model with a <collision> of <plane> or <heightmap>");
    }
  }

  WorldXml xml_;
  World out_;
};

}  // namespace

World load_world(const std::string& path) {
  return WorldLoader(path).load();
}

}  // namespace verp::model
