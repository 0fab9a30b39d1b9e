// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/next_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>

#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/monitors/energy_verdict.hpp"
#include "limber/scene/text/setting.hpp"

namespace limber::app {
namespace {

// From which fraction of the steps, or of their time, a part matters [-].
constexpr double kMany = 0.2;
constexpr double kMuchTime = 0.4;
constexpr double kManyIterations = 5.0;  // of Newton's method a step
constexpr double kLittleError = 1e-5;    // of the energy [-]
constexpr std::size_t kMostSteps = 3;

/// Suggestions with weights, the larger the more useful.
using Weighted = std::multimap<double, NextStep, std::greater<>>;

const RunSummary::Steps* find_limit(const RunSummary& run,
                                    const std::string& by) {
  for (const RunSummary::Steps& limit : run.limits) {
    if (limit.by == by) return &limit;
  }
  return nullptr;
}

double fraction_of(const RunSummary& run, const std::string& by) {
  const RunSummary::Steps* limit = find_limit(run, by);
  const double all = count_parts(run);
  return limit == nullptr || all == 0.0 ? 0.0 : limit->count / all;
}

double fraction_of_time(const RunSummary& run, const char* part) {
  const auto found = run.parts.find(part);
  return found == run.parts.end() || !(run.seconds > 0.0)
             ? 0.0
             : found->second / run.seconds;
}

std::string name_scenario(const RunSummary& run) {
  return run.scenario.empty() ? "SCENARIO" : "'" + run.scenario + "'";
}

/// "--set PATH=VALUE", in quotes where a shell would change it.
std::string describe_setting(const std::string& path,
                             const std::string& value) {
  const std::string text = path + "=" + value;
  const bool is_plain = std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("._=-+/").find(c) != std::string_view::npos;
  });
  return is_plain ? "--set " + text : "--set '" + text + "'";
}

/// What a run that failed by its integrator can take instead.
void add_integrator(const RunSummary& run, Weighted& all) {
  const std::string alpha = "generalized-alpha";
  if (run.integrator.empty() || run.integrator == alpha) return;
  const bool is_implicit =
      dynamics::traits_of(dynamics::parse_integrator(run.integrator))
          .is_implicit;
  all.insert(
      {8.5,
       {"--set time.integrator=" + alpha,
        is_implicit ? fmt::format("{} failed; that scheme damps vibration that "
                                  "its steps do not resolve",
                                  run.integrator)
                    : fmt::format("steps of {} must resolve the fastest "
                                  "vibration, those of that scheme need not",
                                  run.integrator)}});
}

void add_end(const RunSummary& run, Weighted& all) {
  if (run.has_checkpoint &&
      (run.end == RunEnd::killed || run.end == RunEnd::stopped)) {
    all.insert({10.0,
                {fmt::format("limber run {} --resume --out '{}'",
                             name_scenario(run), run.folder),
                 "there is a checkpoint from which the run can continue"}});
  }
  if (run.end != RunEnd::failed) return;
  add_integrator(run, all);
  const RunSummary::Steps* failed = find_limit(run, "failure");
  if (run.tolerance > 0.0) {
    all.insert(
        {9.0,
         {fmt::format("--set time.tolerance={:.3g}", 0.1 * run.tolerance),
          fmt::format("the run failed with the tolerance of {:.3g} m",
                      run.tolerance)}});
  } else if (failed != nullptr) {
    all.insert({9.0,
                {fmt::format("--set time.step={:.3g}", failed->shortest),
                 fmt::format("{:.0f} parts of halved steps succeeded before "
                             "the failure; the shortest had that length",
                             failed->count)}});
  } else {
    all.insert({9.0,
                {fmt::format("--set time.step={:.3g}", 0.1 * run.step),
                 fmt::format("steps of {:.3g} s succeeded until one failed",
                             run.step)}});
  }
  all.insert({8.0,
              {fmt::format("limber view '{}'", run.folder),
               fmt::format("the results until the failure at {:.6g} s were "
                           "saved and show what moves too far",
                           run.reached)}});
  all.insert({7.0,
              {"limber check " + name_scenario(run),
               "it lists overlaps at the start, the frequencies that the step "
               "does not resolve, and doubtful values"}});
}

