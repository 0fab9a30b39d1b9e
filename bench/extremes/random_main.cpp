// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "isolated.hpp"
#include "refusals.hpp"
#include "support/meshed_bodies.hpp"
#include "support/random_scene.hpp"
#include "support/run_random_scene.hpp"

/// Runs random scenes, each in its own process, and reports their outcomes.
namespace limber::bench {
namespace {

using testing::RandomOutcome;
using Kind = RandomOutcome::Kind;

std::string run_seed(unsigned seed,
                     const testing::RandomSceneOptions& options) {
  RandomOutcome outcome = testing::run_random_scene(seed, options);
  if (testing::is_silent_about_drift(outcome)) {
    outcome.kind = Kind::failed;
    outcome.text =
        fmt::format("{:.3g} J are open and nothing says so", outcome.drift);
  }
  const dynamics::SimulationStatistics& cost = outcome.statistics;
  return fmt::format("{} {} {} {} {}", static_cast<int>(outcome.kind),
                     cost.steps, cost.halved_steps, cost.linear_solves,
                     outcome.text);
}

// What run_seed answered.
struct Answer {
  int kind = 0;
  long steps = 0;
  long halved = 0;
  long solves = 0;
  std::string text;
};

Answer read_answer(const std::string& line) {
  Answer answer;
  std::istringstream stream(line);
  stream >> answer.kind >> answer.steps >> answer.halved >> answer.solves;
  stream.ignore();
  std::getline(stream, answer.text, '\0');
  return answer;
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
  const Answer answer = read_answer(ending.answer);
  const std::string& text = answer.text;
  tally.steps += static_cast<double>(answer.steps);
  switch (static_cast<Kind>(answer.kind)) {
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

// A line a scene, for a look at single ones.
void write_list(const std::string& path, const std::vector<unsigned>& seeds,
                const std::vector<Ending>& endings) {
  static const char* const kEndings[] = {"finished", "refused", "failed"};
  std::ofstream list(path);
  list << "seed\tseconds\tending\tsteps\thalved\tsolves\ttext\tscheme\tstep\n";
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Ending& ending = endings[i];
    if (ending.kind != Ending::Kind::done) {
      list << fmt::format(
          "{}\t{:.2f}\t{}\t\t\t\t\t\t\n", seeds[i], ending.seconds,
          ending.kind == Ending::Kind::hung ? "hung" : "crashed");
      continue;
    }
    const Answer answer = read_answer(ending.answer);
    const dynamics::SimulationSettings requested =
        testing::draw_scene(seeds[i]).settings;
    list << fmt::format("{}\t{:.2f}\t{}\t{}\t{}\t{}\t{}\t{}\t{:.3g}\n",
                        seeds[i], ending.seconds, kEndings[answer.kind],
                        answer.steps, answer.halved, answer.solves, answer.text,
                        dynamics::to_string(requested.integrator),
                        requested.step);
  }
}

int run(const std::vector<unsigned>& seeds,
        const testing::RandomSceneOptions& options, double limit,
        const std::string& list) {
  Tally tally;
  std::vector<std::function<std::string()>> work;
  work.reserve(seeds.size());
  for (const unsigned seed : seeds) {
    work.emplace_back([seed, &options] { return run_seed(seed, options); });
  }
  const bool shows = isatty(STDERR_FILENO) == 1;
  const auto endings = do_isolated(work, limit, 2, [&](std::size_t done) {
    if (shows && done % 100 == 0) {
      fmt::print(stderr, "\r{} of {} scenes", done, seeds.size());
    }
  });
  if (shows) fmt::print(stderr, "\n");
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    count(endings[i], seeds[i], tally);
  }
  if (!list.empty()) write_list(list, seeds, endings);
  print(tally);
  return tally.failures.empty() ? 0 : 1;
}

}  // namespace
}  // namespace limber::bench

int main(int argc, char** argv) {
  using namespace limber;
  CLI::App app("Random scenes: how they end");
  unsigned first = 1;
  unsigned number = 10000;
  double limit = 300.0;
  app.add_option("--first", first, "First seed");
  app.add_option("--number", number, "How many");
  std::vector<unsigned> seeds;
  std::string list;
  app.add_option("--seeds", seeds, "These, in place of a row of them")
      ->delimiter(',');
  app.add_option("--limit", limit, "Processor time for each [s]");
  testing::RandomSceneOptions options;
  bool is_meshed = false;
  app.add_flag("--meshed", is_meshed, "Bodies reduced from meshes");
  std::string level;
  app.add_option("--level", level,
                 "Of all flexible bodies, in place of random ones")
      ->check(CLI::IsMember(dynamics::fidelity_names()));
  app.add_option("--list", list, "File to tell of each scene in (TSV)");
  CLI11_PARSE(app, argc, argv);
  for (unsigned i = 0; seeds.size() < number && !app.count("--seeds"); ++i) {
    seeds.push_back(first + i);
  }
  if (!level.empty()) options.level = dynamics::parse_fidelity(level);
  if (is_meshed) options.make_body = testing::make_meshed_bodies();
  return limber::bench::run(seeds, options, limit, list);
}
