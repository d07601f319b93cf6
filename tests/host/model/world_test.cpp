#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "host/robot/model/load_world.hpp"
#include "tests/host/model/test_files.hpp"

namespace verp::model {
namespace {

const std::string kFloor =
    "<model name=\"floor\"><static>true</static><link name=\"link\"><collision name=\"plane\">"
    "<geometry><plane><normal>0 0 1</normal><size>9 9</size></plane></geometry></collision></link>"
    "</model>\n";

std::string world_of(const std::string& inside) {
  return "<sdf version=\"1.9\" xmlns:verp=\"https://verp.dev/sdf/1\">\n<world name=\"w\">\n" +
         inside + "</world>\n</sdf>\n";
}

std::string a_box(const std::string& more, const std::string& geometry) {
  return "<model name=\"thing\">" + more + "<link name=\"link\"><collision name=\"c\"><geometry>" +
         geometry + "</geometry></collision></link></model>\n";
}

std::string refusal(const std::string& text) {
  const TemporaryFile file("world.sdf", text);
  try {
    load_world(file.path());
  } catch (const LoadError& error) {
    EXPECT_EQ(error.file, file.path());
    EXPECT_FALSE(error.fix.empty());
    return std::to_string(error.line) + ": " + error.message;
  }
  return "none";
}

TEST(Worlds, TheShippedOnesLoadByName) {
  const std::vector<std::string> names = world_names();
  for (const char* name :
       {"flat", "demo", "stairs", "rubble", "pitch", "hill", "bank", "ledge", "rough"}) {
    ASSERT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
    EXPECT_TRUE(is_world(name));
    const World world = load_world(find_world(name));
    EXPECT_EQ(world.name, name);
    EXPECT_FALSE(world.lights.empty()) << name;
  }
  EXPECT_FALSE(is_world("generic21"));
  EXPECT_GT(load_world(find_world("demo")).objects.size(), 5u);
}

TEST(Worlds, WhatTheFileSaysIsWhatThereIs) {
  const TemporaryFile file(
      "world.sdf",
      world_of(
          "<gravity>0 0 -3.7</gravity>\n"
          "<scene><fog><type>linear</type><start>2</start><end>9</end></fog></scene>\n" +
          kFloor +
          "<model name=\"ball\"><pose>1 2 3 0 0 0</pose><link name=\"link\"><inertial><mass>0.5"
          "</mass><inertia><ixx>0.001</ixx><iyy>0.001</iyy><izz>0.001</izz></inertia></inertial>"
          "<collision name=\"c\"><geometry><sphere><radius>0.2</radius></sphere></geometry>"
          "<surface><friction><ode><mu>0.3</mu></ode></friction><bounce>"
          "<restitution_coefficient>0.6</restitution_coefficient></bounce></surface>"
          "</collision></link></model>\n"
          "<model name=\"cart\"><static>true</static><verp:motion><verp:waypoint t_s=\"0\"/>"
          "<verp:waypoint t_s=\"2\" x_m=\"1\"/></verp:motion><link name=\"link\"/></model>\n"
          "<include><name>red</name><uri>" +
          robot_file("generic21") + "</uri><pose>1 2 0 0 0 0.5</pose></include>\n"));
  const World world = load_world(file.path());
  EXPECT_NEAR(world.gravity_m_s2.z(), -3.7, 1e-12);
  ASSERT_TRUE(world.fog.has_value());
  EXPECT_NEAR(world.fog->end_m, 9, 1e-12);
  ASSERT_EQ(world.objects.size(), 3u);
  const WorldObject& ball = world.objects[1];
  EXPECT_EQ(ball.kind, WorldObject::Kind::kDynamic);
  EXPECT_NEAR(ball.pose.translation().z(), 3, 1e-12);
  EXPECT_NEAR(ball.mass_kg, 0.5, 1e-12);
  EXPECT_NEAR(ball.collisions.at(0).surface.friction, 0.3, 1e-12);
  EXPECT_NEAR(ball.collisions.at(0).surface.restitution, 0.6, 1e-12);
  EXPECT_EQ(world.objects[2].kind, WorldObject::Kind::kMoving);
  EXPECT_EQ(world.objects[2].waypoints.size(), 2u);
  ASSERT_EQ(world.robots.size(), 1u);
  EXPECT_EQ(world.robots[0].name, "red");
  EXPECT_NEAR(world.robots[0].yaw_rad, 0.5, 1e-12);
}

TEST(Worlds, NoGroundAndTwoGroundsAreRefused) {
  EXPECT_EQ(refusal(world_of("")), "2: this world has no ground");
  std::string other = kFloor;
  other.replace(other.find("floor"), 5, "stage");
  EXPECT_EQ(refusal(world_of(kFloor + other)),
            "4: a second ground, 'stage', after 'floor' in line 3");
}

TEST(Worlds, WhatIsNoFileIsCalledWhatItIs) {
  const auto why = [](const std::string& path) -> std::string {
    try {
      return find_world(path);
    } catch (const LoadError& error) {
      return error.what();
    }
  };
  EXPECT_TRUE(why("/tmp").starts_with("/tmp: is a folder, not a world's file;")) << why("/tmp");
  EXPECT_TRUE(why("/dev/zero").starts_with("/dev/zero: is not a regular file;"));
  EXPECT_TRUE(why("/nowhere.sdf").starts_with("/nowhere.sdf: there is no such file;"));
  EXPECT_TRUE(why("nowhere").starts_with("nowhere: there is no world of this name;"));
}

TEST(Worlds, MistakesAreRefusedWhereTheyStand) {
  const std::string box = "<box><size>1 1 1</size></box>";
  const std::string fixed = "<static>true</static>";
  EXPECT_EQ(refusal(world_of(kFloor + a_box(fixed, "<sphere><radius>1,0</radius></sphere>"))),
            "4: <radius> is not 1 finite number: '1,0'");
  EXPECT_EQ(refusal(world_of(kFloor + a_box(fixed, "<box><size>1 1 -1</size></box>"))),
            "4: <size> is out of range: -1");
  EXPECT_EQ(refusal(world_of(kFloor + a_box("<inertial><mass></mass></inertial>", box))),
            "4: <mass> is not 1 finite number: ''");
  EXPECT_EQ(refusal(world_of(kFloor + a_box("", box))), "4: 'thing' moves and has no <inertial>");
  EXPECT_NE(
      refusal(world_of(kFloor + a_box(fixed, "<mesh><uri>no.stl</uri></mesh>"))).find("no.stl"),
      std::string::npos);
  EXPECT_NE(refusal(world_of(kFloor + a_box(fixed, "<cube/>"))), "none");
  EXPECT_NE(refusal("<sdf version=\"1.9\"><world name=\"a\"/><world name=\"b\"/></sdf>")
                .find("one <world> is needed, there are 2"),
            std::string::npos);
  EXPECT_NE(refusal("<sdf><world").find("malformed XML"), std::string::npos);
  EXPECT_NE(refusal(world_of(kFloor + "<include><uri>nobody.sdf</uri></include>\n"))
                .find("4: 'nobody.sdf' is no robot's file"),
            std::string::npos);
  EXPECT_THROW(find_world("nowhere"), LoadError);
}

TEST(Worlds, AMeshIsReadOrRefusedByWhatIsInIt) {
  const TemporaryFile text("a.stl",
                           "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                           "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
  const auto with = [](const std::string& file, const std::string& kind) {
    return world_of(kFloor +
                    a_box(kind, "<mesh><uri>" + file + "</uri><scale>2 2 2</scale></mesh>"));
  };
  const std::string fixed = "<static>true</static>";
  const TemporaryFile file("world.sdf", with(text.path(), fixed));
  const World world = load_world(file.path());
  const auto mesh = world.objects.at(1).collisions.at(0).shape.mesh;
  ASSERT_NE(mesh, nullptr);
  EXPECT_EQ(mesh->triangle.size(), 1u);
  EXPECT_NEAR(mesh->vertex_m.at(1).x(), 2, 1e-12);
  const TemporaryFile junk("b.stl", "this is no mesh");
  EXPECT_NE(refusal(with(junk.path(), fixed)).find("it is no .stl or .obj file"),
            std::string::npos);
  const TemporaryFile square("c.OBJ",
                             "# a square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\n"
                             "f 1//1 2//1 3//1 -1//1\n");
  const TemporaryFile about("square.sdf", with(square.path(), fixed));
  const World squared = load_world(about.path());
  const auto pair = squared.objects.at(1).collisions.at(0).shape.mesh;
  EXPECT_EQ(pair->triangle.size(), 2u);
  EXPECT_NEAR(pair->vertex_m.at(2).y(), 2, 1e-12);
  const TemporaryFile wild("d.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  EXPECT_NE(refusal(with(wild.path(), fixed)).find("names the corner '3'"), std::string::npos);
  const std::string inertial =
      "<pose>0 0 0 0 0 0</pose>";  // moves: refused before its missing mass
  EXPECT_NE(refusal(with(text.path(), inertial)), "none");
}

}  // namespace
}  // namespace verp::model
