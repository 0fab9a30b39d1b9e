// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/elastic_inverse.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"
#include "verification/shear_load.hpp"

/// Eigenmodes chosen by the load cases of a recipe, on the report's beam.
namespace limber::automatic_modes {
namespace {

using flexbody::AutomaticModes;
using flexbody::ModeMeasure;
using test::beam;
using test::recipe_of;
using test::select_modes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// 500 N on each node of the loaded edge in x, and in z.
MatrixX shear_and_stretch() {
  const VectorX shear = test::shear_load(beam());
  MatrixX loads = MatrixX::Zero(shear.size(), 2);
  loads.col(0) = shear;
  loads.col(1).tail(shear.size() - 2) = shear.head(shear.size() - 2);
  return loads;
}

/// Relative error of the basis' static response in the norm of elastic energy,
/// by solving with the whole stiffness.
double measure_static_error(const flexbody::ReducedBody& body,
                            const VectorX& load) {
  const std::vector<int> nodes = test::free_nodes(beam());
  const fem::StructuralMatrices matrices = fem::restrict_to(
      fem::assemble(
          beam(), fem::assign_materials(beam(), {{"", {200e9, 0.0, 8000.0}}})),
      nodes);
  const fem::ElasticInverse inverse(matrices, MatrixX(matrices.dof_count(), 0),
                                    beam().x(Eigen::all, nodes));
  MatrixX Phi(load.size(), body.mode_count());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    Phi.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        body.rows.Phi_B.middleRows<3>(3 * nodes[i]);
  const VectorX u = inverse.solve(load);
  const VectorX missed = u - Phi * body.lambda.cwiseInverse().asDiagonal() *
                                 Phi.transpose() * load;
  const auto energy = [&](const VectorX& x) {
    return x.dot(VectorX(fem::multiply_stiffness(matrices.K, x)));
  };
  return std::sqrt(energy(missed) / energy(u));
}

TEST(AutomaticModesByCompliance, StateTheErrorThatTheStaticAnswerHas) {
  const VectorX load = test::shear_load(beam());
  for (const double threshold : {0.9, 0.97}) {
    const flexbody::ReducedBody body =
        flexbody::reduce(recipe_of(load, {threshold}));
    const flexbody::SelectedCase& found = body.selection->cases[0];
    EXPECT_GE(found.reached, threshold);
    EXPECT_GT(found.eigenmode_error, 0.05);
    // Roundoff in a square root of a difference of nearly equal sums.
    EXPECT_NEAR(found.eigenmode_error / measure_static_error(body, load), 1.0,
                1e-6);
    EXPECT_NEAR(found.basis_error, found.eigenmode_error, 1e-9);
  }
}

TEST(AutomaticModesByCompliance, CountTheModesThatImpactsAdd) {
  flexbody::Recipe recipe = recipe_of(test::shear_load(beam()), {0.5});
  const std::size_t own = flexbody::reduce(recipe).selection->modes.size();
  recipe.basis.automatic->impacts = {{0.1, 1e11, 1.0}};
  const flexbody::ReducedBody body = flexbody::reduce(recipe);
  EXPECT_GT(body.selection->modes.size(), own + 2);
  const flexbody::SelectedCase& found = body.selection->cases[0];
  EXPECT_NEAR(found.reached, 1.0 - std::pow(found.eigenmode_error, 2), 1e-9);
}

// A cantilever bends by modes that a pull along it does not move.
TEST(AutomaticModesByCompliance, AreTheUnionOverLoadCases) {
  const MatrixX loads = shear_and_stretch();
  const auto both = select_modes(loads, {0.9});
  const auto shear = select_modes(loads.col(0), {0.9});
  const auto stretch = select_modes(loads.col(1), {0.9});
  ASSERT_EQ(both.cases.size(), 2U);
  EXPECT_EQ(both.cases[0].modes, shear.modes);
  EXPECT_EQ(both.cases[1].modes, stretch.modes);
  std::set<int> joined(shear.modes.begin(), shear.modes.end());
  joined.insert(stretch.modes.begin(), stretch.modes.end());
  EXPECT_EQ(both.modes, std::vector<int>(joined.begin(), joined.end()));
  EXPECT_GT(joined.size(), shear.modes.size());
  EXPECT_EQ(both.cases[1].name, "forces.txt from 0.5 s");
}

TEST(AutomaticModes, TakeMultiplesOfALoadForOneCase) {
  const VectorX load = test::shear_load(beam());
  MatrixX loads(load.size(), 4);
  loads << load, VectorX::Zero(load.size()), -0.3 * load, load / 7.0;
  EXPECT_EQ(select_modes(loads, {0.9}).cases.size(), 1U);
}

// f_max T_c >= 2 of Hertz's impact of two free bodies, T_c = 2.9433 d_p / v.
TEST(AutomaticModes, OfAnImpactReachTwoPeriodsInItsDuration) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
  recipe.basis.interface_modes = false;
  recipe.basis.eigenmodes = 30;
  const flexbody::ReducedBody all = flexbody::reduce(recipe);
  constexpr double kMass = 2.0;
  constexpr double kStiffness = 1e8;
  for (const double speed : {1e-3, 0.1, 10.0}) {
    recipe.basis.automatic = AutomaticModes{
        .candidates = 30, .impacts = {{kMass, kStiffness, speed}}};
    const double mass = 1.0 / (1.0 / kMass + 1.0 / all.mass);
    const double depth =
        std::pow(5.0 * mass * speed * speed / (4.0 * kStiffness), 0.4);
    const double highest = 2.0 / (2.9433 * depth / speed);
    int expected = 0;
    while (expected < 30 &&
           std::sqrt(all.lambda[expected]) / (2.0 * M_PI) <= highest) {
      ++expected;
    }
    EXPECT_GT(expected, 0);
    EXPECT_LT(expected, 29);
    EXPECT_EQ(flexbody::reduce(recipe).selection->modes.size(),
              static_cast<std::size_t>(expected) + 1);
  }
}

TEST(AutomaticModes, ThatFallShortSaySo) {
  const auto record = select_modes(test::shear_load(beam()),
                                   {0.999, ModeMeasure::compliance, 3});
  EXPECT_THAT(record.modes, ElementsAre(0, 1, 2));
  EXPECT_LT(record.cases[0].reached, 0.999);
  EXPECT_THAT(describe_shortfalls(record),
              ElementsAre(HasSubstr("forces.txt from 0 s")));
  EXPECT_THAT(
      describe_shortfalls(select_modes(test::shear_load(beam()), {0.9})),
      IsEmpty());
}

// Stretching has 8 / pi^2 of a bar's mass, mode 6 here. Of the beam's mass the
// nodes on the clamp have 1.3 %.
TEST(AutomaticModesByMass, TakeTheFirstAxialModeForItsShare) {
  const auto record =
      select_modes(MatrixX(0, 0), {0.75, ModeMeasure::mass, 10});
  ASSERT_EQ(record.cases.size(), 3U);
  EXPECT_EQ(record.cases[2].name, "base along z");
  EXPECT_THAT(record.cases[2].modes, ElementsAre(5));
  EXPECT_NEAR(record.cases[2].reached, 8.0 / (M_PI * M_PI), 0.013);
}

// The default basis represents its loads exactly; eigenmodes alone do not.
TEST(AutomaticModes, WithStaticDeformationModesHaveNoStaticErrorLeft) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
  recipe.interfaces = {{"tip", flexbody::GroupNodes{"tip"}}};
  recipe.basis.automatic = AutomaticModes{};
  recipe.basis.automatic->candidates = 10;
  const auto record = *flexbody::reduce(recipe).selection;
  ASSERT_EQ(record.cases.size(), 6U);  // the interface's forces and moments
  for (const flexbody::SelectedCase& item : record.cases) {
    EXPECT_GT(item.eigenmode_error, 0.1);
    EXPECT_LT(item.basis_error, 1e-5);  // square root of roundoff
  }
}

