// SPDX-License-Identifier: BSD-3-Clause
// Input files of Abaqus and CalculiX as meshes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/fem/abaqus/solid_deck_reader.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::solid_deck_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using testing::write_file;

/// An element, its corners, the corners between which each further node lies,
/// and a point and a normal of the plane of each face S1, S2, ... (CalculiX
/// 2.20 User's Manual, ch. 6.2 and *SURFACE; numbers from 1).
struct Shape {
  std::string linear;
  std::string quadratic;
  std::vector<Vector3> corners;
  std::vector<std::pair<int, int>> edges;
  double volume;
  std::vector<std::pair<Vector3, Vector3>> faces;
};

const Vector3 kX = Vector3::UnitX();
const Vector3 kY = Vector3::UnitY();
const Vector3 kZ = Vector3::UnitZ();
const Vector3 kO = Vector3::Zero();

const Shape kTetra{"C3D4",
                   "C3D10",
                   {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}},
                   {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}},
                   1.0,
                   {{kO, kZ}, {kO, kY}, {{3, 0, 0}, {2, 3, 6}}, {kO, kX}}};
const Shape kHexa{"C3D8",
                  "C3D20",
                  {{0, 0, 0},
                   {3, 0, 0},
                   {3, 2, 0},
                   {0, 2, 0},
                   {0, 0, 1},
                   {3, 0, 1},
                   {3, 2, 1},
                   {0, 2, 1}},
                  {{1, 2},
                   {2, 3},
                   {3, 4},
                   {4, 1},
                   {5, 6},
                   {6, 7},
                   {7, 8},
                   {8, 5},
                   {1, 5},
                   {2, 6},
                   {3, 7},
                   {4, 8}},
                  6.0,
                  {{kO, kZ},
                   {{0, 0, 1}, kZ},
                   {kO, kY},
                   {{3, 0, 0}, kX},
                   {{0, 2, 0}, kY},
                   {kO, kX}}};
const Shape kWedge{
    "C3D6",
    "C3D15",
    {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}, {3, 0, 1}, {0, 2, 1}},
    {{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}, {1, 4}, {2, 5}, {3, 6}},
    3.0,
    {{kO, kZ}, {{0, 0, 1}, kZ}, {kO, kY}, {{3, 0, 0}, {2, 3, 0}}, {kO, kX}}};

/// @param set of all elements
std::string element_deck(const Shape& shape, bool is_quadratic) {
  std::vector<Vector3> nodes = shape.corners;
  if (is_quadratic)
    for (const auto& [a, b] : shape.edges)
      nodes.emplace_back(0.5 *
                         (shape.corners[static_cast<std::size_t>(a - 1)] +
                          shape.corners[static_cast<std::size_t>(b - 1)]));
  std::string text = "** one element\n*Node, nset=Nall\n";
  std::string element = "7";
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    text += fmt::format("{}, {}, {}, {}\n", i + 1, nodes[i][0], nodes[i][1],
                        nodes[i][2]);
    element += fmt::format(",{}{}", i == 12 ? "\n " : " ", i + 1);
  }
  text += fmt::format("*Element, type={}, elset=Eall\n{}\n",
                      is_quadratic ? shape.quadratic : shape.linear, element);
  for (std::size_t i = 1; i <= shape.faces.size(); ++i)
    text +=
        fmt::format("*Surface, name=Side{0}, type=element\nEall, S{0}\n", i);
  return text;
}

class DeckElementOf : public ::testing::TestWithParam<Shape> {};

TEST_P(DeckElementOf, HasItsNodesWhereTheReferenceElementHasThem) {
  for (const bool is_quadratic : {false, true}) {
    const Mesh mesh = read_mesh(
        write_file("one.inp", element_deck(GetParam(), is_quadratic)));
    const ElementBlock& block = mesh.blocks.at(0);
    EXPECT_EQ(block.element->order, is_quadratic ? 2 : 1);
    EXPECT_TRUE(
        is_parallel_sided(*block.element, element_positions(mesh, block, 0)));
    const std::vector<ElasticMaterial> each(1, {1e9, 0.3, 1.0});
    EXPECT_NEAR(calc_mass_properties(assemble(mesh, each).M_s, mesh.x).mass,
                GetParam().volume, 1e-12);
  }
}

