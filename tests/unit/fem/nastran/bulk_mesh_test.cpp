// SPDX-License-Identifier: BSD-3-Clause
// Decks as meshes: order of nodes, groups, and what Gmsh writes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::bulk_mesh_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::write_file;

double volume_of(const Mesh& mesh) {
  const std::vector<ElasticMaterial> each(mesh.volume_groups.size(),
                                          {1e9, 0.3, 1.0});
  return calc_mass_properties(assemble(mesh, each).M_s, mesh.x).mass;
}

/// An element's card, its corners, and the corners between which each mid-side
/// node lies (MSC Nastran Quick Reference Guide, figures of CTETRA, CHEXA,
/// CPENTA, CPYRAM; numbers from 1).
struct Shape {
  std::string card;
  std::vector<Vector3> corners;
  std::vector<std::pair<int, int>> edges;
  double volume;
};

const Shape kTetra{"CTETRA",
                   {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}},
                   {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}},
                   1.0};
const Shape kHexa{"CHEXA",
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
                   {1, 5},
                   {2, 6},
                   {3, 7},
                   {4, 8},
                   {5, 6},
                   {6, 7},
                   {7, 8},
                   {8, 5}},
                  6.0};
const Shape kPenta{
    "CPENTA",
    {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}, {3, 0, 1}, {0, 2, 1}},
    {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 5}, {3, 6}, {4, 5}, {5, 6}, {6, 4}},
    3.0};
const Shape kPyram{
    "CPYRAM",
    {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}, {1.5, 1, 2}},
    {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 5}, {3, 5}, {4, 5}},
    4.0};

std::string element_deck(const Shape& shape, bool is_quadratic) {
  std::vector<Vector3> nodes = shape.corners;
  if (is_quadratic)
    for (const auto& [a, b] : shape.edges)
      nodes.emplace_back(0.5 *
                         (shape.corners[static_cast<std::size_t>(a - 1)] +
                          shape.corners[static_cast<std::size_t>(b - 1)]));
  std::string text = "BEGIN BULK\n";
  std::vector<std::string> fields = {"1", "1"};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    text += fmt::format("GRID,{},,{},{},{}\n", i + 1, nodes[i][0], nodes[i][1],
                        nodes[i][2]);
    fields.push_back(std::to_string(i + 1));
  }
  text += shape.card;
  for (std::size_t i = 0; i < fields.size(); ++i)
    text += (i > 0 && i % 8 == 0 ? "\n," : ",") + fields[i];
  return text + "\nENDDATA\n";
}

class BulkElement : public ::testing::TestWithParam<Shape> {};

