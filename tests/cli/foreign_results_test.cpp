// SPDX-License-Identifier: BSD-3-Clause
// Results and bodies from somebody else that would show other files.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "places.hpp"
#include "support/foreign_hdf5.hpp"

namespace limber::test::foreign_results_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kSecret = "the password of somebody";

void run_scene(const Workspace& place) {
  place.write("r.urdf",
              "<robot name='r'><link name='a'><inertial><mass value='2'/>"
              "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
              "</inertial></link></robot>");
  place.write("s.toml",
              "robot = 'r.urdf'\n[output]\npictures = false\n"
              "[time]\nduration = 0.004\nstep = 0.001\n");
  place.write("secret.txt", kSecret);
  ASSERT_EQ(place.limber("run s.toml --out o").status, 0);
}

// Nor may any file hold the secret, in text or as bytes of numbers.
void expect_no_output(const Workspace& place) {
  for (const auto& entry : fs::recursive_directory_iterator(place.folder())) {
    if (!entry.is_regular_file() || entry.path().filename() == "secret.txt") {
      continue;
    }
    EXPECT_THAT(read_text(entry.path()), Not(HasSubstr(kSecret)))
        << entry.path();
  }
  EXPECT_FALSE(fs::exists(place.folder() / "a.html"));
  EXPECT_FALSE(fs::exists(place.folder() / "a.glb"));
  EXPECT_FALSE(fs::exists(place.folder() / "a.xdmf"));
  EXPECT_FALSE(fs::exists(place.folder() / "a.h5"));
}

void expect_refused(const Workspace& place, const std::string& arguments,
                    const std::string& why) {
  const CommandResult result = place.limber(arguments);
  EXPECT_EQ(result.status, 2) << arguments << result.out << result.errors;
  EXPECT_THAT(result.errors, AllOf(HasSubstr(why), Not(HasSubstr(kSecret))));
  EXPECT_THAT(result.out, Not(HasSubstr(kSecret)));
}

void expect_not_shown(const Workspace& place, const std::string& why) {
  for (const char* command :
       {"view o -o a.html", "export o -o a.glb", "export o -o a.xdmf"}) {
    expect_refused(place, command, why);
  }
  expect_no_output(place);
}

TEST(ForeignResults, ThatKeepATextInAnotherFileAreRefused) {
  const Workspace place;
  run_scene(place);
  ForeignHdf5(place.folder() / "o/results.h5")
      .store_outside("scene/name", place.folder() / "secret.txt");
  const std::string why = "'scene/name' keeps its values in another file";
  expect_not_shown(place, why);
  expect_refused(place, "info o/results.h5", why);
}

TEST(ForeignResults, ThatKeepNumbersInAnotherFileAreRefused) {
  const Workspace place;
  run_scene(place);
  ForeignHdf5(place.folder() / "o/results.h5")
      .store_outside("time", place.folder() / "secret.txt");
  const std::string why = "'time' keeps its values in another file";
  expect_not_shown(place, why);
  expect_refused(place, "info o/results.h5", why);
}

TEST(ForeignResults, ThatLinkToAnotherFileAreRefused) {
  const Workspace place;
  run_scene(place);
  fs::copy(place.folder() / "o/results.h5", place.folder() / "other.h5");
  ForeignHdf5(place.folder() / "o/results.h5")
      .link_outside("time", place.folder() / "other.h5", "/time");
  const std::string why = "'time' is a link to another file";
  expect_not_shown(place, why);
  expect_refused(place, "info o/results.h5", why);
}

TEST(ForeignResults, OfWhichAGroupIsInAnotherFileAreRefused) {
  for (const char* group : {"scene", "bodies", "scene/bodies", "events"}) {
    const Workspace place;
    run_scene(place);
    fs::copy(place.folder() / "o/results.h5", place.folder() / "other.h5");
    ForeignHdf5(place.folder() / "o/results.h5")
        .link_outside(group, place.folder() / "other.h5", group);
    expect_not_shown(place, "is a link to another file");
  }
}

TEST(ForeignResults, ThatAreViewsOfAnotherFileAreRefused) {
  const Workspace place;
  run_scene(place);
  fs::copy(place.folder() / "o/results.h5", place.folder() / "other.h5");
  ForeignHdf5(place.folder() / "o/results.h5")
      .map_virtually("time", place.folder() / "other.h5", "/time");
  expect_not_shown(place, "'time' is a virtual data set");
}

TEST(Export, RefusesNamesThatXdmfCannotHold) {
  const Workspace place;
  place.write("beam.urdf",
              "<robot name='b'><link name='beam'/><flexible link='beam'>"
              "<mesh file='" LIMBER_SOURCE_DIR
              "/meshes/beam579.msh'/><material youngs_modulus='200e9' "
              "poisson_ratio='0' density='8000'/><basis eigenmodes='6'/>"
              "</flexible></robot>");
  place.write("s.toml",
              "robot = 'beam.urdf'\n[output]\npictures = false\n"
              "[time]\nduration = 0.004\nstep = 0.001\n");
  ASSERT_EQ(place.limber("run s.toml --out o").status, 0);
  for (const char* name : {"run 10:30", "a|b", " lead", "bad\xff"}) {
    expect_refused(place, fmt::format("export o -o '{}.xdmf'", name),
                   "its name");
  }
  for (const auto& entry : fs::directory_iterator(place.folder())) {
    EXPECT_NE(entry.path().extension(), ".xdmf");
    EXPECT_NE(entry.path().extension(), ".h5");
  }
  EXPECT_EQ(place.limber("export o -o 'a & b.xdmf'").status, 0);
  EXPECT_EQ(place.limber("export o -o 'x:y.glb'").status, 0);
}

}  // namespace
}  // namespace limber::test::foreign_results_test