TEST_P(DeckElementOf, HasItsFacesWhereTheManualNumbersThem) {
  for (const bool is_quadratic : {false, true}) {
    const Mesh mesh = read_mesh(
        write_file("one.inp", element_deck(GetParam(), is_quadratic)));
    for (std::size_t i = 0; i < GetParam().faces.size(); ++i) {
      const auto& [point, normal] = GetParam().faces[i];
      const PhysicalGroup& side =
          mesh.groups.at(find_group(mesh, fmt::format("Side{}", i + 1)));
      EXPECT_EQ(side.dimension, 2);
      ASSERT_EQ(side.blocks.size(), 1U);
      EXPECT_EQ(side.blocks[0].size(), 1U);
      std::vector<int> on_plane;
      for (int n = 0; n < mesh.x.cols(); ++n)
        if (std::abs(normal.dot(mesh.x.col(n) - point)) < 1e-12)
          on_plane.push_back(n);
      EXPECT_EQ(side.nodes, on_plane) << i + 1;
      // Around the face: each middle is between the corners beside it.
      const int* nodes = side.blocks[0].element_nodes(0);
      const int corners = is_quadratic ? side.blocks[0].element->node_count / 2
                                       : side.blocks[0].element->node_count;
      for (int k = 0; is_quadratic && k < corners; ++k) {
        const Vector3 middle =
            0.5 * (mesh.x.col(nodes[k]) + mesh.x.col(nodes[(k + 1) % corners]));
        EXPECT_LT((mesh.x.col(nodes[corners + k]) - middle).norm(), 1e-12);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, DeckElementOf,
                         ::testing::Values(kTetra, kHexa, kWedge),
                         [](const auto& shape) { return shape.param.linear; });

/// Gmsh writes input files by its own tables of the order of nodes.
TEST(SolidDeck, IsTheMeshThatGmshWrote) {
  using testing::BoxKind;
  for (const BoxKind kind :
       {BoxKind::tetrahedra, BoxKind::hexahedra, BoxKind::prisms}) {
    const auto geo = write_file("box.geo", testing::box_geo(kind));
    for (const int order : {1, 2}) {
      const testing::MshForm form{.order = order, .serendipity = true};
      const Mesh mesh = read_mesh(testing::convert(geo, "box.inp", form));
      const Mesh known = read_mesh(testing::convert(geo, "box.msh", form));
      ASSERT_EQ(mesh.tags, known.tags);
      EXPECT_LT((mesh.x - known.x).norm(), 1e-12);
      EXPECT_EQ(mesh.blocks.at(0).nodes, known.blocks.at(0).nodes);
    }
  }
}

constexpr const char* kTwo =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 0, 0, -1\n"
    "*ELEMENT, TYPE=C3D4\n10, 1, 2, 3, 4\n20, 1, 3, 2, 5\n";

TEST(SolidDeck, HasItsSetsAsGroups) {
  const Mesh mesh = read_mesh(write_file(
      "two.inp", std::string(kTwo) +
                     "*ELSET, ELSET=Upper\n10\n*Elset, elset=All, generate\n"
                     "10, 20, 10\n*ELSET, ELSET=Again\nUPPER\n"
                     "*NSET, NSET=Base, GENERATE\n1, 3\n"
                     "*NSET, NSET=Lower, ELSET=all\n*NSET,NSET=tip\nBASE, 5,\n"
                     "*SURFACE, NAME=Faces\nUpper, S2\n20, S2\n"));
  EXPECT_THAT(mesh.volume_groups,
              ElementsAre(UnorderedElementsAre("Upper", "All", "Again"),
                          ElementsAre("All")));
  const auto nodes_of = [&mesh](const char* name) {
    return mesh.groups.at(find_group(mesh, name)).nodes;
  };
  EXPECT_THAT(nodes_of("Upper"), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(nodes_of("Again"), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(nodes_of("Base"), ElementsAre(0, 1, 2));
  EXPECT_THAT(nodes_of("Lower"), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(nodes_of("tip"), ElementsAre(0, 1, 2, 4));
  EXPECT_THAT(nodes_of("Faces"), ElementsAre(0, 1, 2, 3, 4));
}

TEST(SolidDeck, IsReadWithItsIncludesAndOneInstance) {
  write_file("nodes.txt", "1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n");
  write_file("more.inp", "*NODE\n4, 0., 0., 1.\n** done\n");
  const SolidDeck deck = read_solid_deck(write_file(
      "parts.inp",
      "*Heading\n bar\n*Part, name=P\n*Node, input=nodes.txt\n"
      "*Include, input=more.inp\n*Element, type=C3D4\n1, 1, 2,\n 3, 4\n"
      "*End Part\n*Assembly, name=A\n*Instance, name=I, part=P\n"
      "*End Instance\n*End Assembly\n*Step\n*Static\n1., 1.\n*End Step\n"));
  EXPECT_THAT(deck.nodes, ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(deck.solids.at(4).nodes, ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(deck.notices, IsEmpty());
}

std::string find_error(const std::string& more, const std::string& base) {
  try {
    static_cast<void>(read_solid_deck(write_file("bad.inp", base + more)));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SolidDeck, RefusesWhatABodyOfSolidsWouldLose) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"*ELEMENT, TYPE=MASS, ELSET=M\n5, 2\n", "elements MASS"},
      {"*ELEMENT, TYPE=SPRINGA\n5, 2, 3\n", "elements SPRINGA"},
      {"*ELEMENT, TYPE=S3, ELSET=S\n5, 1, 2, 3\n*SHELL SECTION, ELSET=S\n1\n",
       "elements S3"},
      {"*ELEMENT, TYPE=B31, ELSET=B\n5, 1, 2\n*BEAM SECTION, ELSET=B\n1\n",
       "elements B31"},
      {"*ELEMENT, TYPE=C3D27\n5, 1, 2, 3, 4\n", "elements C3D27"},
      {"*ELEMENT, TYPE=C3D8P\n5, 1, 2, 3, 4\n", "elements C3D8P"},
      {"*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n", "*EQUATION"},
      {"*RIGID BODY, NSET=R, REF NODE=1\n", "*RIGID BODY"},
      {"*TIE, NAME=T\nA, B\n", "*TIE"},
      {"*CONTACT PAIR, INTERACTION=I\nA, B\n", "*CONTACT PAIR"},
  };
  for (const auto& [more, what] : cases) {
    const std::string error = find_error(more, kTwo);
    EXPECT_THAT(error, HasSubstr(what));
    EXPECT_THAT(error, HasSubstr("would be lost"));
    EXPECT_THAT(error, HasSubstr("bad.inp:"));
  }
}

TEST(SolidDeck, RefusesWhatIsWrongWithItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"*NODE\n1, 0, 0, 0\n", "bad.inp:11: node 1 is there twice"},
      {"*NODE\n6, 0, x, 0\n", "bad.inp:11: 'x' is no finite number"},
      {"*NODE\nsix, 0, 0, 0\n", "bad.inp:11: 'six' is no node"},
      {"*ELEMENT, TYPE=C3D4\n10, 1, 2, 3, 4\n", "element 10 is there twice"},
      {"*ELEMENT, TYPE=C3D4\n30, 1, 2, 3\n", "C3D4 30 has 3 nodes. Expected 4"},
      {"*ELEMENT, TYPE=C3D4\n30, 1, 2, 3, 3\n", "has a node twice"},
      {"*ELEMENT, TYPE=C3D4\n30, 1, 2, 3, 9\n", "node 9, which is missing"},
      {"*ELEMENT, TYPE=C3D4\n30, 1, 2, 3,\n", "the last element is not"},
      {"*ELEMENT, TYPE=C3D4\n30, 1, 2, 3,\n*STEP\n", "is not complete"},
      {"*NGEN\n1, 5, 1\n", "*NGEN makes or moves nodes"},
      {"*NODE, SYSTEM=C\n9, 1, 0, 0\n", "*NODE makes or moves nodes"},
      {"*ELSET, ELSET=A\nB\n", "names the set B"},
      {"*NSET, NSET=A, GENERATE\n5, 1\n", "GENERATE gives no set"},
      {"*SURFACE, NAME=A\n10, S5\n", "has no face S5. Expected S1 to S4"},
      {"*SURFACE, NAME=A\nNone, S1\n", "missing or empty"},
      {"*INSTANCE, NAME=I, PART=P\n", "the part P, which is missing"},
      {"*PART, NAME=P\n", "ends within *PART"},
      {"*PART, NAME=P\n*PART, NAME=Q\n", "*PART within a *PART"},
      {"*END PART\n", "*END PART without"},
      {"*PART, NAME=P\n*END PART\n*INSTANCE, NAME=I, PART=P\n",
       "ends within *INSTANCE"},
      {"*PART, NAME=P\n*END PART\n*INSTANCE, NAME=I, PART=P\n0, 0, 1, 2\n",
       "a line too many or too long"},
      {"*MATERIAL, NAME=M\n*MATERIAL, NAME=M\n", "material M is there twice"},
      {"*MATERIAL, NAME=M\n*ELASTIC\n1., x\n", "bad.inp:12: 'x' is no"},
      {"*ELSET, ELSET=A\n10\n*ELSET, ELSET=B\n10\n*SOLID SECTION, ELSET=A, "
       "MATERIAL=M\n*SOLID SECTION, ELSET=B, MATERIAL=M\n",
       "element 10 has two sections, of the sets A and B"},
      {"*INCLUDE, INPUT=none.inp\n", "none.inp"},
      {"*INCLUDE, INPUT=bad.inp\n", "none that includes itself"},
  };
  for (const auto& [more, what] : cases)
    EXPECT_THAT(find_error(more, kTwo), HasSubstr(what)) << more;
  EXPECT_THAT(
      testing::find_read_error(write_file("none.inp", "*NODE\n1, 0, 0, 0\n")),
      HasSubstr("no solid elements"));
  EXPECT_THAT(
      testing::find_read_error(write_file("geo.inp", "Point(1) = {0, 0, 0};")),
      HasSubstr("but its content does not"));
}

TEST(SolidDeck, ReportsWhatItLeavesOut) {
  const SolidDeck deck = read_solid_deck(write_file(
      "more.inp",
      std::string(kTwo) +
          "*NODE\n9, 5, 5, 5\n*ELEMENT, TYPE=T3D2, ELSET=L\n40, 1, 2\n"
          "*ELEMENT, TYPE=CPS3, ELSET=Base\n50, 1, 2, 3\n"
          "*ELSET, ELSET=A\n10\n*ELSET, ELSET=B\n20\n"
          "*MATERIAL, NAME=M\n*PLASTIC\n1., 0.\n*BOUNDARY\n1, 1, "
          "3\n*STEP\n*CLOAD\n2, 1, 1.\n*END STEP\n"));
  const std::string all = fmt::format("{}", fmt::join(deck.notices, "\n"));
  EXPECT_THAT(all, HasSubstr("1 of 6 nodes belong to no solid"));
  EXPECT_THAT(all, HasSubstr("1 elements T3D2"));
  EXPECT_THAT(all, HasSubstr("1 *BOUNDARY"));
  EXPECT_THAT(all, HasSubstr("1 *CLOAD"));
  EXPECT_THAT(all, HasSubstr("linear elastic: 1 *PLASTIC"));
  ASSERT_EQ(deck.groups.size(), 2U);
  EXPECT_EQ(deck.groups[0].name, "Base");  // a plane element without section
  EXPECT_EQ(deck.groups[1].name, "boundary");
}

/// Two solids, in sets A and B.
SolidDeck read_materials(const std::string& text) {
  return read_solid_deck(write_file(
      "materials.inp",
      std::string(kTwo) + "*ELSET, ELSET=A\n10\n*ELSET, ELSET=B\n20\n" + text));
}

TEST(SolidDeck, HasTheMaterialsOfItsSections) {
  const SolidDeck deck = read_materials(
      "*MATERIAL, NAME=Steel\n*ELASTIC\n210e9, 0.3\n*DENSITY\n7850.\n"
      "*MATERIAL, NAME=CFRP\n*DENSITY\n1600., 20.\n"
      "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
      "140e9, 10e9, 12e9, 0.3, 0.25, 0.4, 5e9, 4e9\n3.4e9, 20.\n"
      "*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL\n0, 0, 0, 0, 0, 2\n"
      "*SOLID SECTION, ELSET=A, MATERIAL=Steel\n"
      "*SOLID SECTION, ELSET=B, MATERIAL=CFRP, ORIENTATION=O\n");
  ASSERT_EQ(deck.materials.size(), 2U);
  EXPECT_EQ(deck.materials[0].name, "material Steel");
  EXPECT_EQ(deck.materials[0].material.youngs_modulus, 210e9);
  EXPECT_EQ(deck.materials[0].material.density, 7850.0);
  const RegionMaterial& other = deck.materials[1];
  EXPECT_EQ(other.problem, "");
  EXPECT_EQ(other.material.density, 1600.0);
  ASSERT_TRUE(other.material.anisotropy);
  EXPECT_EQ(other.material.anisotropy->C(3, 3), 5e9);
  EXPECT_EQ(other.material.anisotropy->C(4, 4), 3.4e9);
  EXPECT_TRUE(other.material.anisotropy->axes.is_cylindrical);
  EXPECT_THAT(deck.notices, IsEmpty());
}

TEST(SolidDeck, SaysWhyAMaterialCannotBeUsed) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"*MATERIAL, NAME=M\n*ELASTIC\n210e9, 0.3\n", "expected one *DENSITY"},
      {"*MATERIAL, NAME=M\n*HYPERELASTIC\n1, 2\n*DENSITY\n1.\n",
       "*HYPERELASTIC is not read"},
      {"*MATERIAL, NAME=M\n*ELASTIC\n1, .3, 0\n2, .3, 9\n*DENSITY\n1.\n",
       "*ELASTIC has 6 numbers. Expected 2"},
      {"*MATERIAL, NAME=M\n*ELASTIC, TYPE=LAMINA\n1, 2\n*DENSITY\n1.\n",
       "TYPE=LAMINA is not read"},
      {"*MATERIAL, NAME=M\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
       "1., 1., 1., .6, .6, .6, 1., 1.\n1.\n*DENSITY\n1.\n",
       "a positive strain energy needs > 0"},
      {"", "material M of "},
  };
  for (const auto& [text, what] : cases) {
    const SolidDeck deck =
        read_materials(text + "*SOLID SECTION, ELSET=A, MATERIAL=M\n");
    EXPECT_THAT(deck.materials.at(0).problem, HasSubstr(what));
    EXPECT_THAT(deck.materials.at(0).problem, HasSubstr("materials.inp:"));
    EXPECT_EQ(deck.materials.at(1).name, "");
  }
}

TEST(SolidDeck, AnInstanceMovesItsPartAndItsAxes) {
  const SolidDeck deck = read_solid_deck(write_file(
      "moved.inp",
      "*PART, NAME=P\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
      "*ELEMENT, TYPE=C3D4, ELSET=All\n1, 1, 2, 3, 4\n"
      "*ORIENTATION, NAME=O\n1, 0, 0, 0, 1, 0\n"
      "*SOLID SECTION, ELSET=All, MATERIAL=M, ORIENTATION=O\n*END PART\n"
      "*PART, NAME=Other\n*NODE\n1, 5, 5, 5\n*END PART\n"
      "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n10, 0, 0\n"
      "0, 0, 0, 0, 0, 1, 90\n*END INSTANCE\n"
      "*NSET, NSET=Root, INSTANCE=P-1\n1, 2\n"
      "*ELSET, ELSET=Body\nP-1.All\n*END ASSEMBLY\n"
      "*MATERIAL, NAME=M\n*ELASTIC, TYPE=ORTHO\n4, 1, 3, 1, 1, 3, 1, 1,\n1\n"
      "*DENSITY\n1.\n"));
  // First the translation, then the rotation.
  ASSERT_EQ(deck.x.cols(), 4);
  EXPECT_LT((deck.x.col(0) - Vector3(0.0, 10.0, 0.0)).norm(), 1e-14);
  EXPECT_LT((deck.x.col(1) - Vector3(0.0, 11.0, 0.0)).norm(), 1e-14);
  EXPECT_LT((deck.x.col(2) - Vector3(-1.0, 10.0, 0.0)).norm(), 1e-14);
  ASSERT_EQ(deck.materials.at(0).problem, "");
  const MaterialAxes& axes = deck.materials[0].material.anisotropy->axes;
  EXPECT_LT((axes.directions.col(0) - Vector3::UnitY()).norm(), 1e-15);
  EXPECT_LT((axes.directions.col(1) + Vector3::UnitX()).norm(), 1e-15);
  EXPECT_THAT(deck.region_groups.at(0), ElementsAre("All", "Body"));
}

TEST(SolidDeck, InstancesHaveTheirOwnNodesSetsAndAxes) {
  const SolidDeck deck = read_solid_deck(write_file(
      "several.inp",
      "*PART, NAME=P\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
      "*ELEMENT, TYPE=C3D4, ELSET=All\n1, 1, 2, 3, 4\n"
      "*SURFACE, NAME=Foot\nAll, S1\n*NSET, NSET=Tip\n4\n"
      "*ORIENTATION, NAME=O\n1, 0, 0, 0, 1, 0\n"
      "*SOLID SECTION, ELSET=All, MATERIAL=M, ORIENTATION=O\n*END PART\n"
      "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Left, PART=P\n*END INSTANCE\n"
      "*INSTANCE, NAME=Right, PART=P\n5, 0, 0\n5, 0, 0, 5, 0, 1, 90\n"
      "*END INSTANCE\n*NSET, NSET=Tips\nLeft.Tip, Right.4\n*END ASSEMBLY\n"
      "*MATERIAL, NAME=M\n*ELASTIC, TYPE=ORTHO\n4, 1, 3, 1, 1, 3, 1, 1,\n1\n"
      "*DENSITY\n1.\n"));
  EXPECT_THAT(deck.nodes, ElementsAre(1, 2, 3, 4, 11, 12, 13, 14));
  EXPECT_LT((deck.x.col(5) - Vector3(5.0, 1.0, 0.0)).norm(), 1e-14);
  EXPECT_THAT(deck.solids.at(4).elements, ElementsAre(1, 11));
  EXPECT_THAT(deck.region_groups,
              ElementsAre(ElementsAre("Left.All"), ElementsAre("Right.All")));
  const auto directions = [&](std::size_t region) {
    return deck.materials.at(region).material.anisotropy->axes.directions;
  };
  EXPECT_LT((directions(0).col(0) - kX).norm(), 1e-15);
  EXPECT_LT((directions(1).col(0) - kY).norm(), 1e-15);
  std::vector<std::string> names;
  for (const DeckGroup& group : deck.groups) names.push_back(group.name);
  EXPECT_THAT(names, UnorderedElementsAre("Left.Foot", "Right.Foot", "Left.Tip",
                                          "Right.Tip", "Tips"));
  const auto tips =
      std::ranges::find(deck.groups, std::string("Tips"), &DeckGroup::name);
  EXPECT_THAT(tips->elements.at(15).nodes, ElementsAre(4, 14));
}

TEST(SolidDeck, LeavesOutWhatItIsAskedTo) {
  const std::string text =
      std::string(kTwo) +
      "*ELEMENT, TYPE=MASS, ELSET=M\n5, 2\n*RIGID BODY, NSET=R, REF NODE=1\n";
  EXPECT_THAT(find_error("", text), HasSubstr("ignore MASS to go on without"));
  const SolidDeck deck =
      read_solid_deck(write_file("ignored.inp", text), {"mass", "Rigid Body"});
  const std::string all = fmt::format("{}", fmt::join(deck.notices, "\n"));
  EXPECT_THAT(all, HasSubstr("left out as you ask, so that the body lacks "
                             "them: 1 *RIGID BODY"));
  EXPECT_THAT(all, HasSubstr("1 elements MASS"));
}

TEST(SolidDeck, ReportsAnotherIntegrationAndNamesOfSeveralSets) {
  const SolidDeck deck =
      read_solid_deck(write_file("names.inp",
                                 "*NODE, NSET=Bar\n1,0,0,0\n2,1,0,0\n3,0,1,0\n"
                                 "4,0,0,1\n*ELEMENT, TYPE=C3D4H, ELSET=Bar\n"
                                 "1,1,2,3,4\n"));
  const std::string all = fmt::format("{}", fmt::join(deck.notices, "\n"));
  EXPECT_THAT(all, HasSubstr("C3D4H as C3D4"));
  EXPECT_THAT(all, HasSubstr("that of nodes is called Bar.nodes here"));
  EXPECT_EQ(deck.groups.at(0).name, "Bar.nodes");
}

}  // namespace
}  // namespace limber::fem::solid_deck_test
