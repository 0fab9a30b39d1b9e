// SPDX-License-Identifier: BSD-3-Clause
// Runs that start from an equilibrium: what is said of it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/scene/scene_folder.hpp"

namespace limber::scene::equilibrium_start_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A pendulum of 1 m near the angle below the horizontal, with more on its
/// joint.
class Pendulum : public ::testing::Test {
 protected:
  BuiltScene build(double angle, const std::string& limit = "",
                   const std::string& more = "") {
    return folder_.build(
        test::kWorld + test::rigid_link("bob", 2.0, 0.5, "1 0 0") +
            "<joint name='pin' type='revolute'><parent link='world'/>"
            "<child link='bob'/><axis xyz='0 1 0'/>" +
            limit + "</joint>\n",
        test::time_table(0.1, 1e-3) +
            fmt::format("[gravity]\nacceleration = [0, 0, -9.81]\n"
                        "[initial]\nequilibrium = true\n"
                        "[initial.joints]\npin = {{ position = {} }}\n"
                        "[[probe]]\nname = 'q'\njoint = 'pin'\n",
                        angle) +
            more);
  }

  test::SceneFolder folder_;
};

TEST_F(Pendulum, HangingIsSaidNothingOf) {
  EXPECT_THAT(build(1.4).warnings, IsEmpty());
}

// exp(sqrt(m g l / (I + m l^2)) t).
TEST_F(Pendulum, UprightIsSaidToBeUnstable) {
  EXPECT_THAT(build(-1.5).warnings,
              Contains(HasSubstr("the equilibrium that was found is unstable: "
                                 "a disturbance grows as exp(2.8 t / s)")));
}

TEST_F(Pendulum, UprightWithAControllerIsSaidNothingOf) {
  const BuiltScene built =
      build(-1.5, "",
            "[[controller]]\nname = 'c'\nperiod = 0.01\nmeasures = 'q.q'\n"
            "proportional = 100\n[[drive]]\nname = 'm'\njoint = 'pin'\n"
            "mode = 'effort'\nsignal = { kind = 'input', controller = 'c' }\n");
  EXPECT_THAT(built.warnings, Not(Contains(HasSubstr("unstable"))));
}

TEST_F(Pendulum, HeldByItsStopIsNotPushedBack) {
  const BuiltScene built =
      build(0.1, "<limit lower='-1' upper='0.2' effort='0' velocity='0'/>");
  dynamics::SystemState state = built.initial;
  const auto statistics =
      dynamics::simulate(built.model, state, built.settings, {});
  EXPECT_THAT(statistics.warnings, IsEmpty());
  EXPECT_THAT(statistics.events, IsEmpty());
}

}  // namespace
}  // namespace limber::scene::equilibrium_start_test
