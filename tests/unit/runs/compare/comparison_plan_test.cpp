// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/compare/comparison_plan.hpp"

#include <gmock/gmock.h>

#include "unit/scene/temporary_file.hpp"

namespace limber::runs::comparison_plan_test {
namespace {

using dynamics::Fidelity;
using scene::test::input_error;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

scene::Scene make_scene(bool is_flexible = true) {
  scene::Scene scene;
  scene::Link link;
  link.name = "arm";
  if (is_flexible) {
    link.flexible.emplace();
    link.flexible->mesh.file = "arm.msh";
  }
  scene.robot.links = {link};
  scene.scenario.settings.step = 1e-3;
  return scene;
}

std::vector<std::string> names_of(const ComparisonPlan& plan) {
  std::vector<std::string> names;
  for (const Choice& run : plan.runs) names.push_back(describe(run));
  return names;
}

std::string error_of(const Axes& axes, const ReferenceWish& wish = {}) {
  return input_error([&] { (void)make_plan(axes, wish, make_scene()); });
}

TEST(ComparisonPlan, WithoutAxesHoldsEveryLevelWithABasisAndRigid) {
  const ComparisonPlan plan = make_plan({}, {}, make_scene());
  EXPECT_THAT(names_of(plan),
              ElementsAre("rigid", "uncoupled", "one-way", "coupled"));
  EXPECT_EQ(plan.reference.step, 0.5e-3);
}

TEST(ComparisonPlan, TakesTheCostliestReducedLevelAsReferenceAndSaysSo) {
  const ComparisonPlan plan = make_plan({}, {}, make_scene());
  EXPECT_EQ(plan.reference.level, Fidelity::coupled);
  EXPECT_THAT(describe_default_reference(plan),
              AllOf(HasSubstr("costliest reduced level, 'coupled'"),
                    HasSubstr("--reference full")));
}

TEST(ComparisonPlan, TakesWholeMeshesOnlyWhenAsked) {
  const ComparisonPlan asked =
      make_plan({}, {Fidelity::full, {}, {}}, make_scene());
  EXPECT_EQ(asked.reference.level, Fidelity::full);
  EXPECT_EQ(describe_default_reference(asked), "");
  Axes axes;
  axes.levels = {Fidelity::coupled, Fidelity::full};
  const ComparisonPlan compared = make_plan(axes, {}, make_scene());
  EXPECT_EQ(compared.reference.level, Fidelity::full);
  EXPECT_THAT(describe_default_reference(compared),
              HasSubstr("highest level requested, 'full'"));
}

// Of the reference's cost, which has half the step.
TEST(ComparisonPlan, EstimatesCostsByLevelAndStep) {
  Axes axes;
  axes.levels = {Fidelity::rigid, Fidelity::coupled};
  axes.steps = {1e-3, 2e-3};
  const ComparisonPlan plan = make_plan(axes, {}, make_scene());
  ASSERT_EQ(plan.runs.size(), 4U);
  const auto cost = [&](std::size_t i) {
    return estimate_cost(plan.runs[i], plan.reference);
  };
  EXPECT_EQ(estimate_cost(plan.reference, plan.reference), 1.0);
  EXPECT_DOUBLE_EQ(cost(2), 0.5);
  EXPECT_DOUBLE_EQ(cost(3), 0.25);
  EXPECT_LT(cost(0), cost(2));
}

TEST(ComparisonPlan, CombinesAxesButGivesRigidNoBasis) {
  Axes axes;
  axes.levels = {Fidelity::rigid, Fidelity::coupled};
  axes.eigenmodes = {4, 10};
  axes.sources = {"eigenmodes", "all"};
  axes.steps = {1e-3};
  EXPECT_THAT(
      names_of(make_plan(axes, {Fidelity::coupled, {}, {}}, make_scene())),
      ElementsAre("rigid, 0.001 s", "coupled, 4 eigenmodes, 0.001 s",
                  "coupled, 4 eigenmodes + all, 0.001 s",
                  "coupled, 10 eigenmodes, 0.001 s",
                  "coupled, 10 eigenmodes + all, 0.001 s"));
}

TEST(ComparisonPlan, HasTheLargestBasisAndHalfTheShortestStepAsReference) {
  Axes axes;
  axes.eigenmodes = {20, 4};
  axes.sources = {"interfaces", "loads"};
  axes.steps = {1e-3, 2e-4};
  const ReferenceWish wish{Fidelity::coupled, {}, {}};
  const Choice reference = make_plan(axes, wish, make_scene()).reference;
  EXPECT_EQ(reference.basis.eigenmodes, 20);
  EXPECT_EQ(find_source_name(reference.basis), "all");
  EXPECT_EQ(reference.step, 1e-4);
}

TEST(ComparisonPlan, GivesTheReferenceAloneAnIntegratorOfItsOwn) {
  ReferenceWish wish;
  wish.integrator = dynamics::IntegratorKind::central_differences;
  const ComparisonPlan plan = make_plan({}, wish, make_scene());
  EXPECT_EQ(plan.reference.integrator, wish.integrator);
  for (const Choice& run : plan.runs) EXPECT_FALSE(run.integrator);
  EXPECT_THAT(describe(plan.reference), HasSubstr("central-differences"));
}

TEST(ComparisonPlan, TakesHalfTheShortestStepOfASchedule) {
  scene::Scene scene = make_scene();
  scene.scenario.settings.step_changes = {{0.1, 4e-4}, {0.2, 1e-2}};
  EXPECT_EQ(make_plan({}, {}, scene).reference.step, 2e-4);
}

TEST(ComparisonPlan, TakesATenthOfATolerance) {
  scene::Scene scene = make_scene();
  scene.scenario.settings.tolerance = 1e-4;
  scene.scenario.settings.step = 2.0;  // the duration
  const ComparisonPlan plan = make_plan({}, {}, scene);
  EXPECT_FALSE(plan.reference.step);
  EXPECT_EQ(plan.reference.tolerance_fraction, 0.1);
  EXPECT_THAT(describe(plan.reference), HasSubstr("0.1 of the tolerance"));
  for (const Choice& run : plan.runs) EXPECT_EQ(run.tolerance_fraction, 1.0);
  Axes steps;
  steps.steps = {1e-3};
  EXPECT_EQ(make_plan(steps, {}, scene).reference.step, 5e-4);
  ReferenceWish wish;
  wish.integrator = dynamics::IntegratorKind::central_differences;
  EXPECT_THAT(input_error([&] { (void)make_plan({}, wish, scene); }),
              HasSubstr("give --reference-step"));
  wish.step = 1e-5;
  EXPECT_EQ(make_plan({}, wish, scene).reference.step, 1e-5);
}

TEST(ComparisonPlan, HoldsNoRunTwice) {
  Axes axes;
  axes.levels = {Fidelity::rigid, Fidelity::rigid, Fidelity::uncoupled};
  axes.steps = {1e-3, 1e-3};
  EXPECT_EQ(make_plan(axes, {}, make_scene()).runs.size(), 2U);
}

TEST(ComparisonPlan, LeavesOutBasesOfNothing) {
  Axes axes;
  axes.levels = {Fidelity::coupled};
  axes.eigenmodes = {0, 3};
  axes.sources = {"eigenmodes", "interfaces"};
  EXPECT_EQ(make_plan(axes, {}, make_scene()).runs.size(), 3U);
}

TEST(ComparisonPlan, OfRigidLinksAloneHasOneLevel) {
  Axes axes;
  axes.levels = {Fidelity::rigid, Fidelity::coupled};
  axes.steps = {1e-3, 1e-4};
  EXPECT_EQ(make_plan(axes, {}, make_scene(false)).runs.size(), 2U);
}

TEST(ComparisonPlan, RefusesAReferenceThatLeavesOutWhatARunComputes) {
  Axes axes;
  axes.levels = {Fidelity::coupled};
  EXPECT_THAT(error_of(axes, {Fidelity::rigid, {}, {}}),
              HasSubstr("--fidelity: 'coupled' computes more"));
  axes.eigenmodes = {10};
  EXPECT_THAT(
      error_of(axes, {Fidelity::coupled, 5, {}}),
      HasSubstr(
          "--reference-modes: 5 are fewer than the 10 of a compared run"));
  EXPECT_THAT(error_of(axes, {Fidelity::coupled, {}, 2e-3}),
              HasSubstr("--reference-step: 0.002 s is longer"));
}

TEST(ComparisonPlan, RefusesAxesThatMeanNothing) {
  Axes axes;
  axes.levels = {Fidelity::rigid};
  axes.eigenmodes = {10};
  EXPECT_THAT(error_of(axes), HasSubstr("no level that is compared has one"));
  axes.sources = {"interface"};
  EXPECT_THAT(error_of(axes), HasSubstr("did you mean 'interfaces'"));
  axes = {};
  axes.levels = {Fidelity::rigid};
  axes.steps = {1e-3};
  EXPECT_THAT(error_of(axes, {Fidelity::rigid, {}, 1e-3}),
              HasSubstr("nothing to compare"));
}

TEST(Choice, HasAFolderNameOfItsOwnWithoutBlanks) {
  Choice choice;
  EXPECT_EQ(make_folder_name(choice), "coupled");
  choice.basis = {10, true, false};
  choice.step = 5e-4;
  EXPECT_EQ(make_folder_name(choice), "coupled-10-interfaces-0.0005s");
  EXPECT_EQ(make_label(choice), "10 + interfaces 0.0005 s");
  choice.basis = {10, false, false};
  EXPECT_EQ(make_label(choice), "10 modes 0.0005 s");
}

TEST(Choice, TakesThePlaceOfTheScenariosWords) {
  const auto kind = dynamics::IntegratorKind::runge_kutta_4;
  const Choice choice{Fidelity::one_way, {7, {}, true}, 0.1, kind};
  const scene::Overrides overrides = to_overrides(choice);
  EXPECT_EQ(overrides.fidelity, Fidelity::one_way);
  EXPECT_EQ(overrides.basis, choice.basis);
  EXPECT_EQ(overrides.step, 0.1);
  EXPECT_EQ(overrides.integrator, kind);
}

}  // namespace
}  // namespace limber::runs::comparison_plan_test
