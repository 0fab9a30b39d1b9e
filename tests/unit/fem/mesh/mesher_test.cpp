// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/mesher.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "support/sanitized.hpp"
#include "unit/fem/meshes.hpp"

/// A geometry is a program of whoever wrote it. Here are those that do harm.
namespace limber::fem::mesher_test {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using testing::write_file;

const std::string kBox =
    "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n"
    "Physical Volume(\"body\") = {1};\nMesh.MeshSizeMax = 0.5;\n";

std::size_t count_files(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// The error that the text gives, which must leave nothing behind.
std::string find_error(const std::string& text, double seconds = 20.0,
                       double gibibytes = 2.0) {
  const std::filesystem::path file = write_file("evil.geo", text);
  const std::size_t before = count_files(file.parent_path());
  Mesher mesher = find_mesher();
  mesher.seconds = seconds;
  mesher.memory = static_cast<std::uint64_t>(gibibytes * (1ULL << 30));
  std::string error;
  try {
    static_cast<void>(read_mesh(file, {}, mesher));
    ADD_FAILURE() << "accepted: " << text;
  } catch (const InputError& refusal) {
    error = refusal.what();
  }
  EXPECT_EQ(count_files(file.parent_path()), before) << text;
  EXPECT_THAT(error, HasSubstr("evil.geo"));
  return error;
}

TEST(Mesher, RefusesAGeometryThatRunsAProgram) {
  const std::string canary = testing::make_test_folder() / "canary";
  for (const std::string word :
       {"SystemCall", "System", "NonBlockingSystemCall"}) {
    EXPECT_THAT(
        find_error(fmt::format("{} \"touch {}\";\n{}", word, canary, kBox)),
        HasSubstr("tries to run a program"));
    EXPECT_THAT(find_error(fmt::format("{}{} \"sleep 100 &\";\n", kBox, word)),
                HasSubstr("tries to run a program"));
  }
  EXPECT_THAT(find_error(fmt::format("OnelabRun(\"touch\", \"{}\");", canary)),
              HasSubstr("tries to"));
}

TEST(Mesher, RefusesAGeometryThatWritesAFile) {
  const std::filesystem::path folder = testing::make_test_folder();
  const std::string canary = folder / "canary.msh";
  for (const std::string text :
       {"Printf(\"x\") > \"{}\";", "Printf(\"x\") >> \"{}\";", "Save \"{}\";",
        "Print \"{}\";", "CreateDir \"{}\";"}) {
    EXPECT_THAT(
        find_error(kBox + fmt::format(fmt::runtime(text), canary) + "\n"),
        AnyOf(HasSubstr("tries to"), HasSubstr("Gmsh cannot")))
        << text;
  }
  // Existing files do not change.
  const auto victim = write_file("victim", "old");
  find_error(fmt::format("{}Printf(\"x\") > \"{}\";", kBox, victim.string()));
  EXPECT_EQ(std::filesystem::file_size(victim), 3U);
}

TEST(Mesher, RefusesAPipeOrADevice) {
  const std::string pipe = testing::make_test_folder() / "pipe";
  std::filesystem::remove(pipe);  // that a killed test left
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& name : {pipe, std::string("/dev/zero")}) {
    EXPECT_THAT(find_error("Merge \"" + name + "\";"),
                AllOf(HasSubstr("tries to read"), HasSubstr(name)));
  }
  std::filesystem::remove(pipe);
}

TEST(Mesher, TellsOfAGeometryThatEndsGmsh) {
  EXPECT_THAT(find_error(kBox + "Exit;"), HasSubstr("Exit"));
}

TEST(Mesher, EndsWhatTakesTooLong) {
  const auto start = std::chrono::steady_clock::now();
  for (const std::string text :
       {"Sleep 1000;\n", "a() = {0:1e12:1};\n",
        "For i In {1:1000000000}\n x = i;\nEndFor\n"}) {
    EXPECT_THAT(find_error(text + kBox, 1.0),
                AllOf(HasSubstr("did not finish within 1 s"),
                      HasSubstr("LIMBER_MESH_SECONDS")))
        << text;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
}

TEST(Mesher, EndsWhatTakesTooMuchMemory) {
  if (test::kIsSanitized) GTEST_SKIP() << "sets limits";
  EXPECT_THAT(
      find_error(kBox + "Transfinite Curve {1:12} = 200000000;\n", 60.0, 1.0),
      AllOf(HasSubstr("the 1 GiB of memory"), HasSubstr("LIMBER_MESH_MEMORY")));
}

TEST(Mesher, SurvivesMacrosThatCallThemselves) {
  EXPECT_THAT(find_error("Macro M\n Call M;\nReturn\nCall M;\n", 5.0),
              AnyOf(HasSubstr("did not finish"), HasSubstr("signal"),
                    HasSubstr("memory"), HasSubstr("Gmsh cannot")));
}

TEST(Mesher, KeepsItsThreadsWhateverAFileAsks) {
  for (const std::string option :
       {"General.NumThreads", "Mesh.MaxNumThreads1D", "Mesh.MaxNumThreads3D"}) {
    const auto file =
        write_file("threads.geo", kBox + option + " = 100000;\nMesh 3;\n");
    EXPECT_GT(read_mesh(file).element_count(), 0U) << option;
  }
}

TEST(Mesher, SurvivesANodeTagOfMinusOne) {
  const std::string text = testing::unit_tetrahedron().str();
  std::string damaged = text;
  const std::size_t at = damaged.find("$Nodes\n4\n1 ");
  ASSERT_NE(at, std::string::npos);
  damaged.replace(at, 11, "$Nodes\n4\n-1 ");
  try {
    (void)read_mesh(write_file("minus.msh", damaged));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("minus.msh"));
  }
}

TEST(Mesher, SeesNoEnvironmentAndNoWorkingFolder) {
  setenv("LIMBER_TEST_SIZE", "0.1", 1);
  const auto file =
      write_file("env.geo", kBox +
                                "If(StrLen(GetEnv(\"LIMBER_TEST_SIZE\")) > 0)\n"
                                "Mesh.MeshSizeMax = 0.1;\nEndIf\n");
  const Mesh with = read_mesh(file);
  unsetenv("LIMBER_TEST_SIZE");
  EXPECT_EQ(find_mesh_content(with), find_mesh_content(read_mesh(file)));
}

TEST(Mesher, IsAskedForByAnEnvironmentThatMakesSense) {
  for (const char* name : {"LIMBER_MESH_SECONDS", "LIMBER_MESH_MEMORY"}) {
    for (const char* value : {"", "-1", "0", "nan", "1s"}) {
      setenv(name, value, 1);
      EXPECT_THROW((void)find_mesher(), InputError) << name << '=' << value;
    }
    unsetenv(name);
  }
  setenv("LIMBER_MESH_SECONDS", "7.5", 1);
  setenv("LIMBER_MESH_MEMORY", "0.5", 1);
  EXPECT_EQ(find_mesher().seconds, 7.5);
  EXPECT_EQ(find_mesher().memory, 1ULL << 29);
  unsetenv("LIMBER_MESH_SECONDS");
  unsetenv("LIMBER_MESH_MEMORY");
}

/// What the mesher says that a mesh depends on.
class TracedFiles : public ::testing::Test {
 protected:
  TracedMesh read(const std::string& text) {
    return read_traced_mesh(write_file("main.geo", text), {}, find_mesher());
  }
  static bool has(const TracedMesh& mesh, const std::string& name,
                  const std::string& mark) {
    return std::any_of(
        mesh.files.begin(), mesh.files.end(), [&](const FileStamp& file) {
          return file.path.filename() == name && file.mark.starts_with(mark);
        });
  }
};

TEST_F(TracedFiles, AreAllThatWereOpenedHoweverTheyWereNamed) {
  write_file("part.geo", "Mesh.MeshSizeMax = 0.5;\n");
  write_file("list.txt", "1 2 3\n");
  for (const std::string text :
       {"Include \"part.geo\";", "Merge \"part.geo\";",
        "Include Sprintf(\"part.geo\");", "Include Str(\"part.geo\");",
        "Include StrCat(\"part\", \".geo\");"}) {
    const TracedMesh mesh = read(kBox + text + "\n");
    EXPECT_TRUE(has(mesh, "part.geo", "content ")) << text;
    EXPECT_TRUE(mesh.is_repeatable) << text;
  }
  EXPECT_TRUE(has(read(kBox + "l() = ListFromFile(\"list.txt\");\n"),
                  "list.txt", "content "));
}

TEST_F(TracedFiles, HaveThoseThatAreMissingAndTheLibraries) {
  const TracedMesh mesh =
      read(kBox +
           "If(FileExists(\"later.geo\"))\nInclude \"later.geo\";\n"
           "EndIf\n");
  EXPECT_TRUE(has(mesh, "later.geo", "absent"));
  EXPECT_TRUE(has(mesh, "main.geo", "content "));
  EXPECT_TRUE(has(mesh, "limber-mesh", "version "));
  EXPECT_TRUE(std::any_of(
      mesh.files.begin(), mesh.files.end(), [](const FileStamp& file) {
        return file.path.string().find("libgmsh") != std::string::npos &&
               file.mark.starts_with("version ");
      }));
}

TEST_F(TracedFiles, AreNotEnoughForWhatAsksTheClock) {
  EXPECT_TRUE(read(kBox).is_repeatable);
  for (const std::string word :
       {"Cpu", "Memory", "TotalMemory", "Mesh.CpuTime"}) {
    EXPECT_FALSE(read(kBox + "x = " + word + ";\n").is_repeatable) << word;
  }
}

}  // namespace
}  // namespace limber::fem::mesher_test
