// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <numbers>

#include "unit/scene/scene_folder.hpp"

/// The note of default joints between rigid links that an explicit scheme makes
/// softer.
namespace limber::scene::explicit_defaults_test {
namespace {

using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::time_table;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kLinks =
    kWorld + rigid_link("a", 2.0, 0.1) + rigid_link("b", 4.0, 0.3);
const std::string kBothStiff =
    "translational_stiffness='1e6' rotational_stiffness='1e4'";

std::string joint(const std::string& name, const std::string& child,
                  const std::string& type = "continuous") {
  return fmt::format(
      "<joint name='{}' type='{}'><parent link='world'/><child link='{}'/>"
      "<axis xyz='0 0 1'/></joint>\n",
      name, type, child);
}

const std::string kTwo = kLinks + joint("j", "a") + joint("k", "b");

std::string coupler(const std::string& name, const std::string& more) {
  return fmt::format("<coupler joint='{}' {}/>\n", name, more);
}

BuiltScene build(const std::string& robot, const std::string& integrator) {
  return SceneFolder().build(
      robot,
      time_table(0.1, 1e-4) + fmt::format("integrator = '{}'\n", integrator));
}

std::vector<std::string> notes(const std::string& robot) {
  return build(robot, "runge-kutta-4").notes;
}

TEST(ExplicitDefaults, AreTheFrequencyInTheNoteWithEveryExplicitScheme) {
  for (const std::string& name : dynamics::integrator_names()) {
    const BuiltScene built = build(kTwo, name);
    const bool is_implicit =
        dynamics::traits_of(dynamics::parse_integrator(name)).is_implicit;
    const double frequency = is_implicit ? 20000.0 : 1000.0;
    const double omega = 2.0 * std::numbers::pi * frequency;
    const auto held =
        joints::find_constraint_stiffness(built.model.couplers.front().law);
    ASSERT_TRUE(held.has_value());
    EXPECT_NEAR(held->translational / (2.0 * omega * omega), 1.0, 1e-12)
        << name;
    if (is_implicit) {
      EXPECT_THAT(built.notes, IsEmpty()) << name;
      continue;
    }
    EXPECT_THAT(built.notes,
                ElementsAre(AllOf(HasSubstr(name + " is explicit"),
                                  HasSubstr("2 joints of rigid links"),
                                  HasSubstr("'j'"), HasSubstr("1000 Hz"),
                                  HasSubstr("20000 Hz"),
                                  HasSubstr("translational_stiffness"))));
  }
}

TEST(ExplicitDefaults, CountOnlyWhatHoldsByADefault) {
  EXPECT_THAT(notes(kTwo + coupler("j", kBothStiff)),
              ElementsAre(AllOf(HasSubstr("1 joint of rigid links"),
                                HasSubstr("'k'"))));
  EXPECT_THAT(notes(kTwo + coupler("j", kBothStiff) + coupler("k", kBothStiff)),
              IsEmpty());
  EXPECT_THAT(notes(kTwo + coupler("j", "translational_stiffness='1e6'") +
                    coupler("k", kBothStiff)),
              ElementsAre(HasSubstr("'j'")));
}

TEST(ExplicitDefaults, CountNoDirectionThatAJointLeavesFree) {
  const std::string floating = kLinks + joint("j", "a", "floating") +
                               joint("k", "b") + coupler("k", kBothStiff);
  EXPECT_THAT(notes(floating + coupler("j", "free_damping='1'")), IsEmpty());
  EXPECT_THAT(
      notes(floating + coupler("j", "kind='ball' translational_stiffness='1'")),
      IsEmpty());
  EXPECT_THAT(notes(floating + coupler("j", "kind='ball'")),
              ElementsAre(HasSubstr("'j'")));
}

TEST(ExplicitDefaults, CountLoopsAndLatches) {
  const std::string held =
      kTwo + coupler("j", kBothStiff) + coupler("k", kBothStiff);
  EXPECT_THAT(notes(held + "<loop name='l' kind='fixed'><from link='a'/>"
                           "<to link='b'/></loop>"),
              ElementsAre(HasSubstr("'l'")));
  EXPECT_THAT(notes(held + "<latch name='h' reach='0.01'><from link='a'/>"
                           "<to link='b'/></latch>"),
              ElementsAre(HasSubstr("'h'")));
}

TEST(ExplicitDefaults, FollowTheNotesOfTheScenario) {
  const std::vector<std::string> all =
      SceneFolder()
          .build(rigid_link("a", 2.0, 0.1) + rigid_link("b", 4.0, 0.3) +
                     "<joint name='j' type='continuous'><parent link='a'/>"
                     "<child link='b'/></joint>",
                 "[gravity]\nacceleration = [0, 0, -9.81]\n" +
                     time_table(0.1, 1e-4) + "integrator = 'splitting'\n")
          .notes;
  EXPECT_THAT(all, ElementsAre(HasSubstr("'a' falls freely"),
                               HasSubstr("splitting is explicit")));
}

}  // namespace
}  // namespace limber::scene::explicit_defaults_test
