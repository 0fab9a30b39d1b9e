// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "limber/fem/gmsh/gmsh_reader.hpp"
#include "limber/fem/gmsh/gmsh_session.hpp"
#include "limber/fem/mesh/mesh_file_kind.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::mesh_formats_test {
namespace {

using ::testing::AllOf;
using testing::find_read_error;
using ::testing::HasSubstr;
using testing::write_file;

const ElasticMaterial kUnitDensity{1e9, 0.3, 1.0};

double volume_of(const Mesh& mesh) {
  const std::vector<ElasticMaterial> each(mesh.volume_groups.size(),
                                          kUnitDensity);
  return calc_mass_properties(assemble(mesh, each).M_s, mesh.x).mass;
}

const std::string kBox =
    "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.3, 0.2, 0.1};\n";

/// The box in a form that Gmsh writes.
std::filesystem::path write_box(const std::string& name, bool is_mesh) {
  const auto source = write_file("source.geo", kBox);
  const auto file = testing::make_test_folder() / name;
  const GmshSession session;
  gmsh::open(source.string());
  if (is_mesh) {
    gmsh::model::addPhysicalGroup(3, {1}, 7);
    gmsh::model::setPhysicalName(3, 7, "body");
    gmsh::option::setNumber("Mesh.MeshSizeMax", 0.1);
    gmsh::model::mesh::generate(3);
  }
  // Gmsh reads names in capitals, and does not write them.
  std::string small = name;
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const auto written = testing::make_test_folder() / small;
  gmsh::write(written.string());
  if (written != file) std::filesystem::rename(written, file);
  return file;
}

class MeshFormat : public ::testing::TestWithParam<const char*> {};

TEST_P(MeshFormat, IsReadWithTheBoxsVolume) {
  const auto file = write_box(std::string("box") + GetParam(), true);
  const Mesh mesh = read_mesh(file);
  EXPECT_NEAR(volume_of(mesh), 0.3 * 0.2 * 0.1, 1e-8);  // 8 digits in .bdf
}
INSTANTIATE_TEST_SUITE_P(Kinds, MeshFormat,
                         ::testing::Values(".msh", ".bdf", ".nas", ".unv",
                                           ".vtk", ".BDF", ".MSH"),
                         [](const auto& kind) {
                           return std::string(kind.param).substr(1);
                         });

class GeometryFormat : public ::testing::TestWithParam<const char*> {};

TEST_P(GeometryFormat, IsMeshedWithTheBoxsVolume) {
  const auto file = write_box(std::string("box") + GetParam(), false);
  // Of a file that says millimetres, too.
  const Mesh mesh = read_mesh(file, {.size = 0.1, .unit = 1.0});
  EXPECT_NEAR(volume_of(mesh), 0.3 * 0.2 * 0.1, 1e-9);
}
INSTANTIATE_TEST_SUITE_P(Kinds, GeometryFormat,
                         ::testing::Values(".step", ".stp", ".brep", ".STEP"),
                         [](const auto& kind) {
                           return std::string(kind.param).substr(1);
                         });

TEST(MeshFileKind, AMeshFileMustBeginAsOne) {
  EXPECT_THAT(
      find_read_error(write_file("geo.msh", kBox)),
      AllOf(HasSubstr("but its content does not"), HasSubstr("Gmsh geometry")));
  EXPECT_THAT(
      find_read_error(write_file("call.msh", "SystemCall \"touch x\";")),
      HasSubstr("but its content does not"));
  EXPECT_THAT(find_read_error(write_file(
                  "blank.msh", "\n" + testing::unit_tetrahedron().str())),
              HasSubstr("but its content does not"));
  EXPECT_THAT(find_read_error(write_file("empty.msh", "")), HasSubstr("empty"));
}

TEST(MeshFileKind, EveryOtherFileMustBeWhatItsNameSays) {
  for (const std::string_view extension : kMeshFileExtensions) {
    if (extension == ".msh" || extension == ".geo") continue;
    EXPECT_THAT(find_read_error(write_file("x" + std::string(extension), kBox)),
                HasSubstr("but its content does not"))
        << extension;
  }
  EXPECT_THAT(
      find_read_error(write_file("x.geo", testing::unit_tetrahedron().str())),
      HasSubstr("it may be a Gmsh mesh"));
  EXPECT_THAT(find_read_error(write_file("x.Msh", "")), HasSubstr("'.msh'"));
}

TEST(MeshFileKind, AStepFileThatCannotBeReadSaysSo) {
  std::ifstream in(write_box("box.step", false));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const std::size_t size : {text.size() / 4, text.size() / 2}) {
    EXPECT_THAT(find_read_error(write_file("cut.step", text.substr(0, size))),
                ::testing::AnyOf(HasSubstr("Gmsh cannot read it"),
                                 HasSubstr("no volume")));
  }
}

