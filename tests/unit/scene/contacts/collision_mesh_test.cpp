// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/collision_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <sstream>

#include "limber/common/rotation.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::collision_mesh_test {
namespace {

using test::input_error;
using test::TemporaryFile;
using ::testing::HasSubstr;

// Of the cube from 0 to 1, moved; outward.
std::vector<Triangle> make_cube(const Vector3& from = Vector3::Zero()) {
  constexpr std::array<std::array<int, 3>, 12> kFaces = {{{0, 2, 3},
                                                          {0, 3, 1},
                                                          {4, 5, 7},
                                                          {4, 7, 6},
                                                          {0, 1, 5},
                                                          {0, 5, 4},
                                                          {2, 6, 7},
                                                          {2, 7, 3},
                                                          {0, 4, 6},
                                                          {0, 6, 2},
                                                          {1, 3, 7},
                                                          {1, 7, 5}}};
  std::vector<Triangle> triangles;
  for (const auto& face : kFaces) {
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      const int k = face[i];
      triangle[i] = from + Vector3(k & 1, k >> 1 & 1, k >> 2);
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

std::string write_text_stl(const std::vector<Triangle>& triangles) {
  std::ostringstream out;
  out << "solid part\n";
  for (const Triangle& triangle : triangles) {
    out << " facet normal 0 0 0\n  outer loop\n";
    for (const Vector3& x : triangle) {
      out << "   vertex " << x.x() << " " << x.y() << " " << x.z() << "\n";
    }
    out << "  endloop\n endfacet\n";
  }
  out << "endsolid part\n";
  return out.str();
}

std::string write_binary_stl(const std::vector<Triangle>& triangles) {
  std::string out(84, ' ');
  out.replace(0, 5, "solid");  // as some programs begin
  const auto count = static_cast<std::uint32_t>(triangles.size());
  std::memcpy(out.data() + 80, &count, 4);
  for (const Triangle& triangle : triangles) {
    std::string record(50, '\0');
    for (std::size_t k = 0; k < 9; ++k) {
      const auto number =
          static_cast<float>(triangle[k / 3][static_cast<Eigen::Index>(k % 3)]);
      std::memcpy(record.data() + 12 + 4 * k, &number, 4);
    }
    out += record;
  }
  return out;
}

constexpr const char* kObj =
    "# a cube\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\n"
    "v 1 1 1\nvn 0 0 1\nf 1 3 4 2\nf 5/1 6/1 8/1 7/1\nf 1//1 2//1 6//1 5//1\n"
    "f 3 7 8 4\nf -8 -4 -2 -6\nf 2 4 8 6\n";

double find_volume(const flexbody::ContactSurface& surface) {
  double volume = 0.0;
  for (const auto& f : surface.faces) {
    const Vector3 a = surface.x_B.col(f[0]);
    const Vector3 b = surface.x_B.col(f[1]);
    const Vector3 c = surface.x_B.col(f[2]);
    volume += a.cross(b).dot(c) / 6.0;
  }
  return volume;
}

TEST(CollisionMesh, IsTheSameOfEveryKindOfFile) {
  const std::pair<const char*, std::string> files[] = {
      {"a.stl", write_text_stl(make_cube())},
      {"b.STL", write_binary_stl(make_cube())},
      {"c.obj", kObj}};
  for (const auto& [name, text] : files) {
    const TemporaryFile file(name, text);
    const auto surface =
        read_collision_mesh({file.path(), Vector3::Ones()}, {});
    EXPECT_EQ(surface.x_B.cols(), 8) << name;
    EXPECT_EQ(surface.faces.size(), 12U) << name;
    EXPECT_NEAR(find_volume(surface), 1.0, 1e-14) << name;
    EXPECT_TRUE(contact::MeshSurface(surface).is_closed()) << name;
    EXPECT_DOUBLE_EQ(surface.patch_radius.maxCoeff(), 0.5) << name;
  }
}

TEST(CollisionMesh, IsScaledMirroredAndPlaced) {
  const TemporaryFile file("scaled.stl", write_binary_stl(make_cube()));
  const Pose X{exp_rotation(Vector3(0.1, 0.2, 0.3)), {1.0, 2.0, 3.0}};
  const auto surface =
      read_collision_mesh({file.path(), Vector3(-2.0, 3.0, 0.5)}, X);
  EXPECT_NEAR(find_volume(surface), 3.0, 1e-12);  // outward though mirrored
  const Vector3 far = X * Vector3(-2.0, 3.0, 0.5);
  double least = 1.0;
  for (const auto& x : surface.x_B.colwise()) {
    least = std::min(least, (x - far).norm());
  }
  EXPECT_LT(least, 1e-14);
}

/// A tetrahedron with its legs 0.1, 0.2 and 0.3 m along x, y, z of its node,
/// which is at x = 0.01 m: in millimetres.
std::string write_dae(const std::string& up) {
  return "<?xml version='1.0' encoding='utf-8'?><COLLADA "
         "xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><unit name='millimeter' meter='0.001'/>"
         "<up_axis>" +
         up +
         "</up_axis></asset><library_geometries><geometry id='g'><mesh><source "
         "id='p'><float_array id='a' count='12'>0 0 0 100 0 0 0 200 0 0 0 300"
         "</float_array><technique_common><accessor source='#a' count='4' "
         "stride='3'><param name='X' type='float'/><param name='Y' "
         "type='float'/><param name='Z' type='float'/></accessor>"
         "</technique_common></source><vertices id='v'><input "
         "semantic='POSITION' source='#p'/></vertices><triangles count='4'>"
         "<input semantic='VERTEX' source='#v' offset='0'/><p>0 2 1 0 1 3 0 3 "
         "2 1 2 3</p></triangles></mesh></geometry></library_geometries>"
         "<library_visual_scenes><visual_scene id='s'><node id='n'><translate>"
         "10 0 0</translate><instance_geometry url='#g'/></node>"
         "</visual_scene></library_visual_scenes><scene>"
         "<instance_visual_scene url='#s'/></scene></COLLADA>";
}

// As robot software has it: units count, and what is up does not.
TEST(CollisionMesh, OfColladaIsInMetresAndItsOwnAxes) {
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
    const TemporaryFile file("part.dae", write_dae(up));
    std::vector<Triangle> triangles;
    try {
      triangles = read_triangles(file.path());
    } catch (const InputError& error) {
      ASSERT_THAT(error.what(), HasSubstr("assimp-utils"));
      GTEST_SKIP() << error.what();
    }
    ASSERT_EQ(triangles.size(), 4U);
    Vector3 least = triangles[0][0];
    Vector3 most = triangles[0][0];
    for (const Triangle& triangle : triangles) {
      for (const Vector3& x : triangle) {
        least = least.cwiseMin(x);
        most = most.cwiseMax(x);
      }
    }
    EXPECT_LT((least - Vector3(0.01, 0.0, 0.0)).norm(), 1e-7) << up;
    EXPECT_LT((most - Vector3(0.11, 0.2, 0.3)).norm(), 1e-7) << up;
    EXPECT_NEAR(find_volume(join_triangles(triangles, "m")), 1e-3, 1e-9) << up;
  }
}

// As files of many vendors have them: edges drawn beside the faces.
TEST(CollisionMesh, OfColladaHasNoLines) {
  const std::string lines =
      "<lines count='2'><input semantic='VERTEX' source='#v' offset='0'/><p>0 "
      "1 "
      "2 3</p></lines>";
  std::string both = write_dae("Z_UP");
  both.insert(both.find("</mesh>"), lines);
  std::string alone = write_dae("Z_UP");
  const std::size_t from = alone.find("<triangles");
  alone.replace(from, alone.find("</mesh>") - from, lines);
  const TemporaryFile file("both.dae", both);
  const TemporaryFile other("alone.dae", alone);
  const std::string why =
      input_error([&] { (void)read_triangles(other.path()); });
  if (why.find("assimp-utils") != std::string::npos) GTEST_SKIP() << why;
  EXPECT_THAT(why, HasSubstr("it has no triangles"));
  const std::vector<Triangle> triangles = read_triangles(file.path());
  EXPECT_EQ(triangles.size(), 4U);
  EXPECT_NEAR(find_volume(join_triangles(triangles, "m")), 1e-3, 1e-9);
}

TEST(CollisionMesh, OfDamagedColladaSaysWhatIsWrong) {
  const TemporaryFile file("a.dae", "<xml/>");
  const std::string why =
      input_error([&] { (void)read_triangles(file.path()); });
  EXPECT_THAT(why, HasSubstr("a.dae"));
  EXPECT_THAT(why, HasSubstr("assimp"));
}

TEST(CollisionMesh, JoinsCornersThatRoundOffParted) {
  auto triangles = make_cube();
  triangles[3][1] += Vector3(3e-7, -3e-7, 3e-7);
  EXPECT_EQ(join_triangles(triangles, "m").x_B.cols(), 8);
  triangles[3][1] += Vector3(3e-6, 0.0, 0.0);
  EXPECT_THROW((void)join_triangles(triangles, "m"), InputError);
}

TEST(CollisionMesh, RefusesWhatIsNoClosedSurfaceAndSaysWhere) {
  const auto refusal = [](const std::vector<Triangle>& triangles) {
    return input_error([&] { (void)join_triangles(triangles, "m"); });
  };
  auto open = make_cube();
  open.erase(open.begin());
  EXPECT_THAT(refusal(open),
              HasSubstr("mesh 'm' is open: the edge from (0, 0, 0) m to "));
  auto turned = make_cube();
  std::swap(turned[2][0], turned[2][1]);
  EXPECT_THAT(refusal(turned), HasSubstr("has triangles of opposite senses"));
  auto inward = make_cube();
  for (auto& triangle : inward) std::swap(triangle[0], triangle[1]);
  EXPECT_THAT(refusal(inward), HasSubstr("is inside out (volume -1 m^3)"));
  auto flat = make_cube();
  flat[4][2] = 0.5 * (flat[4][0] + flat[4][1]);
  EXPECT_THAT(refusal(flat),
              HasSubstr("has a triangle without area at (0, 0, 0) m"));
  auto twice = make_cube();
  twice.push_back(twice[0]);
  EXPECT_THAT(refusal(twice), HasSubstr("expected two"));
  auto crossing = make_cube();
  const auto second = make_cube({0.5, 0.4, 0.3});
  crossing.insert(crossing.end(), second.begin(), second.end());
  EXPECT_THAT(refusal(crossing), HasSubstr("crosses itself at ("));
  auto apart = make_cube();
  const auto other = make_cube({1.5, 0.4, 0.3});
  apart.insert(apart.end(), other.begin(), other.end());
  EXPECT_EQ(refusal(apart), "");
}

TEST(CollisionMesh, RefusesDamagedFilesAndSaysWhere) {
  const auto refusal = [](const std::string& name, const std::string& text) {
    const TemporaryFile file(name, text);
    return input_error([&] { (void)read_triangles(file.path()); });
  };
  EXPECT_THAT(refusal("a.ply", "ply"), HasSubstr("expected a file .stl, .obj"));
  EXPECT_THAT(refusal("a.stl", ""), HasSubstr("neither a text"));
  EXPECT_THAT(refusal("a.stl", "solid x\nendsolid\n"),
              HasSubstr("has no triangles"));
  EXPECT_THAT(refusal("a.stl", "solid\nfacet\nvertex 0 nan 0\n"),
              HasSubstr("line 3: 'nan' is not a finite number"));
  EXPECT_THAT(refusal("a.stl", "solid\nfacet\nvertex 0 0 0\nendfacet\n"),
              HasSubstr("line 4: a facet without three corners"));
  EXPECT_THAT(refusal("a.stl", "solid\nfacet\nvertex 0 0 0\n"),
              HasSubstr("ends within a facet"));
  std::string binary = write_binary_stl(make_cube());
  const float nan = std::nanf("");
  std::memcpy(binary.data() + 84 + 50 + 12, &nan, 4);
  EXPECT_THAT(refusal("a.stl", binary),
              HasSubstr("triangle 2 has a coordinate that is not finite"));
  binary.resize(binary.size() - 7);
  binary.replace(0, 5, "xxxxx");
  EXPECT_THAT(refusal("a.stl", binary), HasSubstr("neither a text"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nf 1 1 2\n"),
              HasSubstr("line 2: corner '2'; expected the number of one of "
                        "the 1 points above"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
              HasSubstr("has no triangles"));
  EXPECT_THAT(input_error([] { (void)read_triangles("/none/such.stl"); }),
              HasSubstr("/none/such.stl"));
}

}  // namespace
}  // namespace limber::scene::collision_mesh_test
