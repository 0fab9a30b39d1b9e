// SPDX-License-Identifier: BSD-3-Clause
// Pieces of a mesh as bodies of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/flexbody/file/cache.hpp"
#include "limber/reduction/reduce.hpp"
#include "unit/reduction/bar.hpp"

namespace limber::flexbody::pieces_test {
namespace {

using testing::Bar;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Bar make_slender() {
  return {
      .corner = {0.2, -0.025, -0.02}, .size = {1.0, 0.05, 0.04}, .cells = 21};
}

std::vector<ReducedBody> reduce_pieces(const Recipe& recipe, int count) {
  const MeshAtHand mesh = make_reducer({}).make_mesh(recipe.mesh);
  std::vector<ReducedBody> bodies;
  for (int i = 0; i < count; ++i) {
    bodies.push_back(mesh.take_piece({count, i}).reduce(recipe));
  }
  return bodies;
}

std::vector<std::string> names_of(const ReducedBody& body) {
  std::vector<std::string> names;
  for (const InterfaceTable& table : body.interfaces) {
    names.push_back(table.name);
  }
  return names;
}

std::string error_of(const Recipe& recipe, int count) {
  try {
    reduce_pieces(recipe, count);
  } catch (const InputError& error) {
    return error.problems().front();
  }
  return "";
}

TEST(Pieces, MakeUpTheWholeBody) {
  const Bar bar = make_slender();
  Recipe recipe = make_recipe(bar);
  recipe.basis.eigenmodes = 2;
  const auto pieces = reduce_pieces(recipe, 3);  // of 7 layers each
  double mass = 0.0;
  Matrix3 S0 = Matrix3::Zero();
  const Vector3 centre = bar.corner + 0.5 * bar.size;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const ReducedBody& piece = pieces[i];
    const Vector3 d = piece.p_MoBcm_M - centre;
    mass += piece.mass;
    S0 += piece.integrals.S0 + piece.mass * d * d.transpose();
    EXPECT_NEAR(piece.mass, bar.mass() / 3.0, 1e-12 * bar.mass());
    EXPECT_NEAR(d.x(), (static_cast<double>(i) - 1.0) / 3.0, 1e-12);
    EXPECT_EQ(piece.mesh_elements, 7U);
  }
  EXPECT_NEAR(mass, bar.mass(), 1e-12 * bar.mass());
  const Vector3 square = bar.size.cwiseAbs2() / 12.0;
  EXPECT_LT((S0 - Matrix3(bar.mass() * square.asDiagonal())).norm(),
            1e-10 * S0.norm());
}

TEST(Pieces, HaveTheInterfacesOfTheWholeAndTheirCuts) {
  Recipe recipe = make_recipe(make_slender());
  recipe.basis.eigenmodes = 2;
  const auto pieces = reduce_pieces(recipe, 3);
  EXPECT_THAT(names_of(pieces[0]), ElementsAre("root", "cut:1-2"));
  EXPECT_THAT(names_of(pieces[1]), ElementsAre("cut:1-2", "cut:2-3"));
  EXPECT_THAT(names_of(pieces[2]), ElementsAre("tip", "cut:2-3"));
  const Vector3 before = pieces[0].p_MoBcm_M + pieces[0].interfaces[1].p_B;
  const Vector3 after = pieces[1].p_MoBcm_M + pieces[1].interfaces[0].p_B;
  EXPECT_LT((before - Vector3(0.2 + 1.0 / 3.0, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((after - before).norm(), 1e-14);
}

// The surface of a cut is not the body's.
TEST(Pieces, ShareOutTheSurface) {
  Recipe recipe = make_recipe(make_slender());
  recipe.basis.eigenmodes = 2;
  const auto whole = reduce(recipe);
  const auto pieces = reduce_pieces(recipe, 2);
  EXPECT_EQ(pieces[0].triangles.size() + pieces[1].triangles.size(),
            whole.triangles.size());
  EXPECT_EQ(pieces[0].groups.size(), 2U);  // the face at its end and the top
}

TEST(Pieces, AreCutBetweenTheLayersNearestToEqualVolumes) {
  Recipe recipe = make_recipe(make_slender());
  recipe.basis.eigenmodes = 2;
  const auto pieces = reduce_pieces(recipe, 2);
  EXPECT_EQ(pieces[0].mesh_elements + pieces[1].mesh_elements, 21U);
  EXPECT_GE(std::min(pieces[0].mesh_elements, pieces[1].mesh_elements), 10U);
}

// Of a bar on which no group has nodes between its ends.
TEST(Pieces, RefuseWhatReachesOverACut) {
  Recipe recipe = make_recipe(make_slender());
  recipe.interfaces.push_back(
      {"all", BoxNodes{{0.0, -1.0, -1.0}, {2.0, 1.0, 1.0}}});
  EXPECT_THAT(error_of(recipe, 2),
              HasSubstr("interface 'all' reaches over pieces 1 and 2 of 2"));
  EXPECT_THAT(error_of(make_recipe(make_slender()), 50),
              HasSubstr("do not give 50 pieces"));
}

TEST(Pieces, AreAdvisedForSlenderBodiesAlone) {
  const auto advise = [](const Bar& bar) {
    return make_reducer({}).make_mesh(make_recipe(bar).mesh).advise_pieces();
  };
  EXPECT_EQ(advise(make_slender()).count, 2);
  const PieceAdvice chunky = advise({.size = {1.0, 0.2, 0.2}, .cells = 10});
  EXPECT_EQ(chunky.count, 1);
  EXPECT_THAT(chunky.reason, HasSubstr("times as long as thick"));
}

TEST(Pieces, HaveKeysOfTheirOwn) {
  const Recipe recipe = make_recipe(make_slender());
  EXPECT_EQ(find_piece_content("mesh", {}), "mesh");
  const std::vector<std::string> contents = {
      find_piece_content("mesh", {}), find_piece_content("mesh", {2, 0}),
      find_piece_content("mesh", {2, 1}), find_piece_content("mesh", {3, 1})};
  for (std::size_t i = 1; i < contents.size(); ++i) {
    EXPECT_NE(contents[i], contents[i - 1]);
    EXPECT_NE(content_key(recipe, contents[i]),
              content_key(recipe, contents[i - 1]));
  }
  EXPECT_NE(recipe_key(recipe, {2, 0}), recipe_key(recipe, {2, 1}));
  EXPECT_NE(recipe_key(recipe), recipe_key(recipe, {2, 0}));
}

}  // namespace
}  // namespace limber::flexbody::pieces_test
