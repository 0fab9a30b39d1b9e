// SPDX-License-Identifier: BSD-3-Clause
// Pieces, joined, against the whole: closed forms of bars.
#include "limber/flexbody/modal/piece_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "limber/common/errors.hpp"
#include "limber/reduction/reduce.hpp"
#include "unit/reduction/bar.hpp"

namespace limber::flexbody::piece_check_test {
namespace {

using ::testing::AllOf;
using testing::Bar;
using ::testing::HasSubstr;
using testing::make_recipe;

using BodyPointer = std::shared_ptr<const ReducedBody>;

Bar make_slender() {
  return {
      .size = {1.0, 0.05, 0.04}, .cells = 20, .material = {2e11, 0.0, 7800.0}};
}

double axial_flexibility(const Bar& bar) {
  return bar.size[0] /
         (bar.material.youngs_modulus * bar.size[1] * bar.size[2]);
}

/// Of a cantilever under a force along z at its tip, by Euler and Bernoulli.
double bending_flexibility(const Bar& bar) {
  const double inertia = bar.size[1] * std::pow(bar.size[2], 3) / 12.0;
  return std::pow(bar.size[0], 3) /
         (3.0 * bar.material.youngs_modulus * inertia);
}

BodyPointer reduce_to_pointer(const Recipe& recipe) {
  return std::make_shared<const ReducedBody>(reduce(recipe));
}

/// Piece `soft` has half of the modulus.
PieceAssembly::Bodies cut(const Recipe& recipe, int count, int soft = -1) {
  const MeshAtHand mesh = make_reducer({}).make_mesh(recipe.mesh);
  PieceAssembly::Bodies pieces;
  for (int i = 0; i < count; ++i) {
    Recipe own = recipe;
    if (i == soft) own.materials[0].material.youngs_modulus /= 2.0;
    pieces.push_back(std::make_shared<const ReducedBody>(
        mesh.take_piece({count, i}).reduce(own)));
  }
  return pieces;
}

TEST(PieceAssembly, OfOneBodyHasTheFlexibilitiesOfABeam) {
  const Bar bar = make_slender();
  const PieceAssembly whole({reduce_to_pointer(make_recipe(bar))});
  const Matrix6 C = whole.find_flexibility("tip", "root");
  EXPECT_NEAR(C(0, 0), axial_flexibility(bar), 1e-6 * axial_flexibility(bar));
  EXPECT_NEAR(C(2, 2), bending_flexibility(bar),
              5e-3 * bending_flexibility(bar));
  EXPECT_LT(std::abs(C(0, 2)), 1e-6 * C(0, 0));
}

TEST(PieceAssembly, OfUnequalPiecesHasThoseOfAStepwiseBeam) {
  const Bar bar = make_slender();
  for (const bool is_clamped : {false, true}) {
    Recipe recipe = make_recipe(bar);
    if (is_clamped) {
      recipe.clamped_groups = {"root"};
      recipe.interfaces.erase(recipe.interfaces.begin());
    }
    const PieceAssembly assembly(cut(recipe, 2, 1));
    EXPECT_EQ(assembly.is_free(), !is_clamped);
    const Matrix6 C =
        assembly.find_flexibility("tip", is_clamped ? "" : "root");
    EXPECT_NEAR(C(0, 0), 1.5 * axial_flexibility(bar),
                2e-3 * axial_flexibility(bar));
    // 7/8 of the flexibility comes from the half at the root.
    EXPECT_NEAR(C(2, 2), 1.125 * bending_flexibility(bar),
                5e-3 * bending_flexibility(bar));
  }
}

// By Lanczos and refined solutions there: of bars and plates with two
// interfaces, one and none.
TEST(PieceCheck, EstimatesOfTheWholeAreThoseOfItsReduction) {
  Bar plate = make_slender();
  plate.size = {1.0, 0.7, 0.02};
  for (const Bar& bar : {make_slender(), plate}) {
    for (const std::size_t count : {2U, 1U, 0U}) {
      Recipe recipe = make_recipe(bar);
      recipe.interfaces.resize(count);
      const PieceAssembly rough({reduce_to_pointer(make_whole_recipe(recipe))});
      const PieceAssembly exact({reduce_to_pointer(recipe)});
      const VectorX found = rough.find_frequencies(kComparedFrequencies);
      const VectorX known = exact.find_frequencies(kComparedFrequencies);
      ASSERT_EQ(found.size(), kComparedFrequencies);
      for (int i = 0; i < kComparedFrequencies; ++i)
        EXPECT_NEAR(found[i], known[i], 1e-4 * known[i]) << count;
      if (count < 2) continue;
      const Matrix6 C = exact.find_flexibility("tip", "root");
      EXPECT_LT((C - rough.find_flexibility("tip", "root")).norm(),
                1e-6 * C.norm());
    }
  }
}

// Both interfaces at one corner of a plate, where a mode may be missed.
TEST(PieceCheck, EstimatesFromInterfacesAtOneCornerAreThoseOfTheReduction) {
  Bar plate = make_slender();
  plate.size = {1.0, 0.7, 0.02};
  Recipe recipe = make_recipe(plate);
  recipe.interfaces = {
      {"a", BoxNodes{{-0.01, -0.01, -0.01}, {0.06, 0.01, 0.03}}},
      {"b", BoxNodes{{0.09, -0.01, -0.01}, {0.16, 0.01, 0.03}}}};
  const VectorX found =
      PieceAssembly({reduce_to_pointer(make_whole_recipe(recipe))})
          .find_frequencies(kComparedFrequencies);
  const VectorX known = PieceAssembly({reduce_to_pointer(recipe)})
                            .find_frequencies(kComparedFrequencies);
  for (int i = 0; i < kComparedFrequencies; ++i)
    EXPECT_NEAR(found[i], known[i], 1e-4 * known[i]) << i;
}

TEST(PieceCheck, ReportsTheDifferenceOfASoftPiece) {
  const Recipe recipe = make_recipe(make_slender());
  const auto whole = reduce_to_pointer(make_whole_recipe(recipe));
  PieceCheck check{"bar", 2, compare_pieces(whole, cut(recipe, 2, 1)), {}};
  ASSERT_EQ(check.differences.size(), 3U);
  EXPECT_LT(check.differences[0].error(), -0.01);
  EXPECT_EQ(check.differences[0].unit, "Hz");
  EXPECT_NEAR(check.differences[1].error(), 0.5, 3e-3);
  EXPECT_THAT(
      check.differences[1].quantity,
      AllOf(HasSubstr("along (1, 0, 0) at 'tip'"), HasSubstr("'root' held")));
  EXPECT_THAT(describe_excess(check).value_or(""),
              AllOf(HasSubstr("its 2 pieces differ"), HasSubstr("+50 %"),
                    HasSubstr("fewer pieces")));
}

TEST(PieceCheck, FindsNothingOfBarsCutBetweenLayers) {
  Bar bar = make_slender();
  bar.corner = {3.0, -2.0, 1.0};
  for (const double scale : {1.0, 1e-3}) {  // a tiny one, too
    Bar scaled = bar;
    scaled.size *= scale;
    scaled.corner *= scale;
    for (const int count : {2, 3}) {
      const Recipe recipe = make_recipe(scaled);
      const auto whole = reduce_to_pointer(make_whole_recipe(recipe));
      const PieceCheck check{
          "bar", count, compare_pieces(whole, cut(recipe, count)), {}};
      EXPECT_EQ(check.differences.size(), 3U);
      EXPECT_EQ(describe_excess(check), std::nullopt);
    }
  }
}

// Too small a basis makes them stiffer.
TEST(PieceCheck, NamesEigenmodesWherePiecesAreTooStiff) {
  const PieceCheck check{"bar", 2, {{"frequency", "Hz", 100.0, 103.0}}, {}};
  EXPECT_THAT(describe_excess(check).value_or(""),
              AllOf(HasSubstr("103 instead of 100 Hz (+3 %)"),
                    HasSubstr("more eigenmodes")));
}

TEST(PieceCheck, ComparesOnlyFrequenciesWithoutInterfacesToHoldAndToLoad) {
  Recipe recipe = make_recipe(make_slender());
  recipe.interfaces.pop_back();
  const auto whole = reduce_to_pointer(make_whole_recipe(recipe));
  EXPECT_EQ(compare_pieces(whole, cut(recipe, 2)).size(), 1U);
}

TEST(PieceCheck, OmitsAnInterfaceThatIsTheHeldOne) {
  Recipe recipe = make_recipe(make_slender());
  recipe.interfaces.push_back(recipe.interfaces[0]);
  recipe.interfaces[1] = recipe.interfaces[0];
  recipe.interfaces[1].name = "again";
  recipe.interfaces.pop_back();
  const auto whole = reduce_to_pointer(make_whole_recipe(recipe));
  EXPECT_EQ(compare_pieces(whole, cut(recipe, 2)).size(), 1U);
}

TEST(PieceCheck, ReportsWhyAWholeIsNotCompared) {
  const PieceCheck check{"bar", 4, {}, "memory runs out"};
  EXPECT_THAT(describe_excess(check).value_or(""),
              AllOf(HasSubstr("4 pieces"), HasSubstr("not compared"),
                    HasSubstr("memory runs out")));
}

TEST(CutStiffness, NeedsAFace) {
  Matrix6 C = Matrix6::Identity();
  C.col(3).setZero();
  C.row(3).setZero();
  EXPECT_THROW((void)calc_cut_stiffness(C, C), InputError);
}

}  // namespace
}  // namespace limber::flexbody::piece_check_test
