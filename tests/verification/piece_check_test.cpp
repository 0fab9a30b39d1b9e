// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/reduction/reduce.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "unit/results/temporary_folder.hpp"

/// Links whose pieces can be reduced, but not the whole.
namespace limber::piece_check_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

scene::Reducer make_reducer_of_pieces_alone() {
  const flexbody::Reducer real = flexbody::make_reducer();
  return {real.mesher, [real](const flexbody::MeshSource& source) {
            flexbody::MeshAtHand mesh = real.make_mesh(source);
            mesh.reduce = [](const flexbody::Recipe&) -> flexbody::ReducedBody {
              throw NumericalError("stiffness matrix: out of memory");
            };
            return mesh;
          }};
}

TEST(CheckOfPieces, ThatTheMemoryDoesNotAllowIsReportedAndTheSceneBuilt) {
  const results::test::TemporaryFolder folder;
  std::ofstream(folder.path() / "bar.geo")
      << "Point(1) = {0, 0, 0};\n"
         "l[] = Extrude {0, 0.1, 0} { Point{1}; Layers{1}; };\n"
         "s[] = Extrude {0, 0, 0.1} { Line{l[1]}; Layers{1}; Recombine; };\n"
         "v[] = Extrude {1, 0, 0} { Surface{s[1]}; Layers{6}; Recombine; };\n"
         "Physical Surface(\"root\") = {s[1]};\n"
         "Physical Volume(\"body\") = {v[1]};\nMesh.ElementOrder = 2;\n";
  std::ofstream(folder.path() / "r.urdf")
      << "<robot name='r'><link name='world'/><link name='bar'/>"
         "<joint name='j' type='fixed'><parent link='world'/>"
         "<child link='bar'/></joint>"
         "<flexible link='bar' pieces='2'><mesh file='bar.geo'/>"
         "<material youngs_modulus='2e11' poisson_ratio='0.3' "
         "density='7800'/><attach joint='j' interface='root'/>"
         "</flexible></robot>\n";
  std::ofstream(folder.path() / "s.toml")
      << "robot = 'r.urdf'\n[time]\nduration = 1.0\nstep = 0.01\n";
  const scene::BuiltScene built = scene::build_system(
      scene::load_scene(folder.path() / "s.toml"),
      make_reducer_of_pieces_alone(), folder.path() / "cache");
  EXPECT_EQ(built.bodies_reduced, 2);
  EXPECT_THAT(built.warnings,
              Contains(HasSubstr("link 'bar': its 2 pieces are not compared "
                                 "with the whole link: stiffness matrix")));
}

}  // namespace
}  // namespace limber::piece_check_test
