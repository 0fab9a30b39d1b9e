// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>

#include "isolated.hpp"
#include "refusals.hpp"
#include "support/run_random_scene.hpp"

/// Runs random scenes, each in a process of its own, and tells how they ended.
namespace limber::bench {
namespace {

using testing::RandomOutcome;
using Kind = RandomOutcome::Kind;

std::string run_seed(unsigned seed) {
  const RandomOutcome outcome = testing::run_random_scene(seed);
  return fmt::format("{} {} {}", static_cast<int>(outcome.kind), outcome.steps,
                     outcome.text);
}

struct Tally {
  long finished = 0;
  long refused = 0;
  std::map<std::string, std::pair<long, unsigned>> refusals;  // count, a seed
  std::vector<std::string> failures;
  std::vector<std::pair<double, unsigned>> times;  // [s], seed
  double steps = 0.0;
};

void count(const Ending& ending, unsigned seed, Tally& tally) {
  tally.times.emplace_back(ending.seconds, seed);
  if (ending.kind != Ending::Kind::done) {
    tally.failures.push_back(
        fmt::format("seed {}: {}", seed,
                    ending.kind == Ending::Kind::hung ? "hung" : "crashed"));
    return;
  }
  const auto first = ending.answer.find(' ');
  const auto second = ending.answer.find(' ', first + 1);
  const std::string text = ending.answer.substr(second + 1);
  tally.steps += std::stod(ending.answer.substr(first + 1, second - first - 1));
  switch (static_cast<Kind>(std::stoi(ending.answer.substr(0, first)))) {
    case Kind::finished:
      ++tally.finished;
      break;
    case Kind::refused: {
      ++tally.refused;
      auto& entry = tally.refusals[find_kind(text)];
      if (entry.first++ == 0) entry.second = seed;
      break;
    }
    case Kind::failed:
      tally.failures.push_back(fmt::format("seed {}: {}", seed, text));
  }
}

void print(Tally tally) {
  fmt::print("{} finished, {} refused, {} failed; {:.3g} steps in all\n",
             tally.finished, tally.refused, tally.failures.size(), tally.steps);
  for (const auto& [kind, entry] : tally.refusals) {
    fmt::print("{:6} x {} (seed {})\n", entry.first, kind, entry.second);
  }
  std::sort(tally.times.rbegin(), tally.times.rend());
  fmt::print("slowest:");
  for (std::size_t i = 0; i < std::min<std::size_t>(8, tally.times.size());
       ++i) {
    fmt::print(" {:.2f} s (seed {})", tally.times[i].first,
               tally.times[i].second);
  }
  fmt::print("\n");
  for (const std::string& text : tally.failures) fmt::print("{}\n", text);
}

int run(unsigned first, unsigned number, double limit) {
  Tally tally;
  std::vector<std::function<std::string()>> work;
  for (unsigned i = 0; i < number; ++i) {
    work.emplace_back([seed = first + i] { return run_seed(seed); });
  }
  const bool shows = isatty(STDERR_FILENO) == 1;
  const auto endings = do_isolated(work, limit, 2, [&](std::size_t done) {
    if (shows && done % 100 == 0) {
      fmt::print(stderr, "\r{} of {} scenes", done, number);
    }
  });
  if (shows) fmt::print(stderr, "\n");
  for (unsigned i = 0; i < number; ++i) count(endings[i], first + i, tally);
  print(tally);
  return tally.failures.empty() ? 0 : 1;
}

}  // namespace
}  // namespace limber::bench

int main(int argc, char** argv) {
  CLI::App app("Random scenes: how they end");
  unsigned first = 1;
  unsigned number = 10000;
  double limit = 60.0;
  app.add_option("--first", first, "First seed");
  app.add_option("--number", number, "How many");
  app.add_option("--limit", limit, "Wall time for each [s]");
  CLI11_PARSE(app, argc, argv);
  return limber::bench::run(first, number, limit);
}
