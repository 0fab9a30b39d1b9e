// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <optional>

#include "limber/app/reports/error_report.hpp"

namespace limber::test::error_table_test {
namespace {

using app::to_json;
using app::to_text;
using runs::ColumnValues;
using runs::compare_causes;
using runs::ErrorRun;
using runs::ErrorTable;
using runs::ProbeErrors;
using ::testing::HasSubstr;

const std::vector<std::string> kNames = {"tip.ux"};
const std::vector<std::string> kUnits = {"m"};
const std::vector<ColumnValues> kOwn = {{{0.0, 1.0, -2.0}, -2.5}};

ErrorRun make_run(const std::string& name, double factor, double seconds,
                  const ColumnValues& values) {
  return {name, "finer", factor, seconds, "", {values}};
}

TEST(ErrorTable, HasTheDifferencesOfEachCauseTimesItsFactor) {
  const ErrorTable table =
      compare_causes(kNames, kUnits, kOwn,
                     {make_run("step", 4.0 / 3.0, 1.0, {{0.0, 1.3, -2.0}, 2.8}),
                      make_run("modes", 1.0, 1.0, {{0.1, 1.0, -2.05}, -2.5})},
                     std::nullopt);
  const ProbeErrors& probe = table.probes.at(0);
  EXPECT_NEAR(probe.by_cause[0].curve, 0.4, 1e-15);
  EXPECT_NEAR(probe.by_cause[0].peak, 0.4, 1e-15);  // of magnitudes
  EXPECT_NEAR(probe.by_cause[1].curve, 0.1, 1e-15);
  EXPECT_EQ(probe.by_cause[1].peak, 0.0);
  EXPECT_NEAR(probe.total.curve, 0.5, 1e-15);
  EXPECT_EQ(probe.adds_up, std::nullopt);
}

TEST(ErrorTable, NamesTheCheapestCauseThatHasHalfOfTheTotal) {
  const auto find_remedy = [](double step, double mesh, double seconds) {
    const ErrorTable table = compare_causes(
        kNames, kUnits, kOwn,
        {make_run("step", 1.0, seconds, {{step, 1.0, -2.0}, -2.5}),
         make_run("mesh", 1.0, 2.0, {{mesh, 1.0, -2.0}, -2.5}),
         make_run("contact", 1.0, 0.1, {{0.04, 1.0, -2.0}, -2.5})},
        std::nullopt);
    return table.probes.at(0).remedy;
  };
  EXPECT_EQ(find_remedy(0.5, 0.1, 1.0), 0U);
  EXPECT_EQ(find_remedy(0.1, 0.5, 1.0), 1U);
  EXPECT_EQ(find_remedy(0.05, 0.05, 1.0), std::nullopt);
}

// Round-off of a motion along x has components along y.
TEST(ErrorTable, LeavesOutWhatIsRoundOffOfItsProbe) {
  ErrorRun step = make_run("step", 1.0, 1.0, {{0.0, 1.1}, 1.1});
  step.columns.push_back({{0.0, 3e-13}, 3e-13});
  step.columns.push_back({{0.0, 2e-13}, 2e-13});
  const ErrorTable table = compare_causes(
      {"tip.ux", "tip.uy", "eye.ux"}, {"m", "m", "m"},
      {{{0.0, 1.0}, 1.0}, {{0.0, 2e-13}, 2e-13}, {{0.0, 1e-13}, 1e-13}}, {step},
      std::nullopt);
  const std::string text = to_text(table);
  EXPECT_THAT(text, HasSubstr("\ntip.ux "));
  EXPECT_THAT(text, HasSubstr("\neye.ux "));  // a small motion of its own
  EXPECT_THAT(text, HasSubstr("1 left out, zero or round-off: 'tip.uy'"));
  EXPECT_TRUE(to_json(table)["probes"]["tip.uy"]["is_noise"].get<bool>());
}

TEST(ErrorTable, TellsWhereCausesDoNotAddUp) {
  const std::vector<ErrorRun> runs = {
      make_run("step", 1.0, 1.0, {{0.0, 1.1, -2.0}, -2.5})};
  const auto compare = [&](double all) {
    return compare_causes(kNames, kUnits, kOwn, runs,
                          make_run("all", 1.0, 1.0, {{all, 1.0, -2.0}, -2.5}))
        .probes.at(0);
  };
  EXPECT_EQ(compare(0.15).adds_up, true);
  EXPECT_NEAR(compare(0.15).total.curve, 0.15, 1e-15);
  EXPECT_EQ(compare(0.5).adds_up, false);
  EXPECT_NEAR(compare(0.5).total.curve, 0.5, 1e-15);
}

TEST(ErrorTable, TellsWhatCouldNotBeRun) {
  ErrorRun failed = make_run("level", 1.0, 0.0, {});
  failed.failure = "it ended at 0.1 s";
  failed.columns.clear();
  const ErrorTable table = compare_causes(
      kNames, kUnits, kOwn,
      {failed, make_run("step", 1.0, 1.0, {{0.0, 1.1, -2.0}, -2.5})},
      std::nullopt);
  EXPECT_THAT(to_text(table), HasSubstr("unknown: it ended at 0.1 s"));
  EXPECT_TRUE(
      to_json(table)["probes"]["tip.ux"]["by_cause"]["level"].is_null());
  EXPECT_EQ(table.probes.at(0).remedy, 1U);
}

TEST(ErrorTable, HasNoErrorWhereOneOfTwoValuesIsNone) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto find_error = [&](double own, double fine) {
    return compare_causes(kNames, kUnits, {{{own, 1.0}, 1.0}},
                          {make_run("step", 1.0, 1.0, {{fine, 1.5}, 1.0})},
                          std::nullopt)
        .probes.at(0)
        .total.curve;
  };
  EXPECT_TRUE(std::isnan(find_error(none, 1.0)));
  EXPECT_TRUE(std::isnan(find_error(1.0, none)));
  EXPECT_EQ(find_error(none, none), 0.5);  // as a place while apart
}

}  // namespace
}  // namespace limber::test::error_table_test
