// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/rounding_limit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/simulation/simulator.hpp"
#include "limber/dynamics/system/system_builder.hpp"

namespace limber::dynamics::rounding_limit_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// A body of radius of gyration 1 m, at x [m]. A double has 52 bits after the
// first, so that its position is rounded to 2.2e-16 x.
struct Lone {
  explicit Lone(double x, double moment = 2.0) {
    SystemBuilder builder;
    builder.add_rigid_body("craft", {2.0, moment * Matrix3::Identity()});
    model = builder.build();
    state = make_state(model);
    state.bodies[0].p_WB.x() = x;
  }
  SystemModel model;
  SystemState state;
};

SimulationSettings make_settings() {
  SimulationSettings settings;
  settings.step = 0.1;
  settings.end_time = 1.0;
  settings.output_times = {1.0};
  return settings;
}

std::vector<std::string> check_at(const Lone& lone) {
  std::vector<std::string> warnings;
  RoundingLimit limit(lone.model);
  limit.check(lone.state, warnings);
  return warnings;
}

TEST(RoundingLimit, ToldFromATenMillionthOfTheRadiusOfGyrationOn) {
  const Lone near(0.99e-7 / 0x1p-52);
  EXPECT_THAT(check_at(near), IsEmpty());
  const Lone far(-1.01e-7 / 0x1p-52);
  EXPECT_THAT(check_at(far),
              ElementsAre(AllOf(HasSubstr("'craft' at t = 0 s is 4.55e+08 m"),
                                HasSubstr("rounded to 1e-07 m"),
                                HasSubstr("radius of gyration (1 m)"))));
  const Lone larger(-1.01e-7 / 0x1p-52, 4.0);
  EXPECT_THAT(check_at(larger), IsEmpty());
}

TEST(RoundingLimit, RefusesATenThousandthOfTheRadiusOfGyration) {
  const Lone near(0.99e-4 / 0x1p-52);
  EXPECT_NO_THROW(check_rounding(near.model, near.state));
  for (const double x : {1.01e-4 / 0x1p-52, 1e160, 1e300}) {
    const Lone far(x);
    EXPECT_THROW(check_rounding(far.model, far.state), InputError) << x;
    SystemState state = far.state;
    EXPECT_THROW(simulate(far.model, state, make_settings(), {}, {}),
                 InputError)
        << x;
    EXPECT_THROW(Simulator(far.model, state, make_settings()), InputError) << x;
  }
}

TEST(RoundingLimit, ToldOnceByARunThatBeginsFarAway) {
  const Lone far(1e9);
  SystemState state = far.state;
  EXPECT_THAT(simulate(far.model, state, make_settings(), {}, {}).warnings,
              ElementsAre(HasSubstr("at t = 0 s is 1e+09 m")));
}

TEST(RoundingLimit, ToldByARunThatEndsFarAway) {
  Lone fast(0.0);
  fast.state.bodies[0].v_WB_W.y() = 1e9;
  SystemState state = fast.state;
  EXPECT_THAT(simulate(fast.model, state, make_settings(), {}, {}).warnings,
              Contains(HasSubstr("at t = 1 s is 1e+09 m")));
  Simulator simulator(fast.model, fast.state, make_settings());
  simulator.advance_to(0.4);
  EXPECT_THAT(simulator.statistics().warnings,
              Not(Contains(HasSubstr("from the origin of the world"))));
  simulator.advance_to(1.0);
  EXPECT_THAT(simulator.statistics().warnings,
              Contains(HasSubstr("at t = 1 s is 1e+09 m")));
}

// It flies 1e9 m up and falls back.
TEST(RoundingLimit, ToldByARunThatIsFarAwayInBetween) {
  Lone thrown(0.0);
  thrown.model.gravity_W = Vector3(0.0, 0.0, -8e9);
  thrown.state.bodies[0].v_WB_W.z() = 4e9;
  SimulationSettings settings = make_settings();
  settings.output_times = {0.2, 0.5, 0.8, 1.0};
  SystemState state = thrown.state;
  const auto warnings =
      simulate(thrown.model, state, settings, {}, {}).warnings;
  EXPECT_LT(state.bodies[0].p_WB.norm(), 1e6);
  EXPECT_THAT(warnings, Contains(HasSubstr("at t = 0.2 s is 6.4e+08 m")));
  EXPECT_THAT(warnings, Not(Contains(HasSubstr("at t = 0.5 s is"))));
  Simulator simulator(thrown.model, thrown.state, settings);
  for (const double t : settings.output_times) simulator.advance_to(t);
  EXPECT_THAT(simulator.statistics().warnings,
              Contains(HasSubstr("at t = 0.2 s is 6.4e+08 m")));
}

}  // namespace
}  // namespace limber::dynamics::rounding_limit_test