TEST_P(BulkElement, HasItsNodesWhereTheReferenceElementHasThem) {
  for (const bool is_quadratic : {false, true}) {
    const Mesh mesh = read_mesh(
        write_file("one.bdf", element_deck(GetParam(), is_quadratic)));
    const ElementBlock& block = mesh.blocks.at(0);
    EXPECT_EQ(block.element->order, is_quadratic ? 2 : 1);
    EXPECT_TRUE(
        is_parallel_sided(*block.element, element_positions(mesh, block, 0)));
    EXPECT_NEAR(volume_of(mesh), GetParam().volume, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, BulkElement,
                         ::testing::Values(kTetra, kHexa, kPenta, kPyram),
                         [](const auto& shape) { return shape.param.card; });

/// Gmsh writes decks by its own tables of the order of nodes.
TEST(BulkMesh, IsTheOneThatGmshWroteInAnyFields) {
  using testing::BoxKind;
  for (const BoxKind kind :
       {BoxKind::tetrahedra, BoxKind::hexahedra, BoxKind::prisms}) {
    const auto geo = write_file("box.geo", testing::box_geo(kind));
    for (const int order : {1, 2}) {
      for (const int fields : {0, 1, 2}) {
        const testing::MshForm form{
            .order = order, .serendipity = true, .bulk_fields = fields};
        const Mesh mesh = read_mesh(testing::convert(geo, "box.bdf", form));
        const Mesh known = read_mesh(testing::convert(geo, "box.msh", form));
        EXPECT_EQ(mesh.node_count(), known.node_count());
        EXPECT_EQ(mesh.blocks.at(0).element->name,
                  known.blocks.at(0).element->name);
        EXPECT_NEAR(volume_of(mesh), volume_of(known), 1e-8);  // 8 digits
      }
    }
  }
}

TEST(BulkMesh, HasAGroupForEachProperty) {
  const Mesh mesh = read_mesh(write_file(
      "two.dat",
      "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n"
      "GRID,4,,0.,0.,1.\nGRID,5,,0.,0.,-1.\nCTETRA,8,30,1,2,3,4\n"
      "CTETRA,9,4,1,3,2,5\nENDDATA\n"));
  EXPECT_THAT(mesh.volume_groups,
              ElementsAre(ElementsAre("4"), ElementsAre("30")));
  EXPECT_THAT(mesh.blocks.at(0).tags, ElementsAre(9, 8));
  EXPECT_THAT(mesh.blocks.at(0).regions, ElementsAre(0, 1));
  const PhysicalGroup& last = mesh.groups.at(find_group(mesh, "30"));
  EXPECT_THAT(last.nodes, ElementsAre(0, 1, 2, 3));
}

TEST(BulkMesh, ReportsUnusedGridsAsANotice) {
  const TracedMesh traced = read_traced_mesh(write_file(
      "extra.bdf",
      "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n"
      "GRID,4,,0.,0.,1.\nGRID,7,,5.,0.,0.\nCTETRA,8,30,1,2,3,4\nENDDATA\n"));
  ASSERT_EQ(traced.notices.size(), 1U);
  EXPECT_THAT(traced.notices[0], HasSubstr("1 of 5 GRIDs"));
}

/// Two tetrahedra on a face; the second lacks the nodes of an edge that both
/// have, and of one of its own.
TEST(BulkMesh, FillsBlankMidSideNodes) {
  const std::string text =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n"
      "GRID,4,,0.,0.,1.\nGRID,5,,0.,0.,-1.\nGRID,11,,.5,0.,0.\n"
      "GRID,12,,.5,.5,0.\nGRID,13,,0.,.5,0.\nGRID,14,,0.,0.,.5\n"
      "GRID,15,,.5,0.,.5\nGRID,16,,0.,.5,.5\nGRID,24,,0.,0.,-.5\n"
      "GRID,26,,.5,0.,-.5\nCTETRA,1,1,1,2,3,4,11,12\n,13,14,15,16\n"
      "CTETRA,2,1,1,3,2,5,13,12\n,,24,,26\n";
  const TracedMesh traced = read_traced_mesh(write_file("blank.bdf", text));
  ASSERT_EQ(traced.mesh.blocks.size(), 1U);
  const ElementBlock& block = traced.mesh.blocks[0];
  EXPECT_EQ(block.element->order, 2);
  EXPECT_EQ(traced.mesh.node_count(), 14U);
  const auto tags_of = [&](std::size_t e) {
    std::set<std::size_t> tags;
    for (int i = 0; i < 10; ++i)
      tags.insert(
          traced.mesh
              .tags[static_cast<std::size_t>(block.element_nodes(e)[i])]);
    return tags;
  };
  EXPECT_EQ(tags_of(1),
            std::set<std::size_t>({1, 2, 3, 5, 11, 12, 13, 24, 26, 27}));
  // of the edge from 3 to 5
  EXPECT_EQ(traced.mesh.tags.back(), 27U);
  EXPECT_LT((traced.mesh.x.col(13) - Vector3(0.0, 0.5, -0.5)).norm(), 1e-15);
  EXPECT_THAT(traced.notices, Contains(HasSubstr("2 blank mid-side nodes, "
                                                 "the first of CTETRA 2")));
}

/// A mid-side node on one side of a face alone would open a gap.
TEST(BulkMesh, ElementsOfDifferentOrderMustNotShareAFace) {
  std::string text = element_deck(kTetra, true);
  text.replace(text.find("ENDDATA"), 7,
               "GRID,99,,0.,0.,-1.\nCTETRA,2,1,1,3,2,99\nENDDATA");
  try {
    static_cast<void>(read_mesh(write_file("orders.bdf", text)));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("not its other nodes"));
  }
}

}  // namespace
}  // namespace limber::fem::bulk_mesh_test
