// SPDX-License-Identifier: BSD-3-Clause
// Many worlds of one scene, without a terminal.
#include "limber/runs/batch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/dynamics/control/external_law.hpp"
#include "limber/runs/parallel_worlds.hpp"
#include "unit/scene/scene_folder.hpp"

namespace limber::runs::batch_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kPeriod = 0.02;
constexpr double kMass = 3.0;

/// A sled on a rail, pushed by the input `push`.
class PushedSled : public ::testing::Test {
 protected:
  [[nodiscard]] Batch make(std::size_t worlds,
                           BatchOptions options = {}) const {
    return {scene_, folder_.build(scene_), worlds, options};
  }

  /// Of one world, by a simulator alone.
  [[nodiscard]] std::vector<double> simulate(
      const std::vector<double>& pushes) const {
    scene::BuiltScene built = folder_.build(scene_);
    dynamics::ControllerModel& controller = built.model.controllers.front();
    controller.law = std::make_shared<const dynamics::ExternalLaw>();
    controller.memory = {0.0};
    built.initial.controllers.front().memory = {0.0};
    dynamics::Simulator simulator(built.model, built.initial, built.settings);
    for (std::size_t k = 0; k < pushes.size(); ++k) {
      simulator.set_external_outputs(std::span(&pushes[k], 1));
      simulator.advance_to(static_cast<double>(k + 1) * kPeriod);
    }
    return scene::evaluate_all(built.probes, built.model, simulator.state());
  }

  scene::test::SceneFolder folder_;
  scene::Scene scene_ = folder_.load(
      scene::test::kWorld + scene::test::rigid_link("sled", kMass, 0.1) +
          "<joint name='rail' type='prismatic'><parent link='world'/><child "
          "link='sled'/><axis xyz='1 0 0'/><limit lower='-9' upper='9' "
          "effort='0' velocity='0'/></joint>",
      scene::test::time_table(0.2, 1e-3) +
          "[[load]]\nname = 'thrust'\nlink = 'sled'\nforce = [1, 0, 0]\n"
          "time = { kind = 'input', controller = 'push' }\n"
          "[[controller]]\nname = 'push'\nperiod = 0.02\nmeasures = 'x.q'\n"
          "proportional = 1.0\n[[probe]]\nname = 'x'\ncoupler = 'rail'\n"
          "quantity = 'coordinate'\n");
};

TEST_F(PushedSled, MovesAsItsMassUnderForcesThatAreHeld) {
  Batch batch = make(2);
  const std::vector<unsigned char> all(2, 1);
  double x = 0.0;
  double v = 0.0;
  for (const double push : {6.0, -9.0, 12.0}) {
    batch.step(std::vector{push, 0.0}, 1, all);
    x += kPeriod * v + 0.5 * kPeriod * kPeriod * push / kMass;
    v += kPeriod * push / kMass;
  }
  EXPECT_NEAR(batch.observations()[0], x, 1e-9);
  EXPECT_EQ(batch.observations()[1], 0.0);
  EXPECT_THAT(batch.inputs(), ElementsAre("push"));
  EXPECT_EQ(batch.columns().front().name, "x.q");
}

TEST_F(PushedSled, HasTheBitsOfASimulatorAloneOnAnyNumberOfThreads) {
  const std::vector<double> pushes = {6.0, -9.0, 12.0, 1.0};
  for (const std::size_t threads : {1, 2, 3}) {
    Batch batch = make(3, {.threads = threads});
    for (const double push : pushes) {
      batch.step(std::vector{push, 2.0 * push, -push}, 1,
                 std::vector<unsigned char>(3, 1));
    }
    EXPECT_EQ(batch.observations()[0], simulate(pushes)[0]);
    EXPECT_EQ(batch.observations()[2], simulate({-6.0, 9.0, -12.0, -1.0})[0]);
  }
}

TEST_F(PushedSled, IsNanAfterAPushThatIsNoNumberUntilAReset) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Batch batch = make(2);
  const std::vector<unsigned char> all(2, 1);
  EXPECT_TRUE(batch.step(std::vector{kNan, 3.0}, 1, all));
  EXPECT_THAT(batch.failed(), ElementsAre(1, 0));
  EXPECT_TRUE(std::isnan(batch.observations()[0]));
  EXPECT_GT(batch.observations()[1], 0.0);
  EXPECT_THAT(batch.failure(0), HasSubstr("push"));
  batch.reset(std::vector<unsigned char>{1, 0});
  EXPECT_THAT(batch.failed(), Each(0));
  EXPECT_EQ(batch.observations()[0], 0.0);
  EXPECT_GT(batch.observations()[1], 0.0);
}

TEST_F(PushedSled, StartsWhereItsWorldDoes) {
  Batch batch = make(2);
  batch.reset(
      std::vector<unsigned char>{1, 1},
      std::vector<WorldStart>{{}, {.joints = {{"rail", {{0.25}, {}}}}}});
  EXPECT_EQ(batch.observations()[0], 0.0);
  EXPECT_EQ(batch.observations()[1], 0.25);
}

TEST_F(PushedSled, StopsWhereItIsToldTo) {
  Batch batch = make(2, {.threads = 1});
  int count = 0;
  EXPECT_FALSE(batch.step(std::vector{1.0, 1.0}, 1,
                          std::vector<unsigned char>(2, 1),
                          [&] { return ++count > 5; }));
  EXPECT_THAT(batch.failed(), Each(1));
  EXPECT_THAT(batch.failure(0), HasSubstr("interrupted"));
}

TEST_F(PushedSled, RefusesControlsAndMasksOfOtherSizes) {
  Batch batch = make(2);
  const std::vector<unsigned char> all(2, 1);
  EXPECT_THROW(batch.step(std::vector{1.0}, 1, all), InputError);
  EXPECT_THROW(batch.step(std::vector{1.0, 1.0}, 0, all), InputError);
  EXPECT_THROW(
      batch.step(std::vector{1.0, 1.0}, 1, std::vector<unsigned char>(3, 1)),
      InputError);
  EXPECT_THROW(batch.reset(std::vector<unsigned char>(1, 1)), InputError);
  EXPECT_THROW(make(0), InputError);
}

TEST(ParallelWorlds, AreAllDoneOnceAndTheFirstFailureIsThrown) {
  std::vector<int> count(100, 0);
  for_each_world(100, 4, [&](std::size_t i, std::size_t) { ++count[i]; });
  EXPECT_THAT(count, Each(1));
  try {
    for_each_world(100, 4, [&](std::size_t i, std::size_t) {
      if (i >= 30) throw InputError(std::to_string(i));
    });
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "30");
  }
  for_each_world(0, 4, [](std::size_t, std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace limber::runs::batch_test
