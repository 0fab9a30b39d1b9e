// SPDX-License-Identifier: BSD-3-Clause
// A finished mesh of first order with nodes in the middle of its edges.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::promotion_test {
namespace {

using testing::BoxKind;
using ::testing::HasSubstr;
using testing::write_file;

/// Places of nodes, in an order that does not depend on their tags.
std::vector<Vector3> sorted_places(const Mesh& mesh,
                                   const std::vector<int>& nodes) {
  std::vector<Vector3> places;
  for (const int node : nodes) {
    constexpr double kGrid =
        1e9;  // so that round-off does not change the order
    places.emplace_back((kGrid * mesh.x.col(node)).array().round() / kGrid);
  }
  std::sort(places.begin(), places.end(),
            [](const Vector3& a, const Vector3& b) {
              return std::lexicographical_compare(a.begin(), a.end(), b.begin(),
                                                  b.end());
            });
  return places;
}

/// Gmsh's own elements of second order, by its option.
TEST(Promotion, GivesGmshsMeshOfSecondOrder) {
  for (const BoxKind kind :
       {BoxKind::tetrahedra, BoxKind::hexahedra, BoxKind::prisms}) {
    const auto geo = write_file("box.geo", testing::box_geo(kind));
    const auto first = testing::convert(geo, "first.msh", {.order = 1});
    const Mesh known = read_mesh(
        testing::convert(geo, "second.msh", {.order = 2, .serendipity = true}));
    const Mesh mesh = read_mesh(first, {.order = 2});
    ASSERT_EQ(mesh.blocks.size(), known.blocks.size());
    EXPECT_EQ(mesh.blocks[0].element->name, known.blocks[0].element->name);
    EXPECT_EQ(sorted_places(mesh, mesh.boundary_nodes),
              sorted_places(known, known.boundary_nodes));
    EXPECT_EQ(mesh.node_count(), known.node_count());
    for (const PhysicalGroup& group : known.groups)
      EXPECT_EQ(
          sorted_places(mesh, mesh.groups[find_group(mesh, group.name)].nodes),
          sorted_places(known, group.nodes))
          << group.name;
  }
}

TEST(Promotion, PutsNodesWhereTheReferenceElementHasThem) {
  for (const std::string& text :
       {testing::pyramids_msh(), testing::mixed_msh(0.0)}) {
    const Mesh mesh = read_mesh(write_file("all.msh", text), {.order = 2});
    for (const ElementBlock& block : mesh.blocks)
      for (std::size_t e = 0; e < block.size(); ++e) {
        const Matrix3X x = element_positions(mesh, block, e);
        const ReferenceElement& element = *block.element;
        EXPECT_EQ(element.order, 2);
        if (element.corner_count == 4) {
          EXPECT_TRUE(is_parallel_sided(element, x));
        }
      }
  }
}

TEST(Promotion, LeavesASecondOrderMeshAndRefusesOthers) {
  const auto geo = write_file("box.geo", testing::box_geo(BoxKind::tetrahedra));
  const auto second = testing::convert(geo, "second.msh", {.order = 2});
  EXPECT_EQ(find_mesh_content(read_mesh(second, {.order = 2})),
            find_mesh_content(read_mesh(second)));
  for (const int order : {1, 3}) {
    try {
      static_cast<void>(read_mesh(second, {.order = order}));
      ADD_FAILURE() << "accepted order " << order;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("finished mesh"));
    }
  }
  try {
    static_cast<void>(read_mesh(
        testing::convert(geo, "third.msh", {.order = 3}), {.order = 2}));
    ADD_FAILURE() << "accepted a mesh of third order";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("order 3"));
  }
}

}  // namespace
}  // namespace limber::fem::promotion_test
