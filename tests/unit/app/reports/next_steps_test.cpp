// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/next_steps.hpp"

#include <gmock/gmock.h>

namespace limber::test::next_steps_test {
namespace {

using app::find_next_steps;
using app::RunEnd;
using app::RunSummary;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

/// Finished, of equal steps, with no energy error.
RunSummary make_run() {
  RunSummary run;
  run.folder = "o";
  run.scenario = "s.toml";
  run.integrator = "generalized-alpha";
  run.step = 1e-3;
  run.steps = 1000;
  run.iterations = 2000;
  run.limits = {{"given", 1000.0, 1.0, 1e-3}};
  run.unbalanced_fraction = 0.0;
  return run;
}

std::vector<std::string> list(const RunSummary& run) {
  std::vector<std::string> texts;
  for (const app::NextStep& step : find_next_steps(run)) {
    texts.push_back(step.what);
  }
  return texts;
}

TEST(NextSteps, QuoteNamesThatNeedIt) {
  RunSummary run = make_run();
  run.levels = {{"claw.left", "coupled", "rigid", true}};
  EXPECT_THAT(list(run),
              Contains("--set 'fidelity.links.\"claw.left\"=rigid'"));
  run.levels = {{"left", "coupled", "rigid", true}};
  EXPECT_THAT(list(run), Contains("--set fidelity.links.left=rigid"));
}

TEST(NextSteps, HaveEnergyConservingOnlyWhereItWouldHelp) {
  RunSummary run = make_run();
  run.unbalanced_fraction = 0.2;
  run.open_place = "body 'arm'";
  const auto conserving = HasSubstr("energy-conserving");
  EXPECT_THAT(list(run), Contains(conserving));
  run.levels = {{"arm", "full", "full", false}};
  EXPECT_THAT(list(run), Each(Not(conserving)));
  run.levels.clear();
  run.integrator = "energy-conserving";
  EXPECT_THAT(list(run), Each(Not(conserving)));
}

TEST(NextSteps, OfARunThatFailedByOneSchemeHaveAnother) {
  RunSummary run = make_run();
  run.end = RunEnd::failed;
  run.integrator = "energy-conserving";
  EXPECT_THAT(list(run), SizeIs(3));
  EXPECT_THAT(list(run), Contains("--set time.integrator=generalized-alpha"));
  run.integrator = "generalized-alpha";
  EXPECT_THAT(list(run), Each(Not(HasSubstr("integrator"))));
  EXPECT_THAT(list(run), Contains("limber check 's.toml'"));
}

TEST(NextSteps, AreThreeOfAnOrdinaryRunAndFewerOfOneWithErrors) {
  RunSummary run = make_run();
  EXPECT_THAT(list(run), SizeIs(3));
  EXPECT_THAT(list(run), Contains("limber run 's.toml' --errors"));
  run.has_errors = true;
  EXPECT_THAT(list(run), SizeIs(2));
}

}  // namespace
}  // namespace limber::test::next_steps_test
