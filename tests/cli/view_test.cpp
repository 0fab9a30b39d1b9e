// SPDX-License-Identifier: BSD-3-Clause
// What limber view and limber export refuse, and the scenes that need no page.
// tests/view/ looks at pages.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/results/scenery.hpp"
#include "places.hpp"

namespace limber::test::view_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

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
                    const ::testing::Matcher<std::string>& why) {
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

// The face of a group has triangles, which are not the link.
TEST(View, NamesLinksWhoseSurfaceWasKeptInPart) {
  const Workspace place;
  write_scene(place, "tip");
  run(place);
  expect_refused(place, "view o",
                 AllOf(HasSubstr("not all nodes on the surface of link 'beam'"),
                       HasSubstr("rows=\"boundary\"")));
}

// A copy of the command has no page beside it.
TEST(View, RefusesARunWhosePageIsMissingBeforeItsFirstStep) {
  const Workspace place;
  write_scene(place, "boundary");
  const CommandResult result =
      run_shell(place, "cp '" LIMBER_COMMAND
                       "' own && ./own run beam.toml --out o --view");
  EXPECT_EQ(result.status, 2) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("was not found; looked for"));
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "o"));
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
  expect_refused(place, "view o nothing", HasSubstr("no such file or folder"));
  expect_refused(place, "export o -o a.obj", HasSubstr(".glb"));
  expect_refused(place, "export o -o no/such/a.glb", HasSubstr("a.glb"));
  expect_refused(place, "export o -o a.glb --magnification 0",
                 HasSubstr("magnification"));
}

TEST(View, ShowsTheKeptRunsOfAComparison) {
  const Workspace place;
  write_scene(place, "boundary");
  const std::string compare =
      "compare beam.toml --repeat 1 --fidelity rigid,coupled --out ";
  ASSERT_EQ(place.limber(compare + "kept --reference coupled").status, 0);
  const CommandResult shown = place.limber("view kept -o kept.html");
  if (shown.status != 0) {
    // Without node the build has no page.
    EXPECT_THAT(shown.errors, HasSubstr("view.html"));
  } else {
    EXPECT_TRUE(std::filesystem::exists(place.folder() / "kept.html"));
  }
  ASSERT_EQ(
      place.limber(compare + "bare --modes 2,4 --reference coupled").status, 0);
  expect_refused(place, "view bare", HasSubstr("limber compare --keep"));
}

/// Results of one body at two outputs, the second of which has this time.
void write_results(const Workspace& place, double end, const std::string& level,
                   double w) {
  Hdf5File out = Hdf5File::create(place.folder() / "results.h5");
  out.write("format", "limber results", "");
  out.write("scene/version",
            std::vector<std::int64_t>{results::kSceneryVersion}, "-", "");
  out.write("scene/name", "s", "");
  out.write("scene/limber", "1", "");
  out.write("time", Eigen::Vector2d(0.0, end), "s", "");
  out.write("scene/bodies/b/place", std::vector<std::int64_t>{0}, "1", "");
  out.write("scene/bodies/b/mass", MatrixX::Ones(1, 1), "kg", "");
  out.write("scene/bodies/b/inertia", MatrixX::Identity(3, 3), "kg m^2", "");
  out.write("bodies/b/fidelity", level, "");
  MatrixX quat = MatrixX::Zero(2, 4);
  quat.col(0) << 1.0, w;
  out.write("bodies/b/quat_WB", quat, "1", "");
  for (const char* name : {"p_WB", "v_WB_W", "w_WB_B"}) {
    out.write(std::string("bodies/b/") + name, MatrixX::Zero(2, 3), "m", "");
  }
  out.close();
}

TEST(View, RefusesResultsThatAreDamaged) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  struct Damage {
    double end = 1.0;
    std::string level = "rigid";
    double w = 1.0;
    std::string why;
  };
  const std::vector<Damage> all = {
      {.end = std::numeric_limits<double>::quiet_NaN(),
       .why = "is damaged: 'time' has a value that is NaN or infinity"},
      {.end = kInfinity, .why = "has a value that is NaN or infinity"},
      {.end = 1e300, .why = "cannot be drawn: 'time' has a value beyond"},
      {.end = -1.0, .why = "is damaged: output 2 is at -1 s, not after 0 s"},
      {.end = 0.0, .why = "is damaged: output 2 is at 0 s, not after 0 s"},
      {.level = "coupled", .why = "flexible link 'b' has no surface"},
      {.w = 0.0, .why = "'bodies/b/quat_WB' is not a rotation"}};
  for (const Damage& damage : all) {
    const Workspace place;
    write_results(place, damage.end, damage.level, damage.w);
    for (const char* command :
         {"view results.h5 -o a.html", "export results.h5 -o a.glb",
          "export results.h5 -o a.xdmf"}) {
      expect_refused(place, command, HasSubstr(damage.why));
    }
  }
}

