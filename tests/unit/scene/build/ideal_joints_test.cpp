// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

/// Which joints of a scene are ideal.
namespace limber::scene::ideal_joints_test {
namespace {

using test::input_error;
using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::time_table;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A shoulder and an elbow; what else is in the file comes as `more`.
std::string make_arm(const std::string& more = "") {
  const auto joint = [](const std::string& name, const std::string& parent,
                        const std::string& child) {
    return "<joint name='" + name + "' type='continuous'><parent link='" +
           parent + "'/><child link='" + child +
           "'/><origin xyz='0.2 0 0'/><axis xyz='0 1 0'/></joint>\n";
  };
  return kWorld + rigid_link("upper", 1.0, 0.5, "0.5 0 0") +
         rigid_link("lower", 1.0, 0.5, "0.5 0 0") +
         joint("shoulder", "world", "upper") +
         joint("elbow", "upper", "lower") + more;
}

const std::string kIdeal = "[robot]\nfile = 'r.urdf'\njoint = 'ideal'\n";
const std::string kStiff = "[robot]\nfile = 'r.urdf'\n";

class IdealJoints : public ::testing::Test {
 protected:
  [[nodiscard]] Scene load(const std::string& links, const std::string& robot,
                           const std::string& rest = time_table(0.1, 1e-3),
                           const std::vector<Setting>& settings = {}) const {
    std::ofstream(folder_.path() / "r.urdf") << "<robot name='r'>\n"
                                             << links << "</robot>\n";
    std::ofstream(folder_.path() / "s.toml") << rest << robot;
    return load_scene(folder_.path() / "s.toml", {.settings = settings});
  }

  /// Names of the ideal couplers.
  [[nodiscard]] std::vector<std::string> find_ideal(const Scene& scene) const {
    std::vector<std::string> names;
    const BuiltScene built = folder_.build(scene);
    for (const dynamics::Coupler& coupler : built.model.couplers) {
      if (joints::is_ideal(coupler.law)) names.push_back(coupler.name);
    }
    return names;
  }

  SceneFolder folder_;
};

TEST_F(IdealJoints, AreAllOfARobotOrThoseThatItsFileNames) {
  EXPECT_THAT(find_ideal(load(make_arm(), kStiff)), IsEmpty());
  EXPECT_THAT(find_ideal(load(make_arm(), kIdeal)),
              ElementsAre("shoulder", "elbow"));
  EXPECT_THAT(find_ideal(load(make_arm("<coupler joint='elbow' ideal='true'/>"),
                              kStiff)),
              ElementsAre("elbow"));
  EXPECT_THAT(find_ideal(load(
                  make_arm("<coupler joint='elbow' ideal='false'/>"), kIdeal)),
              ElementsAre("shoulder"));
  EXPECT_THAT(find_ideal(load(make_arm(), kStiff, time_table(0.1, 1e-3),
                              {{"robot.joint", "ideal"}})),
              ElementsAre("shoulder", "elbow"));
  EXPECT_THAT(find_ideal(load(make_arm(), kStiff, time_table(0.1, 1e-3),
                              {{"robot.joint.shoulder.ideal", "true"}})),
              ElementsAre("shoulder"));
}

TEST_F(IdealJoints, LeaveElasticOnesThatTheRobotsFileDescribes) {
  const Scene scene =
      load(make_arm("<coupler joint='elbow' rotational_damping='3'/>"), kIdeal);
  EXPECT_THAT(find_ideal(scene), ElementsAre("shoulder"));
  EXPECT_THAT(scene.scenario.warnings,
              ElementsAre(HasSubstr("leaves 1 of 2 joints elastic")));
  EXPECT_THAT(load(make_arm(), kIdeal).scenario.warnings, IsEmpty());
}

TEST_F(IdealJoints, AreThoseOfOneRobotOfSeveral) {
  const std::string two =
      "[[robot]]\nname = 'A'\nfile = 'r.urdf'\njoint = 'ideal'\n"
      "[[robot]]\nname = 'B'\nfile = 'r.urdf'\nposition = [0, 3, 0]\n";
  EXPECT_THAT(find_ideal(load(make_arm(), two)),
              ElementsAre("A.shoulder", "A.elbow"));
}

TEST_F(IdealJoints, AreRefusedByNameWithWhatContradictsThem) {
  const auto error = [&](const std::string& more, const std::string& robot) {
    return input_error(
        [&] { (void)folder_.build(load(make_arm(more), robot)); });
  };
  EXPECT_THAT(
      error("<coupler joint='elbow' ideal='true' rotational_stiffness='1'/>",
            kStiff),
      HasSubstr("an ideal joint does not deflect"));
  EXPECT_THAT(error("<coupler joint='elbow' ideal='yes'/>", kStiff),
              HasSubstr("ideal"));
  EXPECT_THAT(error("", "[robot]\nfile = 'r.urdf'\njoint = 'perfect'\n"),
              HasSubstr("unknown joint 'perfect'"));
  EXPECT_THAT(error("<loop name='l' kind='ball' ideal='true'><from "
                    "link='world'/><to link='lower'/></loop>",
                    kStiff),
              HasSubstr("ideal"));
}

}  // namespace
}  // namespace limber::scene::ideal_joints_test
