#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <string>

#include "host/author/edit/meshes/triangles.hpp"
#include "tests/host/edit/files.hpp"

namespace verp::edit {
namespace {

struct Ended {
  int status = -1;
  std::string said;
};

Ended run(const std::string& words) {
  Ended ended;
  FILE* pipe = ::popen((VERP_PROGRAM " edit " + words + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return ended;
  char some[256];
  while (std::fgets(some, sizeof some, pipe) != nullptr) ended.said += some;
  ended.status = WEXITSTATUS(::pclose(pipe));
  return ended;
}

/// A cube's corner of 1 x 2 x 3, as STL text.
std::string tetrahedron(bool closed) {
  const char* corners[] = {"0 0 0", "1 0 0", "0 2 0", "0 0 3"};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string text = "solid t\n";
  for (int f = 0; f < (closed ? 4 : 3); ++f) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : faces[f]) text += std::string("vertex ") + corners[corner] + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

class EditWord : public testing::Test {
 protected:
  EditWord() : file_((folder_.path() / "a.sdf").string()), before_(read(robot("generic21"))) {
    write(file_, before_);
  }
  void expect_refused(const std::string& words, const std::string& because) {
    const Ended ended = run(file_ + " " + words);
    EXPECT_EQ(ended.status, 2) << ended.said;
    EXPECT_NE(ended.said.find(because), std::string::npos) << ended.said;
    EXPECT_EQ(ended.said.find('\n'), ended.said.size() - 1) << ended.said;
    EXPECT_EQ(read(file_), before_);
  }
  files::TemporaryDirectory folder_;
  std::string file_, before_;
};

TEST_F(EditWord, SetsShowsAndTellsTheDifference) {
  Ended ended = run(file_ + " set link:trunk/inertial/mass=1.25 --dry-run");
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.said.find("-        <mass>1.1</mass>\n+        <mass>1.25</mass>\n"),
            std::string::npos)
      << ended.said;
  EXPECT_EQ(read(file_), before_);
  ended = run(file_ + " set link:trunk/inertial/mass=1.25");
  EXPECT_EQ(ended.status, 0) << ended.said;
  EXPECT_EQ(run(file_ + " show link:trunk/inertial/mass").said, "link:trunk/inertial/mass=1.25\n");
}

TEST_F(EditWord, WrongInputIsOneLineAndExit2AndTheFileStays) {
  expect_refused("set link:trunk/inertial/mass=-1", ":10: <mass> is out of range");
  expect_refused("set link:trunk/inertial/mass=heavy", "not a finite number");
  expect_refused("set link:nobody/inertial/mass=1", "names no part");
  expect_refused("set link:trunk", "not NAME=VALUE");
  expect_refused("delete joint:l_knee", "left_leg");
  expect_refused("mirror link:trunk", "no side");
  expect_refused("mirror joint:l_knee", "is there already");
  expect_refused("duplicate joint:nobody x", "names no part");
  expect_refused("import /nowhere.stl --link x", "no such file");
  expect_refused("import " + file_ + " --link x", "not a mesh");
}

TEST_F(EditWord, AMeshBecomesALinkWithItsOwnInertia) {
  const std::string mesh = (folder_.path() / "t.stl").string();
  write(mesh, tetrahedron(true));
  const Triangles triangles = read_triangles(mesh, 0.01);
  const Filling inside = filling(triangles);
  EXPECT_TRUE(inside.closed);
  EXPECT_NEAR(inside.volume_m3, 1e-6, 1e-12);  // a sixth
  EXPECT_LT((inside.centre_m - Vec3(0.0025, 0.005, 0.0075)).norm(), 1e-9);
  // A corner of a, b, c has 3/80 (b2 + c2) about x, a b/80 off the diagonal.
  EXPECT_NEAR(inside.inertia_per_kg(0, 0), 3.0 / 80 * (4 + 9) * 1e-4, 1e-10);
  EXPECT_NEAR(inside.inertia_per_kg(0, 1), 2.0 / 80 * 1e-4, 1e-10);
  const Ended ended =
      run(file_ + " import " + mesh + " --link skull --unit cm --density 100000 --fit box");
  EXPECT_EQ(ended.status, 2) << "that is heavier than anything: " << ended.said;
  const Ended good =
      run(file_ + " import " + mesh + " --link skull --unit cm --mass 0.1 --fit sphere");
  EXPECT_EQ(good.status, 0) << good.said;
  const std::string now = read(file_);
  EXPECT_NE(now.find("<uri>t.stl</uri>"), std::string::npos);
  EXPECT_NE(now.find("<mass>0.1</mass>"), std::string::npos);
  write(mesh, tetrahedron(false));
  EXPECT_NE(
      run(file_ + " import " + mesh + " --link skull --unit cm --mass 0.1").said.find("not closed"),
      std::string::npos);
  EXPECT_NE(run(file_ + " import " + mesh + " --link skull --unit m --mass 0.1").status, 1);
}

TEST_F(EditWord, TheSolidAroundAMeshHoldsAllOfIt) {
  const std::string mesh = (folder_.path() / "t.stl").string();
  write(mesh, tetrahedron(true));
  const Triangles triangles = read_triangles(mesh, 0.01);
  for (const char* name : {"box", "sphere", "capsule", "cylinder"}) {
    const Solid solid = fitted(triangles, solid_kind(name));
    const Vec3& a = solid.rpy_rad;
    const Mat3 turn =
        (Eigen::AngleAxisd(a.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(a.y(), Vec3::UnitY()) *
         Eigen::AngleAxisd(a.x(), Vec3::UnitX()))
            .toRotationMatrix();
    for (const Vec3& point : triangles.points_m) {
      const Vec3 p = turn.transpose() * (point - solid.centre_m),
                 half = solid.size_m / 2 + Vec3::Constant(1e-9);
      const double r = solid.size_m.x() + 1e-9, across = std::hypot(p.x(), p.y());
      const double beyond = std::max(0.0, std::abs(p.z()) - half.z());
      const bool holds = solid.kind == Solid::Kind::kBox ? (p.cwiseAbs() - half).maxCoeff() <= 0
                         : solid.kind == Solid::Kind::kSphere  ? p.norm() <= r
                         : solid.kind == Solid::Kind::kCapsule ? std::hypot(across, beyond) <= r
                                                               : across <= r && beyond <= 0;
      EXPECT_TRUE(holds) << name << " " << p.transpose();
    }
  }
}

}  // namespace
}  // namespace verp::edit
