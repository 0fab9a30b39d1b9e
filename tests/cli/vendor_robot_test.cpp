// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"

/// Robots of vendors, as a user meets them.
namespace limber::test::vendor_robot_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kRobot =
    "<robot name='r'>\n<link name='a'><inertial><mass value='2'/><inertia "
    "ixx='1' iyy='1' izz='{}' ixy='0' ixz='0' iyz='0'/></inertial><visual>"
    "<geometry><mesh filename='package://parts/a.obj'/></geometry></visual>"
    "</link>\n<link name='b'><inertial><mass value='1'/><inertia ixx='1' "
    "iyy='1' izz='{}' ixy='0' ixz='0' iyz='0'/></inertial></link>\n<joint "
    "name='j' type='continuous'><parent link='a'/><child link='b'/><axis "
    "xyz='0 0 1'/></joint></robot>";

class VendorRobot : public ::testing::Test {
 protected:
  VendorRobot() {
    write("1");
    place_.write("s.toml",
                 "robot = 'r.urdf'\n[output]\npictures = false\n[time]\n"
                 "duration = 0.01\nstep = 1e-3\n[gravity]\nacceleration = [0, "
                 "0, -9.81]\n[[probe]]\nname = 'z'\nlink = 'b'\n");
    std::filesystem::create_directories(place_.folder() / "far");
    place_.write("far/a.obj",
                 "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 "
                 "3\nf 2 3 4\n");
  }

  void write(const std::string& izz) const {
    place_.write("r.urdf", fmt::format(kRobot, izz, izz));
  }

  Workspace place_;
};

TEST_F(VendorRobot, FallsWithANoteUnlessItsBaseIsFixed) {
  const CommandResult falls = place_.limber("run s.toml --json --out o");
  ASSERT_EQ(falls.status, 0) << falls.errors;
  EXPECT_THAT(falls.errors, HasSubstr("note: link 'a' falls freely"));
  const json report = json::parse(falls.out);
  EXPECT_THAT(report["notes"][0].get<std::string>(),
              HasSubstr("robot.base=fixed"));
  EXPECT_NEAR(report["probes"]["z.uz"]["final"].get<double>(),
              -0.5 * 9.81 * 1e-4, 1e-12);
  const CommandResult stands =
      place_.limber("run s.toml --json --set robot.base=fixed --out o");
  ASSERT_EQ(stands.status, 0) << stands.errors;
  const json still = json::parse(stands.out);
  EXPECT_THAT(still["notes"], IsEmpty());
  EXPECT_NEAR(still["probes"]["z.uz"]["final"].get<double>(), 0.0, 1e-6);
}

TEST_F(VendorRobot, IsSaidOnceToFallByEveryCommandThatItMattersTo) {
  const std::string note = "note: link 'a' falls freely";
  const auto count = [&](const std::string& text) {
    int found = 0;
    for (std::size_t i = text.find(note); i != std::string::npos;
         i = text.find(note, i + 1)) {
      ++found;
    }
    return found;
  };
  place_.write("study.toml",
               "scenario = 's.toml'\n[design]\nkind = 'monte-carlo'\nsamples "
               "= 2\nseed = 1\n[[factor]]\nname = 'step'\npath = 'time.step'\n"
               "uniform = [5e-4, 1e-3]\n[[response]]\nname = 'z'\nprobe = "
               "'z.uz'\n");
  for (const char* command :
       {"run s.toml --out o", "static s.toml --out t", "frequencies s.toml",
        "linearize s.toml -o m.json",
        "linearize s.toml -o m.json --at "
        "equilibrium",
        "compare s.toml --out c", "study study.toml --out d"}) {
    const CommandResult falls = place_.limber(command);
    EXPECT_EQ(count(falls.errors), 1) << command << "\n" << falls.errors;
    if (std::string(command).starts_with("study")) continue;
    const CommandResult stands =
        place_.limber(std::string(command) + " --set robot.base=fixed");
    EXPECT_EQ(count(stands.errors), 0) << command << "\n" << stands.errors;
  }
  for (const char* command :
       {"frequencies s.toml --json", "linearize s.toml -o m.json --json"}) {
    const json report = json::parse(place_.limber(command).out);
    EXPECT_EQ(report["notes"].size(), 1U) << command;
  }
}

TEST_F(VendorRobot, FindsItsPackagesInEveryCommand) {
  EXPECT_THAT(place_.limber("run s.toml --out o").errors,
              AllOf(HasSubstr("1 <visual> left out of pictures"),
                    HasSubstr("--package parts=FOLDER")));
  for (const char* command :
       {"run s.toml --out o", "advise s.toml", "compare s.toml --out c",
        "linearize s.toml -o m.json", "frequencies s.toml"}) {
    const CommandResult found = place_.limber(
        std::string(command) + " --set robot.base=fixed --package parts=far");
    EXPECT_THAT(found.errors, Not(HasSubstr("package"))) << command;
  }
  EXPECT_THAT(place_.limber("run s.toml --package other=far --out o").errors,
              HasSubstr("[urdf] packages.other changes nothing"));
  EXPECT_THAT(place_.limber("run s.toml --package parts").errors,
              HasSubstr("--package 'parts' is no NAME=FOLDER"));
  const CommandResult none = place_.limber("run s.toml --package parts=none");
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.errors, HasSubstr("is not a folder"));
}

TEST_F(VendorRobot, FindsPackagesFromTheFolderOfItsScenario) {
  std::filesystem::create_directories(place_.folder() / "sub");
  place_.write("sub/r.urdf", fmt::format(kRobot, "1", "1"));
  const std::string scenario = read_text(place_.folder() / "s.toml");
  place_.write("sub/s.toml",
               scenario + "[urdf]\npackages = { parts = '../far' }\n");
  const CommandResult found =
      place_.limber("run sub/s.toml --set robot.base=fixed --out o");
  EXPECT_EQ(found.status, 0);
  EXPECT_THAT(found.errors,
              Not(AnyOf(HasSubstr("left out"), HasSubstr("changes nothing"))));
}

TEST_F(VendorRobot, HasAllItsBadInertiasToldAtOnceOrRepaired) {
  write("3");
  const CommandResult bad = place_.limber("run s.toml --out o");
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.errors,
              AllOf(HasSubstr("link 'a' at r.urdf:2"),
                    HasSubstr("link 'b' at r.urdf:3"), HasSubstr("(1, 1, 3)")));
  const CommandResult repaired =
      place_.limber("run s.toml --repair-inertia --out o");
  EXPECT_EQ(repaired.status, 0) << repaired.errors;
  EXPECT_THAT(repaired.errors,
              AllOf(HasSubstr("from ixx=1 iyy=1 izz=3 ixy=0"),
                    HasSubstr("to ixx=1.33333 iyy=1.33333 izz=2.66667")));
}

}  // namespace
}  // namespace limber::test::vendor_robot_test
