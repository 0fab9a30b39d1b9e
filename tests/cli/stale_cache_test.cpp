// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"

/// A geometry's second file changes between two runs, the first does not.
namespace limber::test {
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
  const Workspace place;
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

// What is looked for and not there may appear.
TEST(StaleCacheOfAbsentFile, IsNotUsedAfterTheFileAppeared) {
  const Workspace place;
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
  const Workspace place;
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

TEST(CacheFolder, WithoutAHomeIsAskedFor) {
  const Workspace place;
  write_scene(place, "bar.geo");
  place.write("bar.geo", kHead + make_box(0.04) + kTail);
  const std::string line = "cd '" + place.folder().string() +
                           "' && env -i PATH=/usr/bin:/bin '" LIMBER_COMMAND
                           "' run bar.toml --out out >stdout.txt 2>stderr.txt";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 2);
  EXPECT_THAT(read_text(place.folder() / "stderr.txt"),
              testing::HasSubstr("--cache"));
}

}  // namespace
}  // namespace limber::test