TEST(MeshFileKind, AMedFileTellsWhatGmshWasBuiltWithout) {
  EXPECT_THAT(find_read_error(write_file("x.med", "\x89HDF\r\n\x1a\nrest")),
              HasSubstr("Gmsh cannot read it"));
}

/// A thin tube of curved elements that OpenCASCADE's surfaces invert.
TEST(CurvedElements, ThatComeOutInvertedAreMadeStraightAndThatIsReported) {
  const auto file = write_file(
      "tube.geo",
      "SetFactory(\"OpenCASCADE\");\nCylinder(1) = {0,0,0, 0,0,0.5, 0.02};\n"
      "Cylinder(2) = {0,0,0, 0,0,0.5, 0.018};\n"
      "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n");
  const TracedMesh traced =
      read_traced_mesh(file, {.size = 0.01, .order = 2}, find_mesher());
  ASSERT_EQ(traced.notices.size(), 1U);
  EXPECT_THAT(
      traced.notices[0],
      AllOf(HasSubstr("inverted"), HasSubstr("Mesh.SecondOrderLinear = 1")));
  EXPECT_EQ(traced.mesh.blocks[0].element->order, 2);
}

// A library's user may have a session of Gmsh open.
TEST(GmshReader, LeavesTheHostsSessionOpenWithItsModels) {
  const auto file = write_file("box.geo", kBox);
  gmsh::initialize();
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("host");
  gmsh::model::occ::addSphere(0, 0, 0, 1.0);
  gmsh::model::occ::synchronize();
  const Mesh mesh = read_mesh_in_process(file, {.size = 0.1});
  EXPECT_NEAR(volume_of(mesh), 0.3 * 0.2 * 0.1, 1e-12);
  EXPECT_EQ(volume_of(read_mesh_in_process(file, {.size = 0.1})),
            volume_of(mesh));
  std::string current;
  gmsh::model::getCurrent(current);
  EXPECT_EQ(current, "host");
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  EXPECT_EQ(volumes.size(), 1U);
  std::vector<std::string> models;
  gmsh::model::list(models);
  EXPECT_EQ(models.size(), 2U);  // Gmsh's own empty one, and the host's
  gmsh::finalize();
}

TEST(GmshReader, MakesTheMeshersMesh) {
  const auto file = write_file("box.geo", kBox);
  const MeshOptions options{.size = 0.05, .order = 2};
  EXPECT_EQ(find_mesh_content(read_mesh_in_process(file, options)),
            find_mesh_content(read_mesh(file, options)));
}

TEST(MeshContent, IsThatOfTheSavedMesh) {
  const auto geo =
      write_file("box.geo", kBox +
                                "Physical Volume(\"body\") = {1};\n"
                                "Physical Surface(\"root\") = {1};\n"
                                "Mesh.MeshSizeMax = 0.1;\n"
                                "Mesh.ElementOrder = 2;\n");
  const auto msh = testing::convert(geo, "box.msh", {.binary = true});
  EXPECT_EQ(find_mesh_content(read_mesh(geo)),
            find_mesh_content(read_mesh(msh)));
}

}  // namespace
}  // namespace limber::fem::mesh_formats_test