bool has_level(const RunSummary& run, const std::string& level) {
  return std::any_of(
      run.levels.begin(), run.levels.end(),
      [&](const RunSummary::Level& own) { return own.used == level; });
}

void add_energy(const RunSummary& run, Weighted& all) {
  if (!run.unbalanced_fraction ||
      !(*run.unbalanced_fraction > dynamics::kReportedDrift))
    return;
  const std::string why =
      fmt::format("the energy error is {:.2g} % of the throughput, most in {}",
                  100.0 * *run.unbalanced_fraction, run.open_place);
  const double weight = 5.0 + *run.unbalanced_fraction;
  if (run.tolerance > 0.0) {
    all.insert(
        {weight,
         {fmt::format("--set time.tolerance={:.3g}", 0.1 * run.tolerance),
          why}});
    return;
  }
  all.insert(
      {weight, {fmt::format("--set time.step={:.3g}", 0.5 * run.step), why}});
  const bool can_conserve = run.integrator != "energy-conserving" &&
                            !has_level(run, "full") &&
                            !has_level(run, "one-way");
  if (!can_conserve) return;
  all.insert({weight - 0.5,
              {"--set time.integrator=energy-conserving",
               why + "; that scheme conserves it to round-off"}});
}

void add_limits(const RunSummary& run, Weighted& all) {
  if (const double impacts = fraction_of(run, "impact"); impacts > kMany) {
    all.insert(
        {3.0 + impacts,
         {"fewer steps in an impact: --set time.impact_steps=10 (default 20)",
          fmt::format("{:.0f} % of all parts of steps resolve impacts, most "
                      "of '{}'; restitution becomes less exact",
                      100.0 * impacts, find_most(run.by_pair))}});
  }
  if (const double tolerance = fraction_of(run, "tolerance");
      tolerance > 0.5 && run.steps > 0) {
    all.insert(
        {2.0 + tolerance,
         {fmt::format("--set time.tolerance={:.3g}", 10.0 * run.tolerance),
          fmt::format(
              "the tolerance limited {:.0f} % of the steps, most by the motion "
              "of '{}'; a tolerance ten times larger halves their number",
              100.0 * tolerance, find_most(run.by_body))}});
  }
  if (const double marks = fraction_of(run, "breakpoint"); marks > kMany) {
    all.insert({2.5 + marks,
                {"a longer time.output_interval",
                 fmt::format("{:.0f} % of the steps are short because of "
                             "outputs, samples or jumps of loads",
                             100.0 * marks)}});
  }
  if (const double waves = fraction_of(run, "oscillation"); waves > kMany) {
    all.insert({1.5 + waves,
                {"--unset time.tolerance with a step",
                 fmt::format("{:.0f} % of the steps follow the period of a "
                             "load or command",
                             100.0 * waves)}});
  }
  const double all_steps = static_cast<double>(std::max(run.steps, 1L));
  if (run.end == RunEnd::finished && run.tolerance == 0.0 &&
      static_cast<double>(run.halved) > 0.01 * all_steps) {
    all.insert({4.0,
                {fmt::format("--set time.step={:.3g}", 0.5 * run.step),
                 fmt::format("{} of {} steps failed at first and were halved",
                             run.halved, run.steps)}});
  }
  if (static_cast<double>(run.rejected) > kMany * all_steps) {
    all.insert({2.0,
                {"a fixed time.step in place of the tolerance",
                 fmt::format("{} steps were rejected for {} accepted ones",
                             run.rejected, run.steps)}});
  }
}

