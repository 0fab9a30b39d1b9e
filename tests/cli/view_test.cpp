// SPDX-License-Identifier: BSD-3-Clause
// What limber view and limber export refuse, and the scenes that need no page.
// tests/view/ looks at pages.
#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"

namespace limber::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kScenario =
    "robot = 'beam.urdf'\n[output]\npictures = false\n"
    "[time]\nduration = 0.004\nstep = 0.001\n"
    "[[load]]\nname = 'push'\nlink = 'beam'\nnode = 5\n"
    "force = [1e6, 0.0, 0.0]\ntime = { kind = 'constant' }\n"
    "[[projectile]]\nname = 'ball'\nradius = 0.1\nmass = 1.0\n"
    "position = [0.0, 0.0, -2.0]\n";

void write_scene(const Workspace& place, const std::string& rows) {
  place.write("beam.urdf",
              "<robot name='b'><link name='beam'/><flexible link='beam'>"
              "<mesh file='" LIMBER_SOURCE_DIR
              "/meshes/beam579.msh'/><material youngs_modulus='200e9' "
              "poisson_ratio='0' density='8000'/><basis eigenmodes='6' "
              "rows='" +
                  rows + "'/></flexible></robot>");
  place.write("beam.toml", kScenario);
}

void run(const Workspace& place, const std::string& more = "") {
  const CommandResult result = place.limber("run beam.toml --out o" + more);
  ASSERT_EQ(result.status, 0) << result.errors;
}

void expect_refused(const Workspace& place, const std::string& arguments,
                    const testing::Matcher<std::string>& why) {
  const CommandResult result = place.limber(arguments);
  EXPECT_EQ(result.status, 2) << result.errors;
  EXPECT_THAT(result.errors, why);
}

/// The JSON of a binary glTF file.
json read_gltf(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  return json::parse(bytes.substr(20, length), nullptr, false);
}

TEST(View, NamesLinksWhoseSurfaceWasNotKept) {
  const Workspace place;
  write_scene(place, "interfaces");
  run(place);
  const auto why =
      AllOf(HasSubstr("link 'beam'"), HasSubstr("rows=\"boundary\""),
            HasSubstr("limber reduce --rows boundary"));
  expect_refused(place, "view o", why);
  expect_refused(place, "export o -o a.glb", why);
}

TEST(View, RefusesWhatIsNoResult) {
  const Workspace place;
  write_scene(place, "boundary");
  expect_refused(place, "view nothing", HasSubstr("no such file or folder"));
  expect_refused(place, "view .", HasSubstr("it has no results.h5"));
  expect_refused(place, "view beam.toml", HasSubstr("beam.toml"));
  run(place);
  expect_refused(place, "view o --with nothing",
                 HasSubstr("no such file or folder"));
  expect_refused(place, "export o -o a.obj", HasSubstr(".glb"));
  expect_refused(place, "export o -o no/such/a.glb", HasSubstr("a.glb"));
  expect_refused(place, "export o -o a.glb --magnification 0",
                 HasSubstr("magnification"));
}

TEST(View, TellsAReducedBodyFromResults) {
  const Workspace place;
  ASSERT_EQ(place
                .limber("reduce " LIMBER_SOURCE_DIR
                        "/meshes/beam579.msh -o b.h5 --youngs-modulus 2e11 "
                        "--poisson-ratio 0 --density 8000")
                .status,
            0);
  expect_refused(place, "view b.h5",
                 HasSubstr("is not a results file of Limber's"));
}

// One surface, one output: nothing to animate.
TEST(Export, OfAStaticEquilibriumIsStill) {
  const Workspace place;
  const CommandResult found = place.limber(
      "static " LIMBER_SOURCE_DIR
      "/examples/pendulum_chain.toml --fidelity rigid --method relaxation "
      "--out s");
  ASSERT_EQ(found.status, 0) << found.errors;
  const CommandResult result = place.limber("export s -o a.glb");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json scene = read_gltf(read_text(place.folder() / "a.glb"));
  EXPECT_FALSE(scene.contains("animations"));
  EXPECT_GT(scene["meshes"].size(), 1U);
}

TEST(Export, WritesModesOfFlexibleLinksAndMotionOfAll) {
  const Workspace place;
  write_scene(place, "boundary");
  run(place);
  const CommandResult result = place.limber("export o -o a.glb");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json scene = read_gltf(read_text(place.folder() / "a.glb"));
  ASSERT_EQ(scene["meshes"].size(), 2U);
  // Six eigenmodes and the static-deformation mode of the load.
  EXPECT_EQ(scene["meshes"][0]["primitives"][0]["targets"].size(), 7U);
  EXPECT_EQ(scene["animations"][0]["channels"].size(), 5U);
  EXPECT_EQ(scene["nodes"][2]["name"], "ball");
}

// Products of modes move it, too, so its shapes are those of its motion.
TEST(Export, OfALinkAtLevelNonlinearHasShapesOfItsMotion) {
  const Workspace place;
  const CommandResult found =
      place.limber("run " LIMBER_SOURCE_DIR
                   "/examples/spin_up.toml --set time.duration=0.5 --out s");
  ASSERT_EQ(found.status, 0) << found.errors;
  const CommandResult result = place.limber("export s -o a.glb");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json scene = read_gltf(read_text(place.folder() / "a.glb"));
  EXPECT_TRUE(scene.contains("animations"));
  EXPECT_GT(scene["meshes"].size(), 0U);
}

TEST(Export, OfRigidLinksHasNoModes) {
  const Workspace place;
  write_scene(place, "boundary");
  run(place, " --fidelity rigid");
  ASSERT_EQ(place.limber("export o -o a.glb").status, 0);
  const json scene = read_gltf(read_text(place.folder() / "a.glb"));
  EXPECT_FALSE(scene["meshes"][0]["primitives"][0].contains("targets"));
  EXPECT_EQ(scene["animations"][0]["channels"].size(), 4U);
}

}  // namespace
}  // namespace limber::test