TEST(View, LeavesTheResultsAlone) {
  const Workspace place;
  write_scene(place, "boundary");
  run(place);
  expect_refused(place, "view o -o o/results.h5",
                 HasSubstr("would replace the results"));
  EXPECT_EQ(place.limber("info o/results.h5").status, 0);
}

// glTF has single precision.
TEST(Export, RefusesAMagnificationBeyondItsNumbers) {
  const Workspace place;
  write_scene(place, "boundary");
  run(place);
  expect_refused(place, "export o -o a.glb --magnification 1e300",
                 HasSubstr("single precision"));
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "a.glb"));
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

constexpr const char* kRigidRobot =
    "<robot name='r'><link name='a'><inertial><mass value='2'/><inertia "
    "ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>{}</link>"
    "</robot>";
constexpr const char* kRigidScenario =
    "robot = 'r.urdf'\n[output]\npictures = false\n[time]\nduration = 0.01\n"
    "step = 0.001\n[[load]]\nname = 'f'\nlink = 'a'\npoint = [0, 0, 0]\n"
    "force = [1, 0, 0]\nframe = 'world'\ntime = { kind = 'constant' }\n";
constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 "
    "4\n";

std::string show_mesh(const std::string& file) {
  return fmt::format(kRigidRobot,
                     "<visual><origin xyz='0 0 1'/><geometry><mesh filename='" +
                         file + "' scale='0.1 0.1 0.1'/></geometry></visual>");
}

TEST(View, ShowsMeshFilesOfRigidLinksWithoutTheseFiles) {
  const Workspace place;
  place.write("r.urdf", show_mesh("package://arm/parts/a.obj"));
  std::filesystem::create_directories(place.folder() / "arm/parts");
  place.write("arm/parts/a.obj", kTetrahedron);
  place.write("s.toml", kRigidScenario);
  const CommandResult run = place.limber("run s.toml --out o");
  ASSERT_EQ(run.status, 0) << run.errors;
  std::filesystem::remove_all(place.folder() / "arm");
  ASSERT_EQ(place.limber("export o -o a.glb").status, 0);
  const json scene = read_gltf(read_text(place.folder() / "a.glb"));
  const json& primitive = scene["meshes"][0]["primitives"][0];
  const json& positions =
      scene["accessors"][primitive["attributes"]["POSITION"].get<int>()];
  EXPECT_EQ(positions["count"], 4);
  const std::vector<double> most = {0.1, 0.2, 1.3};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(positions["max"][c].get<double>(), most[c], 1e-6);
  }
}

TEST(View, LeavesOutMeshesThatCannotBeReadWithOneWarning) {
  const Workspace place;
  place.write("s.toml", kRigidScenario);
  place.write("damaged.stl", "no mesh");
  place.write("odd.blend", "x");
  const std::pair<const char*, const char*> cases[] = {
      {"none/such.stl", "none/such.stl"},
      {"package://none/such.stl", "there is no none/such.stl"},
      {"damaged.stl", "neither a text"},
      {"odd.blend", "expected a file .stl, .obj or .dae"}};
  for (const auto& [file, why] : cases) {
    place.write("r.urdf", show_mesh(file));
    const CommandResult run = place.limber("run s.toml --out o");
    EXPECT_EQ(run.status, 0) << run.errors;
    EXPECT_THAT(run.errors,
                AllOf(HasSubstr("limber: warning: "), HasSubstr(why)));
    EXPECT_EQ(place.limber("view o").status, 0);
  }
}

TEST(Export, ForParaViewLeavesTheResultsAlone) {
  const Workspace place;
  write_scene(place, "boundary");
  run(place);
  expect_refused(place, "export o -o o/results.xdmf",
                 HasSubstr("would replace the results"));
  expect_refused(place, "export o -o m.xdmf --magnification 2",
                 HasSubstr("Warp By Vector"));
  ASSERT_EQ(place.limber("export o -o m.xdmf").status, 0);
  EXPECT_THAT(read_text(place.folder() / "m.xdmf"),
              AllOf(HasSubstr("m.h5:/steps/000004/displacement"),
                    HasSubstr("deformation_vector")));
  EXPECT_TRUE(std::filesystem::exists(place.folder() / "m.h5"));
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
  // Weights, rotation and two translations of the beam, which moves by 0.2 mm
  // at 2.5 m from the origin; the ball rests.
  EXPECT_EQ(scene["animations"][0]["channels"].size(), 5U);
  std::vector<std::string> names;
  for (const json& node : scene["nodes"]) names.push_back(node["name"]);
  EXPECT_THAT(names,
              ::testing::ElementsAre("beam", "beam (coarse)", "beam", "ball"));
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
}  // namespace limber::test::view_test
