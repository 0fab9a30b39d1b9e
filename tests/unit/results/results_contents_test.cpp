// SPDX-License-Identifier: BSD-3-Clause
// What a results file is said to contain, and names in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "limber/common/files/hdf5_file.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/results/results_file.hpp"
#include "unit/results/small_run.hpp"
#include "unit/results/temporary_folder.hpp"

namespace limber::results::results_contents_test {
namespace {

using test::find_input_error;
using test::kOutputs;
using test::make_empty_run;
using test::make_small_run;
using test::SmallRun;
using test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

TEST(ResultsFile, ContentsTellTimesBodiesAndProbes) {
  const SmallRun run = make_small_run();
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  EXPECT_TRUE(is_results_file(file));
  const ResultsContents contents = read_contents(file);
  EXPECT_EQ(contents.outputs, kOutputs);
  EXPECT_EQ(contents.start, 0.0);
  EXPECT_EQ(contents.end, run.history.times.back());
  EXPECT_THAT(contents.bodies,
              UnorderedElementsAre("arm", "hand", "plate", "ball"));
  EXPECT_THAT(contents.probes, UnorderedElementsAre("tip.ux", "tip.wy"));
}

TEST(ResultsFile, ContentsOfARunWithoutOutputsNameBodiesAndProbes) {
  const SmallRun run = make_empty_run();
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  EXPECT_TRUE(is_results_file(file));
  const ResultsContents contents = read_contents(file);
  EXPECT_EQ(contents.outputs, 0);
  EXPECT_EQ(contents.start, 0.0);
  EXPECT_EQ(contents.end, 0.0);
  EXPECT_THAT(contents.bodies,
              UnorderedElementsAre("arm", "hand", "plate", "ball"));
  EXPECT_THAT(contents.probes, UnorderedElementsAre("tip.ux", "tip.wy"));
}

TEST(ResultsFile, RunWithoutProbesHasNone) {
  SmallRun run = make_small_run();
  run.history.columns.clear();
  run.history.probe_rows =
      std::vector<std::vector<double>>(run.history.times.size());
  const TemporaryFolder folder;
  write_results(folder.path() / "r.h5", run.model, run.history);
  EXPECT_THAT(read_contents(folder.path() / "r.h5").probes, IsEmpty());
}

TEST(ResultsFile, ReducedBodyIsNoResultsFile) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "body.h5";
  flexbody::write_body(make_empty_run().points[0].reduced, file);
  EXPECT_FALSE(is_results_file(file));
  EXPECT_THAT(find_input_error([&] { (void)read_contents(file); }),
              HasSubstr(file.string()));
}

TEST(ResultsFile, TextIsRefusedWithTheFilesName) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "notes.h5";
  std::ofstream(file) << "limber results\n";
  EXPECT_THAT(find_input_error([&] { (void)is_results_file(file); }),
              HasSubstr(file.string()));
  EXPECT_THAT(find_input_error([&] { (void)read_contents(file); }),
              HasSubstr(file.string()));
}

TEST(ResultsFile, FileWithoutTimesIsDamaged) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  Hdf5File out = Hdf5File::create(file);
  out.write("format", "limber results", "what this file is");
  out.close();
  EXPECT_TRUE(is_results_file(file));
  const std::string why = find_input_error([&] { (void)read_contents(file); });
  EXPECT_THAT(why, HasSubstr(file.string()));
  EXPECT_THAT(why, HasSubstr("time"));
}

TEST(ResultsFile, PlaceThatCannotBeWrittenIsNamed) {
  const SmallRun run = make_empty_run();
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "no_such/results.h5";
  EXPECT_THAT(
      find_input_error([&] { write_results(file, run.model, run.history); }),
      HasSubstr(file.string()));
}

// --- Names ------------------------------------------------------------------

TEST(ResultsFile, AnyNameOfABodyComesBack) {
  const std::vector<std::string> names = {"left/arm", "upper arm", "Träger 梁",
                                          "."};
  const SmallRun run = make_small_run({names[0], names[1], names[2], names[3]});
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  EXPECT_THAT(read_contents(file).bodies,
              ::testing::UnorderedElementsAreArray(names));
  // One group a body: nothing but the bodies is in "bodies", and each has its
  // seven datasets directly inside.
  const Hdf5File in = Hdf5File::open(file);
  for (const std::string& group : in.list("bodies")) {
    EXPECT_EQ(in.list("bodies/" + group).size(), 7U) << group;
  }
}

TEST(ResultsFile, NamesThatDifferOnlyInOddCharactersStayApart) {
  const std::vector<std::string> names = {"a/b", "a%2Fb", "a_b", "a%252Fb"};
  const SmallRun run = make_small_run({names[0], names[1], names[2], names[3]});
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  EXPECT_THAT(read_contents(file).bodies,
              ::testing::UnorderedElementsAreArray(names));
}

TEST(ResultsFile, AnyNameOfAProbeComesBackWithItsValues) {
  SmallRun run = make_small_run();
  run.history.columns[0].name = "left/tip of Träger 梁.ux";
  run.history.columns[1].name = "left/tip of Träger 梁.uy";
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.h5";
  write_results(file, run.model, run.history);
  EXPECT_THAT(
      read_contents(file).probes,
      ElementsAre("left/tip of Träger 梁.ux", "left/tip of Träger 梁.uy"));
  const Hdf5File in = Hdf5File::open(file);
  const std::vector<std::string> sets = in.list("probes");
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(in.read_matrix("probes/" + sets[1])(3, 0),
            run.history.probe_rows[3][1]);
}

}  // namespace
}  // namespace limber::results::results_contents_test
