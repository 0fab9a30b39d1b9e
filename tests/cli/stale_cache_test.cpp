// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "places.hpp"

/// A geometry's second file changes between two runs, the first does not.
namespace limber::test::stale_cache_test {
namespace {

using nlohmann::json;

const std::string kHead = "SetFactory(\"OpenCASCADE\");\n";
const std::string kTail =
    "Physical Volume(\"body\") = {1};\n"
    "root() = Surface In BoundingBox {-1e-3, -1, -1, 1e-3, 1, 1};\n"
    "Physical Surface(\"root\") = root();\n"
    "Mesh.MeshSizeMax = 0.05; Mesh.ElementOrder = 1;\n";

/// How a geometry reaches its second file.
struct Reach {
  std::string name;
  std::string main_file;  ///< name of the first
  std::string text;       ///< of the first
  std::string second;     ///< its name
  std::string (*content)(double width);
};

std::string make_box(double width) {
  return fmt::format("Box(1) = {{0, {}, -0.02, 0.3, {}, 0.04}};\n",
                     -0.5 * width, width);
}
std::string make_width(double width) { return fmt::format("{}\n", width); }

const std::string kBoxOfWidth =
    "Box(1) = {0, -0.5 * w, -0.02, 0.3, w, 0.04};\n";

std::vector<Reach> list_reaches() {
  const auto by = [](const std::string& name, const std::string& line) {
    return Reach{name, "bar.geo", kHead + line + kTail, "part.geo", make_box};
  };
  return {
      by("Include", "Include \"part.geo\";\n"),
      by("Merge", "Merge 'part.geo';\n"),
      by("Sprintf", "Include Sprintf(\"part.geo\");\n"),
      by("Str", "Include Str(\"part.geo\");\n"),
      by("StrCat", "Include StrCat(\"part\", \".geo\");\n"),
      {"ListFromFile", "bar.geo",
       kHead + "l() = ListFromFile(\"w.txt\");\nw = l(0);\n" + kBoxOfWidth +
           kTail,
       "w.txt", make_width},
      {"UpperCase", "BAR.GEO", kHead + "Include \"part.geo\";\n" + kTail,
       "part.geo", make_box},
  };
}

void write_scene(const Workspace& place, const std::string& mesh) {
  place.write(
      "bar.urdf",
      fmt::format("<robot name='r'><link name='bar'/><flexible link='bar'>"
                  "<mesh file='{}'/><material youngs_modulus='70e9' "
                  "poisson_ratio='0.3' density='2700'/>"
                  "<basis eigenmodes='2'/></flexible></robot>\n",
                  mesh));
  place.write("bar.toml",
              "robot = \"bar.urdf\"\n[time]\nduration = 0.001\nstep = 1e-3\n"
              "[initial.base]\nvelocity = [1.0, 0.0, 0.0]\n"
              "[output]\npictures = false\n");
}

/// Of the body, by the kinetic energy that it has at 1 m/s.
double find_mass(const Workspace& place, const std::string& cache) {
  const CommandResult result =
      place.limber("run bar.toml --out out --cache " + cache + " --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  if (result.status != 0) return 0.0;
  return 2.0 * json::parse(result.out)["energy"]["initial"].get<double>();
}

class StaleCache : public ::testing::TestWithParam<Reach> {};

TEST_P(StaleCache, IsNotUsedAfterASecondFileChanged) {
  const Reach& reach = GetParam();
  const Workspace place(Cache::own);
  write_scene(place, reach.main_file);
  place.write(reach.main_file, reach.text);
  const auto mass_of = [](double width) { return 2700 * 0.3 * width * 0.04; };
  for (const double width : {0.04, 0.05}) {
    place.write(reach.second, reach.content(width));
    EXPECT_NEAR(find_mass(place, "cache"), mass_of(width), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Reaches, StaleCache,
                         ::testing::ValuesIn(list_reaches()),
                         [](const auto& one) { return one.param.name; });

// Missing files that were searched for may appear later.
TEST(StaleCacheOfAbsentFile, IsNotUsedAfterTheFileAppeared) {
  const Workspace place(Cache::own);
  write_scene(place, "bar.geo");
  place.write("bar.geo", kHead +
                             "If(FileExists(\"part.geo\"))\n"
                             "Include \"part.geo\";\nElse\n" +
                             make_box(0.04) + "EndIf\n" + kTail);
  EXPECT_NEAR(find_mass(place, "cache"), 2700 * 0.3 * 0.04 * 0.04, 1e-9);
  place.write("part.geo", make_box(0.05));
  EXPECT_NEAR(find_mass(place, "cache"), 2700 * 0.3 * 0.05 * 0.04, 1e-9);
}

// ShapeFromFile of a geometry in OpenCASCADE's own form.
TEST(StaleCacheOfShapes, IsNotUsedAfterTheShapeChanged) {
  const Workspace place(Cache::own);
  write_scene(place, "bar.geo");
  place.write("bar.geo",
              kHead + "v() = ShapeFromFile(\"bar.brep\");\n" + kTail);
  const auto copy = [&](const char* name) {
    place.write("bar.brep", read_text(std::string(LIMBER_SOURCE_DIR) +
                                      "/tests/data/shapes/" + name));
  };
  copy("box_40_mm.brep");
  EXPECT_NEAR(find_mass(place, "cache"), 2700 * 0.3 * 0.04 * 0.04, 1e-9);
  copy("box_50_mm.brep");
  EXPECT_NEAR(find_mass(place, "cache"), 2700 * 0.3 * 0.05 * 0.04, 1e-9);
}

json run(const Workspace& place) {
  const CommandResult result =
      place.limber("run bar.toml --out out --cache cache --json");
  EXPECT_EQ(result.status, 0) << result.errors;
  return result.status == 0 ? json::parse(result.out) : json();
}

/// For a while the mesher has no time for a mesh.
class NoTime {
 public:
  NoTime() { setenv("LIMBER_MESH_SECONDS", "1e-6", 1); }
  ~NoTime() { unsetenv("LIMBER_MESH_SECONDS"); }
  NoTime(const NoTime&) = delete;
  NoTime& operator=(const NoTime&) = delete;
};

/// Whether a run now takes its body from the cache without making a mesh.
bool makes_no_mesh(const Workspace& place) {
  const NoTime no_time;
  const CommandResult result =
      place.limber("run bar.toml --out out --cache cache --json");
  if (result.status == 2) {
    EXPECT_THAT(result.errors, ::testing::HasSubstr("meshing did not finish"));
    return false;
  }
  return json::parse(result.out)["bodies_cached"] == 1;
}

/// Whether a run now makes a mesh, finds it equal to the one before and has
/// its body from the cache.
bool makes_the_mesh_again(const Workspace& place) {
  if (makes_no_mesh(place)) return false;
  return run(place)["bodies_cached"] == 1;
}

/// A bar whose name of its second file is put together.
class Cached : public ::testing::Test {
 protected:
  Cached() {
    write_scene(place_, "bar.geo");
    place_.write("bar.geo",
                 kHead + "Include StrCat(\"part\", \".geo\");\n" + kTail);
    place_.write("part.geo", make_box(0.04));
    EXPECT_EQ(run(place_)["bodies_reduced"], 1);
  }
  Workspace place_{Cache::own};
};

TEST_F(Cached, BodyOfAComputedNameNeedsNoMesh) {
  EXPECT_TRUE(makes_no_mesh(place_));
  place_.write("part.geo", make_box(0.04));  // touched alone
  EXPECT_TRUE(makes_no_mesh(place_));
}

TEST_F(Cached, BodyIsFoundByItsMeshAfterACommentHasChanged) {
  place_.write("part.geo", "// 40 mm\n" + make_box(0.04));
  EXPECT_TRUE(makes_the_mesh_again(place_));
  EXPECT_TRUE(makes_no_mesh(place_));
}

TEST_F(Cached, BodyIsFoundByItsMeshAfterTheMesherHasChanged) {
  const auto copy = place_.folder() / "mesher";
  const auto mesher =
      std::filesystem::path(LIMBER_COMMAND).parent_path() / "limber-mesh";
  std::filesystem::copy(mesher, copy);
  setenv("LIMBER_MESHER", copy.c_str(), 1);
  EXPECT_TRUE(makes_the_mesh_again(place_));
  EXPECT_TRUE(makes_no_mesh(place_));
  std::filesystem::remove(copy);
  std::filesystem::copy(mesher, copy);  // as an installation does
  EXPECT_TRUE(makes_the_mesh_again(place_));
  unsetenv("LIMBER_MESHER");
}

TEST_F(Cached, BodyOfAGeometryThatAsksForChanceIsNeverTakenForGranted) {
  place_.write("part.geo", make_box(0.04) + "// Rand(1)\n");
  EXPECT_TRUE(makes_the_mesh_again(place_));
  EXPECT_TRUE(makes_the_mesh_again(place_));
}

TEST_F(Cached, BodyOfAGeometryThatGrowsWithTheClockIsMadeAnewInEachRun) {
  place_.write("part.geo",
               "Box(1) = {0, -0.02, -0.02, 0.3 + 1e-3 * Cpu, 0.04, 0.04};\n");
  const double first = run(place_)["energy"]["initial"];
  const json second = run(place_);
  EXPECT_EQ(second["bodies_reduced"], 1);
  EXPECT_NE(second["energy"]["initial"], first);
}

// The reduced body's mesh is one, that of level full another.
TEST_F(Cached, BodyOfAGeometryThatGrowsWithTheClockIsRefusedAtLevelFull) {
  place_.write("part.geo",
               "Box(1) = {0, -0.02, -0.02, 0.3 + 1e-3 * Cpu, 0.04, 0.04};\n");
  const CommandResult result =
      place_.limber("run bar.toml --out out --cache cache --fidelity full");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, ::testing::HasSubstr("two different meshes"));
}

/// A thin tube whose curved elements come out inverted.
const std::string kTube =
    "Cylinder(1) = {0,0,0, 0,0,0.1, 0.02};\n"
    "Cylinder(2) = {0,0,0, 0,0,0.1, 0.018};\n"
    "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n"
    "Physical Volume(\"body\") = {1};\n"
    "Mesh.MeshSizeMax = 0.01; Mesh.ElementOrder = 2;\n";

TEST(StraightEdges, AreReportedInEachRunOnceForAMesh) {
  const Workspace place(Cache::own);
  place.write("tube.geo", kHead + kTube);
  const std::string link =
      "<link name='{0}'/><flexible link='{0}'><mesh file='tube.geo'/>"
      "<material youngs_modulus='70e9' poisson_ratio='0.3' density='2700'/>"
      "<basis eigenmodes='{1}'/></flexible>";
  place.write("tube.urdf",
              "<robot name='r'>" + fmt::format(fmt::runtime(link), "a", 2) +
                  fmt::format(fmt::runtime(link), "b", 3) +
                  "<joint name='j' type='floating'><parent link='a'/>"
                  "<child link='b'/></joint></robot>\n");
  place.write("bar.toml",
              "robot = \"tube.urdf\"\n[time]\nduration = 0.001\nstep = 1e-3\n"
              "[output]\npictures = false\n");
  for (const int cached : {0, 2}) {
    const json summary = run(place);
    EXPECT_EQ(summary["bodies_cached"], cached);
    int notices = 0;
    for (const std::string text : summary["warnings"]) {
      if (text.find("all edges were made straight") != std::string::npos) {
        ++notices;
      }
    }
    EXPECT_EQ(notices, 1);
  }
}

TEST(StraightEdges, AreReportedByEveryCommandThatMakesAMesh) {
  const Workspace place(Cache::own);
  place.write("tube.geo", kHead + kTube);
  const std::string material =
      " tube.geo --youngs-modulus 70e9 --poisson-ratio 0.3 --density 2700 ";
  for (const std::string& line :
       {"reduce" + material + "--modes 1 -o body.h5",
        "modes" + material + "--count 1", std::string("info tube.geo")}) {
    const CommandResult result = place.limber(line);
    EXPECT_EQ(result.status, 0) << result.errors;
    EXPECT_THAT(result.out + result.errors,
                ::testing::HasSubstr("all edges were made straight"))
        << line;
  }
}

TEST(CacheFolder, WithoutAHomeIsAskedFor) {
  const Workspace place(Cache::own);
  write_scene(place, "bar.geo");
  place.write("bar.geo", kHead + make_box(0.04) + kTail);
  const std::string line = "cd '" + place.folder().string() +
                           "' && env -i PATH=/usr/bin:/bin '" LIMBER_COMMAND
                           "' run bar.toml --out out >stdout.txt 2>stderr.txt";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 2);
  EXPECT_THAT(read_text(place.folder() / "stderr.txt"),
              ::testing::HasSubstr("--cache"));
}

}  // namespace
}  // namespace limber::test::stale_cache_test