TEST(AutomaticModes, OfAPatternThatIsALoadCaseAloneAddNoStaticMode) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh", true);
  recipe.interfaces = {{"tip", flexbody::GroupNodes{"tip"},
                        flexbody::Weighting::uniform, false}};
  recipe.load_patterns = {{"tip", Vector3::UnitX()}};
  recipe.basis.automatic = AutomaticModes{};
  const flexbody::ReducedBody with = flexbody::reduce(recipe);
  recipe.load_patterns[0].static_mode = false;
  const flexbody::ReducedBody without = flexbody::reduce(recipe);
  EXPECT_EQ(with.selection->modes, without.selection->modes);
  EXPECT_EQ(with.mode_count(), without.mode_count() + 1);
}

TEST(AutomaticModes, WithoutAnythingToChooseByAreRefused) {
  const auto error_of = [](const flexbody::Recipe& recipe) -> std::string {
    try {
      static_cast<void>(flexbody::reduce(recipe));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
  recipe.basis.automatic = AutomaticModes{};
  EXPECT_THAT(error_of(recipe), HasSubstr("need a load"));
  recipe.basis.automatic->measure = ModeMeasure::mass;
  EXPECT_THAT(error_of(recipe), HasSubstr("nothing is clamped"));
  recipe = test::beam_recipe("beam5k_v41.msh", true);
  recipe.basis.automatic = AutomaticModes{0.9, ModeMeasure::report};
  EXPECT_THAT(error_of(recipe), HasSubstr("more than the 4000"));
  EXPECT_THAT(error_of(recipe_of(MatrixX::Ones(3, 1), {})),
              HasSubstr("3 rows of forces; expected 1626"));
}

}  // namespace
}  // namespace limber::automatic_modes
