// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/mesh_wire.hpp"

#include <gtest/gtest.h>

#include <random>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::mesh_wire_test {
namespace {

const ElasticMaterial kSteel{210e9, 0.3, 7850.0};

MeshReply make_reply() {
  MeshReply reply;
  reply.mesh =
      read_mesh(testing::write_file("mixed.msh", testing::mixed_msh(0.05)));
  reply.notices = {"a notice"};
  reply.files = {{"/a/file", "content 0"}, {"/b", "absent"}};
  reply.is_repeatable = true;
  return reply;
}

TEST(MeshWire, GivesBackTheMeshToTheBit) {
  const MeshReply sent = make_reply();
  MeshReply found = unpack_reply(pack_reply(sent));
  EXPECT_EQ(found.files, sent.files);
  EXPECT_EQ(found.notices, sent.notices);
  EXPECT_TRUE(found.is_repeatable);
  EXPECT_EQ(find_mesh_content(found.mesh), find_mesh_content(sent.mesh));
  complete_mesh(found.mesh);
  EXPECT_EQ(found.mesh.boundary_nodes, sent.mesh.boundary_nodes);
  const StructuralMatrices a = assemble(found.mesh, {kSteel});
  const StructuralMatrices b = assemble(sent.mesh, {kSteel});
  EXPECT_EQ((a.K - b.K).norm(), 0.0);
  EXPECT_EQ((a.M_s - b.M_s).norm(), 0.0);
}

TEST(MeshWire, GivesBackProblemsWithoutAMesh) {
  MeshReply sent;
  sent.problems = {"one", "two"};
  EXPECT_EQ(unpack_reply(pack_reply(sent)).problems, sent.problems);
}

// Any reply of a compromised mesher is rejected, or is a consistent mesh.
TEST(MeshWire, SurvivesDamageAtAnyPlace) {
  const std::string bytes = pack_reply(make_reply());
  std::mt19937 random(1);
  int refused = 0;
  constexpr int kTrials = 20000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string damaged = bytes;
    const int edits = 1 + static_cast<int>(random() % 3);
    for (int i = 0; i < edits; ++i) {
      damaged[random() % damaged.size()] = static_cast<char>(random());
    }
    if (random() % 4 == 0) damaged.resize(random() % damaged.size());
    try {
      Mesh mesh = unpack_reply(std::move(damaged)).mesh;
      complete_mesh(mesh);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, kTrials / 10);
}

TEST(MeshContent, FollowsNodesElementsGroupsAndNotTheName) {
  const Mesh mesh = make_reply().mesh;
  const std::string content = find_mesh_content(mesh);
  Mesh other = mesh;
  other.source = "another name";
  EXPECT_EQ(find_mesh_content(other), content);
  other.x(0, 0) = std::nextafter(other.x(0, 0), 1e9);
  EXPECT_NE(find_mesh_content(other), content);
  other = mesh;
  std::swap(other.blocks[0].nodes[0], other.blocks[0].nodes[1]);
  EXPECT_NE(find_mesh_content(other), content);
  other = mesh;
  other.volume_groups[0].push_back("more");
  EXPECT_NE(find_mesh_content(other), content);
  other = mesh;
  other.groups.push_back({"more", 2, {0, 1}, {}});
  EXPECT_NE(find_mesh_content(other), content);
}

}  // namespace
}  // namespace limber::fem::mesh_wire_test
