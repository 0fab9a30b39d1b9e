// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/probes_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <sstream>

#include "temporary_folder.hpp"

namespace limber::results::probes_csv_test {
namespace {

using test::find_input_error;
using test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    parts.push_back(part);
  }
  return parts;
}

History make_history() {
  History history;
  history.columns = {{"tip.ux", "m"}, {"wrist.wz", "rad/s"}};
  history.times = {0.0, 0.1, 0.1 + 0.2};
  history.probe_rows = {
      {1.0 / 3.0, -0.0},
      {std::nextafter(1.0, 2.0), std::numeric_limits<double>::denorm_min()},
      {-std::numeric_limits<double>::max(), 1e-300 / 7.0}};
  return history;
}

std::vector<std::string> write_lines(const History& history) {
  const TemporaryFolder folder;
  write_probes_csv(folder.path() / "probes.csv", history);
  return split(test::read_bytes(folder.path() / "probes.csv"), '\n');
}

TEST(ProbesCsv, HeaderNamesEveryColumnWithItsUnit) {
  EXPECT_EQ(write_lines(make_history()).at(0),
            "time [s],tip.ux [m],wrist.wz [rad/s]");
}

TEST(PeaksCsv, HasOneRowAColumn) {
  const TemporaryFolder folder;
  History history = make_history();
  history.columns[0].name = "a,b.ux";
  write_peaks_csv(folder.path() / "p.csv", history,
                  {{-1.0 / 3.0, 0.1}, {2.0, 0.25}});
  EXPECT_EQ(test::read_bytes(folder.path() / "p.csv"),
            "name,unit,peak,time [s]\n"
            "\"a,b.ux\",m,-0.33333333333333331,0.10000000000000001\n"
            "wrist.wz,rad/s,2,0.25\n");
}

TEST(EnvelopesCsv, HasOneRowAnInterval) {
  const TemporaryFolder folder;
  Envelopes envelopes = make_envelopes({0.0, 0.5, 1.0}, 2);
  include(envelopes, 0, -1.0, 0.0);
  include(envelopes, 0, 3.0, 0.25);
  include(envelopes, 1, 7.0, 0.75);
  write_envelopes_csv(folder.path() / "e.csv", make_history(), envelopes);
  EXPECT_EQ(test::read_bytes(folder.path() / "e.csv"),
            "from [s],to [s],tip.ux least [m],tip.ux most [m],"
            "wrist.wz least [rad/s],wrist.wz most [rad/s]\n"
            "0,0.5,-1,3,,\n"
            "0.5,1,,,7,7\n");
}

TEST(ProbesCsv, HasOneRowAnOutputTime) {
  EXPECT_THAT(write_lines(make_history()), SizeIs(1 + 3));
}

TEST(ProbesCsv, NumbersReadBackToTheSameBits) {
  const History history = make_history();
  const std::vector<std::string> lines = write_lines(history);
  ASSERT_THAT(lines, SizeIs(1 + 3));
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    const std::vector<std::string> fields = split(lines[i + 1], ',');
    ASSERT_THAT(fields, SizeIs(3)) << lines[i + 1];
    const auto read = [&](std::size_t k) {
      return bits(std::strtod(fields[k].c_str(), nullptr));
    };
    EXPECT_EQ(read(0), bits(history.times[i]));
    EXPECT_EQ(read(1), bits(history.probe_rows[i][0]));
    EXPECT_EQ(read(2), bits(history.probe_rows[i][1]));
  }
}

TEST(ProbesCsv, ARunWithoutOutputsLeavesTheHeaderAlone) {
  History history = make_history();
  history.times.clear();
  history.probe_rows = {};
  EXPECT_THAT(write_lines(history),
              ElementsAre("time [s],tip.ux [m],wrist.wz [rad/s]"));
}

TEST(ProbesCsv, ARunWithoutProbesLeavesItsTimes) {
  History history;
  history.times = {0.0, 0.5};
  history.probe_rows = {std::vector<double>(), std::vector<double>()};
  EXPECT_THAT(write_lines(history), ElementsAre("time [s]", "0", "0.5"));
}

// RFC 4180, 2.6 and 2.7: such a field is quoted, quotes in it are doubled.
TEST(ProbesCsv, NameWithACommaOrAQuoteStaysOneColumn) {
  History history;
  history.columns = {{"left, upper.ux", "m"}, {"5\" arm.ux", "m"}};
  EXPECT_THAT(write_lines(history),
              ElementsAre(R"(time [s],"left, upper.ux [m]","5"" arm.ux [m]")"));
}

TEST(ProbesCsv, PlaceThatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "no_such/probes.csv";
  EXPECT_THAT(find_input_error([&] { write_probes_csv(file, make_history()); }),
              HasSubstr(file.string()));
  EXPECT_THAT(find_input_error(
                  [&] { write_probes_csv(folder.path(), make_history()); }),
              HasSubstr(folder.path().string()));
}

TEST(ProbesCsv, FullDiskIsAnInputError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_THAT(
      find_input_error([] { write_probes_csv("/dev/full", make_history()); }),
      HasSubstr("/dev/full"));
}

}  // namespace
}  // namespace limber::results::probes_csv_test
