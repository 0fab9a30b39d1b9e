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
using ::testing::HasSubstr;
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

TEST(RoundingLimit, ToldFromATenMillionthOfTheRadiusOfGyrationOn) {
  const Lone near(0.99e-7 / 0x1p-52);
  EXPECT_FALSE(describe_rounding(near.model, near.state));
  const Lone far(-1.01e-7 / 0x1p-52);
  EXPECT_THAT(describe_rounding(far.model, far.state).value_or(""),
              AllOf(HasSubstr("body 'craft' at t = 0 s is 4.55e+08 m"),
                    HasSubstr("rounded to 1e-07 m"),
                    HasSubstr("radius of gyration (1 m)")));
  const Lone larger(-1.01e-7 / 0x1p-52, 4.0);
  EXPECT_FALSE(describe_rounding(larger.model, larger.state));
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
              ::testing::ElementsAre(HasSubstr("at t = 0 s is 1e+09 m")));
}

TEST(RoundingLimit, ToldByARunThatEndsFarAway) {
  Lone fast(0.0);
  fast.state.bodies[0].v_WB_W.y() = 1e9;
  SystemState state = fast.state;
  EXPECT_THAT(simulate(fast.model, state, make_settings(), {}, {}).warnings,
              Contains(HasSubstr("at t = 1 s is 1e+09 m")));
  Simulator simulator(fast.model, fast.state, make_settings());
  simulator.advance_to(0.5);
  EXPECT_THAT(simulator.statistics().warnings,
              Not(Contains(HasSubstr("from the origin of the world"))));
  simulator.advance_to(1.0);
  EXPECT_THAT(simulator.statistics().warnings,
              Contains(HasSubstr("at t = 1 s is 1e+09 m")));
}

}  // namespace
}  // namespace limber::dynamics::rounding_limit_test