void add_level(const RunSummary& run, Weighted& all) {
  std::vector<RunSummary::Level> levels = run.levels;
  std::erase_if(levels, [](const RunSummary::Level& level) {
    return !level.is_more_than_needed;
  });
  if (levels.empty()) return;
  const RunSummary::Level& first = levels.front();
  const std::string others =
      levels.size() == 1
          ? ""
          : fmt::format("; {} more likewise ('levels' in summary.json)",
                        levels.size() - 1);
  all.insert(
      {1.8,
       {describe_setting("fidelity.links." + scene::quote_part(first.body),
                         first.recommended),
        fmt::format("the motion of '{}' does not need level {}{}", first.body,
                    first.used, others)}});
}

/// Of a finished run: its errors, if they are not known, and steps to a
/// tolerance.
void add_checks(const RunSummary& run, Weighted& all) {
  if (run.end != RunEnd::finished) return;
  if (!run.has_errors) {
    all.insert({0.5,
                {fmt::format("limber run {} --errors", name_scenario(run)),
                 "the record has no errors of its probes; that run estimates "
                 "them by cause"}});
  }
  if (run.tolerance == 0.0 && run.integrator == "generalized-alpha" &&
      fraction_of(run, "given") > 0.9) {
    all.insert(
        {0.8,
         {run.step_changes > 0 ? "--unset time.steps" : "--unset time.step",
          "all steps have the length that was given; without it they "
          "follow a tolerance that Limber chooses"}});
  }
}

void add_time(const RunSummary& run, Weighted& all) {
  if (const double contact = fraction_of_time(run, "contact");
      contact > kMuchTime && !run.meshed.empty()) {
    all.insert({3.0 + contact,
                {fmt::format("a primitive <collision> shape for '{}'",
                             run.meshed.front()),
                 fmt::format("contact took {:.0f} % of the time, and the "
                             "contact shape of that link is a mesh",
                             100.0 * contact)}});
  }
  if (const double outputs = fraction_of_time(run, "outputs");
      outputs > kMany) {
    all.insert(
        {2.0 + outputs,
         {"a longer time.output_interval, or fewer probes of stress",
          fmt::format("outputs took {:.0f} % of the time", 100.0 * outputs)}});
  }
  const double all_steps = static_cast<double>(std::max(run.steps, 1L));
  const double iterations = static_cast<double>(run.iterations) / all_steps;
  if (iterations > kManyIterations && run.tolerance == 0.0 &&
      fraction_of(run, "impact") < kMany) {
    all.insert({2.0,
                {fmt::format("--set time.step={:.3g}", 0.5 * run.step),
                 fmt::format("Newton's method took {:.1f} iterations a step, "
                             "where 2 or 3 are usual",
                             iterations)}});
  }
  add_level(run, all);
  if (run.end == RunEnd::finished && run.tolerance == 0.0 && run.halved == 0 &&
      run.unbalanced_fraction && *run.unbalanced_fraction < kLittleError &&
      fraction_of(run, "given") > 0.9 && iterations < 3.0) {
    all.insert(
        {1.0,
         {fmt::format("--set time.step={:.3g}", 2.0 * run.step),
          fmt::format(
              "the energy error is below {:g} of the throughput, and Newton's "
              "method takes {:.1f} iterations a step: a longer one may suffice",
              kLittleError, iterations)}});
  }
}

}  // namespace

double count_parts(const RunSummary& run) {
  double all = 0.0;
  for (const RunSummary::Steps& limit : run.limits) all += limit.count;
  return all;
}

std::vector<NextStep> find_next_steps(const RunSummary& run) {
  Weighted all;
  add_end(run, all);
  add_energy(run, all);
  add_limits(run, all);
  add_time(run, all);
  add_checks(run, all);
  std::vector<NextStep> steps;
  for (const auto& [weight, step] : all) {
    const bool is_known = std::any_of(
        steps.begin(), steps.end(), [&what = step.what](const NextStep& other) {
          return other.what == what;
        });
    if (!is_known && steps.size() < kMostSteps) steps.push_back(step);
  }
  return steps;
}

}  // namespace limber::app
