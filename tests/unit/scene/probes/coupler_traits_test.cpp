// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/coupler_traits.hpp"

#include <gmock/gmock.h>

#include "limber/scene/probes/coupler_probe.hpp"
#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::coupler_traits_test {
namespace {

using test::input_error;
using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::time_table;
using ::testing::HasSubstr;

std::string joint(const std::string& name, const std::string& child,
                  const std::string& type) {
  return fmt::format(
      "<joint name='{}' type='{}'><parent link='world'/><child link='{}'/>"
      "<axis xyz='0 0 1'/><limit effort='0' velocity='0'/></joint>\n",
      name, type, child);
}

/// A coupler of every sort.
const std::string kRobot =
    kWorld + rigid_link("a", 2.0, 0.1) + rigid_link("b", 4.0, 0.3) +
    rigid_link("c", 1.0, 0.2) + rigid_link("d", 1.0, 0.2) +
    rigid_link("e", 1.0, 0.2) + joint("hinge", "a", "revolute") +
    joint("table", "b", "planar") + joint("weld", "c", "fixed") +
    joint("nothing", "d", "floating") + joint("slider", "e", "prismatic") +
    "<loop name='knuckle' kind='ball' from='a' to='b'/>\n"
    "<spring name='line' from='world' from_xyz='0 0 1' to='a' "
    "stiffness='10'/>\n"
    "<bushing name='pad' from='a' to='b' translational_stiffness='10'/>\n"
    "<latch name='grip' from='a' to='b' reach='1e-9' from_xyz='1 0 0'/>\n"
    "<tendon name='cord' tension='1'><via link='world' point='3 4 0'/>"
    "<via link='a'/></tendon>\n"
    "<gear name='rack' joint='hinge' with='slider' ratio='10'/>\n";

std::string probe(const std::string& coupler, const std::string& quantity) {
  return "[[probe]]\nname = 'p'\ncoupler = '" + coupler + "'\nquantity = '" +
         quantity + "'\n";
}

TEST(CouplerTraits, AreThoseOfTheCouplersThatAreMade) {
  const SceneFolder folder;
  const Scene scene = folder.load(kRobot, time_table(0.1, 1e-3));
  const dynamics::SystemModel model = folder.build(scene).model;
  std::size_t made = 0;
  for (const CouplerTraits& traits : find_coupler_traits(scene.robot)) {
    if (!traits.why_none.empty()) continue;
    SCOPED_TRACE(traits.name);
    const CouplerProbe of =
        make_coupler_probe({traits.name, CouplerQuantity::energy}, model);
    EXPECT_EQ(of.transmission >= 0, !traits.has_frames);
    EXPECT_EQ(of.coordinates.size(),
              static_cast<std::size_t>(traits.coordinates));
    ++made;
  }
  EXPECT_EQ(made, 9U);
  EXPECT_EQ(made, model.couplers.size() + model.transmissions.size());
}

TEST(CouplerTraits, ProbesOfWhatIsNotThereAreRefusedBeforeAnythingIsMade) {
  const SceneFolder folder;
  const auto error = [&](const std::string& coupler,
                         const std::string& quantity) {
    return input_error([&] {
      (void)folder.load(kRobot,
                        time_table(0.1, 1e-3) + probe(coupler, quantity));
    });
  };
  EXPECT_THAT(error("hnige", "coordinate"),
              HasSubstr("probe 'p': unknown coupler 'hnige'; did you mean "
                        "'hinge'"));
  EXPECT_THAT(error("weld", "force"),
              HasSubstr("joins two rigid links into one body"));
  EXPECT_THAT(error("nothing", "force"), HasSubstr("leaves everything free"));
  EXPECT_THAT(error("grip", "coordinate"),
              HasSubstr("leaves no coordinate free"));
  EXPECT_THAT(error("cord", "force"), HasSubstr("joins no two frames"));
}

// A drive, a stop and their probes, defined in files only: a ramp to 0.5 rad,
// stiff enough that the hinge follows it to d = M / k = 1e-3 rad against a
// moment of 1 N m.
TEST(CouplerTraits, DriveOfAScenarioHoldsAgainstALoad) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      kWorld + rigid_link("a", 2.0, 0.1) + joint("hinge", "a", "revolute"),
      time_table(3.0, 1e-3) +
          "[[drive]]\njoint = 'hinge'\nmode = 'position'\nstiffness = 1e3\n"
          "damping = 10.0\nsignal = { kind = 'ramp', to = 0.5, duration = 1.0, "
          "shape = 'smooth' }\n"
          "[[load]]\nname = 'm'\nlink = 'a'\nmoment = [0.0, 0.0, 1.0]\n"
          "time = { kind = 'constant' }\n" +
          probe("hinge", "coordinate") +
          "[[probe]]\nname = 'e'\ncoupler = 'hinge'\nquantity = 'effort'\n");
  const std::vector<double> end = test::simulate_probes(built);
  EXPECT_NEAR(end.at(0), 0.501, 1e-9);
  EXPECT_NEAR(end.at(1), -1.0, 1e-6);
}

}  // namespace
}  // namespace limber::scene::coupler_traits_test
