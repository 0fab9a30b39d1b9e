// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/compare/comparison.hpp"

#include <gmock/gmock.h>

#include "limber/runs/compare/comparison_selection.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::runs::comparison_test {
namespace {

using scene::test::input_error;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A completed run with these relative errors; negative: none.
ComparedRun make_run(double cost, double displacement, double deformation,
                     double rigid = 0.0) {
  const auto field = [](double error) {
    return results::FieldError{error, error, error < 0.0 ? 0.0 : 1.0, 1e-9};
  };
  ComparedRun run;
  run.cost.online = cost;
  run.choice.step = cost;  // identifies runs
  results::SystemMotionError error;
  error.error = {field(displacement), field(rigid), field(deformation)};
  run.error = std::move(error);
  return run;
}

Comparison make_comparison(std::vector<ComparedRun> runs) {
  Comparison comparison;
  comparison.runs = std::move(runs);
  return comparison;
}

TEST(Tolerance, IsAPercentageOrAShare) {
  EXPECT_THAT(parse_tolerance("1%"), DoubleEq(0.01));
  EXPECT_THAT(parse_tolerance("2.5 %"), DoubleEq(0.025));
  EXPECT_THAT(parse_tolerance("0.01"), DoubleEq(0.01));
  EXPECT_THAT(parse_tolerance("1e-3"), DoubleEq(0.001));
}

TEST(Tolerance, RefusesWhatIsNoShare) {
  for (const char* text : {"", "one", "1 percent", "%", "0", "-1%", "100%",
                           "nan", "inf", "1e999", "0.01x", "1%%"}) {
    EXPECT_THAT(input_error([&] { (void)parse_tolerance(text); }),
                HasSubstr("--tolerance: '" + std::string(text) + "'"))
        << text;
  }
  // The usual slip: one percent as a number.
  EXPECT_THAT(input_error([] { (void)parse_tolerance("1"); }),
              HasSubstr("is 100 %"));
}

TEST(ErrorMeasure, NamesTheNearest) {
  EXPECT_EQ(parse_error_measure("deformation"), ErrorMeasure::deformation);
  EXPECT_THAT(input_error([] { (void)parse_error_measure("displacemnt"); }),
              HasSubstr("did you mean 'displacement'"));
}

TEST(Selection, TakesTheCheapestThatMeetsTheTolerance) {
  const Comparison comparison =
      make_comparison({make_run(3.0, 0.001, 0.001), make_run(1.0, 0.001, 0.5),
                       make_run(2.0, 0.004, 0.009), make_run(4.0, 0.0, 0.0)});
  const ComparedRun* chosen = find_cheapest(comparison, {0.01, {}});
  ASSERT_NE(chosen, nullptr);
  EXPECT_EQ(chosen->cost.online, 1.0);  // by displacement alone
  chosen = find_cheapest(comparison, {0.01, ErrorMeasure::both});
  ASSERT_NE(chosen, nullptr);
  EXPECT_EQ(chosen->cost.online, 2.0);
}

TEST(Selection, PassesOverRunsThatStopped) {
  ComparedRun stopped;  // without an error
  stopped.cost.online = 1.0;
  EXPECT_EQ(find_cheapest(make_comparison({stopped}), {}), nullptr);
}

TEST(Selection, HoldsWhatTheReferenceHas) {
  const auto error = [](const ComparedRun& run, ErrorMeasure measure) {
    return find_error(run.error->error, measure);
  };
  const ComparedRun undeformed = make_run(1.0, 0.2, -1.0);
  EXPECT_EQ(error(undeformed, ErrorMeasure::both), 0.2);
  EXPECT_EQ(error(undeformed, ErrorMeasure::deformation), 0.2);
  const ComparedRun rigid_links = make_run(1.0, -1.0, -1.0, 0.3);
  EXPECT_EQ(error(rigid_links, ErrorMeasure::both), 0.3);
  const ComparedRun at_rest = make_run(1.0, -1.0, -1.0, -1.0);
  EXPECT_EQ(error(at_rest, ErrorMeasure::both), std::nullopt);
}

TEST(Selection, SaysWhatCameClosestWhenNothingMeetsTheTolerance) {
  const Comparison comparison =
      make_comparison({make_run(1.0, 0.3, 0.4), make_run(2.0, 0.02, 0.25)});
  EXPECT_EQ(find_cheapest(comparison, {}), nullptr);
  try {
    refuse(comparison, {});
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'coupled, 2 s'"));
    EXPECT_THAT(error.what(), HasSubstr("25 %"));
  }
}

TEST(OutputTimes, KeepTheDistanceOfTheLongestStep) {
  EXPECT_THAT(thin_times({0.0, 0.1, 0.2, 0.3, 0.4, 0.5}, 0.2),
              ElementsAre(0.0, 0.2, 0.4, 0.5));
  EXPECT_THAT(thin_times({0.0, 0.1, 0.2}, 0.1), ElementsAre(0.0, 0.1, 0.2));
  EXPECT_THAT(thin_times({0.1, 0.2}, 0.0), ElementsAre(0.1, 0.2));
}

}  // namespace
}  // namespace limber::runs::comparison_test
