// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/mesh_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "limber/fem/gmsh/gmsh_session.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::mesh_reader_test {
namespace {

using testing::BoxKind;
using testing::kBoxCorner;
using testing::kBoxSize;
using testing::write_file;

/// Text of 16 digits holds a double except for its last bit.
constexpr double kPrinted = 1e-13;
constexpr double kRoundoff = 1e-12;

const ElasticMaterial kSteel{210e9, 0.3, 7850.0};

double relative_difference(const SparseMatrix& a, const SparseMatrix& b) {
  EXPECT_EQ(a.nonZeros(), b.nonZeros());
  return SparseMatrix(a - b).norm() / b.norm();
}

double mass_of(const Mesh& mesh) {
  const std::vector<ElasticMaterial> steel(mesh.volume_groups.size(), kSteel);
  return calc_mass_properties(assemble(mesh, steel).M_s, mesh.x).mass;
}

TEST(MeshReader, EveryMshFormGivesTheSameMatrices) {
  const auto geo = write_file("box.geo", testing::box_geo(BoxKind::prisms));
  const auto source = testing::convert(geo, "source.msh", {.order = 2});
  const StructuralMatrices expected = assemble(read_mesh(source), {kSteel});
  for (const double version : {2.2, 4.1})
    for (const bool is_binary : {false, true}) {
      SCOPED_TRACE(fmt::format("{} {}", version, is_binary));
      const auto file = testing::convert(
          source, "form.msh", {.version = version, .binary = is_binary});
      std::string line;
      std::ifstream in(file);
      std::getline(in, line);
      std::getline(in, line);
      EXPECT_EQ(line, fmt::format("{} {} 8", version, is_binary ? 1 : 0));
      const Mesh mesh = read_mesh(file);
      EXPECT_EQ(mesh.groups.size(), 4U);
      const StructuralMatrices found = assemble(mesh, {kSteel});
      EXPECT_LT(relative_difference(found.M_s, expected.M_s), kPrinted);
      EXPECT_LT(relative_difference(found.K, expected.K), kPrinted);
    }
}

/// Writes a STEP file of a box at the origin.
std::filesystem::path write_step(const std::string& name, const Vector3& size) {
  const auto file = testing::make_test_folder() / name;
  const GmshSession session;
  gmsh::model::occ::addBox(0, 0, 0, size[0], size[1], size[2]);
  gmsh::model::occ::synchronize();
  gmsh::write(file.string());
  return file;
}

TEST(MeshReader, MeshesAStepFile) {
  for (const char* name : {"box.step", "box.stp"}) {
    const Mesh mesh = read_mesh(write_step(name, 1000.0 * kBoxSize),
                                {.size = 60.0, .order = 2});  // millimetres
    EXPECT_GT(mesh.element_count(), 50U);
    EXPECT_NEAR(mass_of(mesh) / (kSteel.density * kBoxSize.prod()), 1.0,
                kRoundoff);
  }
}

TEST(MeshReader, TakesLengthsInTheUnitGiven) {
  const auto file = write_step("box.step", 1000.0 * kBoxSize);
  const Mesh mesh = read_mesh(file, {.size = 60.0, .unit = 1e-3});
  // STEP keeps a tolerance of its own, 1e-7 of its unit.
  EXPECT_LT((mesh.size() - kBoxSize).norm(), 1e-9);
}

TEST(MeshReader, MeshesGeometryBySizeAndOrder) {
  const auto geo = write_file(
      "box.geo",
      "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.3, 0.2, 0.1};\n");
  std::size_t coarser = 0;
  for (const double size : {0.2, 0.1, 0.05}) {
    const Mesh mesh = read_mesh(geo, {.size = size});
    EXPECT_GT(mesh.element_count(), 2 * coarser);
    coarser = mesh.element_count();
  }
  EXPECT_EQ(read_mesh(geo).blocks[0].element->order, 2);  // when none is said
  for (const int order : {1, 2, 3})
    EXPECT_EQ(
        read_mesh(geo, {.size = 0.1, .order = order}).blocks[0].element->order,
        order);
}

TEST(MeshReader, OrderInTheFileHoldsUnlessAnotherIsGiven) {
  const auto geo = write_file("box.geo", testing::box_geo(BoxKind::tetrahedra) +
                                             "Mesh.ElementOrder = 3;\n");
  EXPECT_EQ(read_mesh(geo).blocks[0].element->order, 3);
  EXPECT_EQ(read_mesh(geo, {.order = 1}).blocks[0].element->order, 1);
}

TEST(MeshReader, OfAGeometryOnlyGroupedVolumesAreTaken) {
  const std::string boxes =
      "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n"
      "Box(2) = {1, 0, 0, 2, 1, 1};\nCoherence;\n";
  const auto volume = [&](const std::string& name, const std::string& text) {
    return mass_of(read_mesh(write_file(name, text), {.size = 1.0})) /
           kSteel.density;
  };
  EXPECT_NEAR(volume("one.geo", boxes + "Physical Volume(\"arm\") = {1};\n"),
              1.0, kRoundoff);
  EXPECT_NEAR(
      volume("both.geo", boxes + "Physical Volume(\"arm\") = {1, 2};\n"), 3.0,
      kRoundoff);
}

class BoxGroups : public ::testing::TestWithParam<BoxKind> {
 protected:
  BoxGroups()
      : mesh_(read_mesh(write_file("box.geo", testing::box_geo(GetParam())))) {}
  const PhysicalGroup& group(const std::string& name) const {
    return mesh_.groups[find_group(mesh_, name)];
  }
  Mesh mesh_;
};

TEST_P(BoxGroups, HoldTheNodesOfTheirFaces) {
  const double roundoff = 1e-12;
  for (const auto& [name, height] :
       {std::pair{"root", 0.0}, std::pair{"tip", kBoxSize[2]}}) {
    EXPECT_EQ(group(name).dimension, 2);
    std::vector<int> expected;
    for (int n = 0; n < static_cast<int>(mesh_.node_count()); ++n)
      if (std::abs(mesh_.x(2, n) - kBoxCorner[2] - height) < roundoff)
        expected.push_back(n);
    EXPECT_EQ(group(name).nodes, expected);
  }
  EXPECT_EQ(group("body").dimension, 3);
  EXPECT_EQ(group("body").nodes.size(), mesh_.node_count());
  const PhysicalGroup& corner = group("corner");
  EXPECT_EQ(corner.dimension, 0);
  ASSERT_EQ(corner.nodes.size(), 1U);
  EXPECT_EQ(Vector3(mesh_.x.col(corner.nodes[0])), kBoxCorner);
}

INSTANTIATE_TEST_SUITE_P(Kinds, BoxGroups,
                         ::testing::Values(BoxKind::tetrahedra,
                                           BoxKind::hexahedra,
                                           BoxKind::prisms));

TEST(MeshReader, GroupWithoutANameIsCalledByItsNumber) {
  testing::MshText text;
  for (const Vector3& x :
       {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)})
    text.add_node(x);
  text.add_element(testing::MshText::kTetrahedron, {1, 2, 3, 4}, 12);
  const Mesh mesh = read_mesh(write_file("plain.msh", text.str()));
  EXPECT_EQ(find_group(mesh, "12"), 0U);
}

TEST(MeshReader, NodesOfNoSolidElementAreDropped) {
  testing::MshText text = testing::unit_tetrahedron();
  text.add_node({9, 9, 9});
  const Mesh mesh = read_mesh(write_file("loose.msh", text.str()));
  EXPECT_EQ(mesh.node_count(), 4U);
  EXPECT_EQ(mesh.tags, (std::vector<std::size_t>{1, 2, 3, 4}));
}

}  // namespace
}  // namespace limber::fem::mesh_reader_test
