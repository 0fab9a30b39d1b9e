// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>

#include "sections.hpp"

/// Measures the cost and error of level, basis and step on five scenes, as a
/// page with tables and pictures. Claims are held or missed, a miss with its
/// reason.
namespace limber::bench::trade {
namespace {

struct Scene {
  std::string name;
  Writer (*study)(Context&);
};

const std::vector<Scene>& list_scenes() {
  static const std::vector<Scene> scenes = {{"rotation", study_rotation},
                                            {"complex", study_complex},
                                            {"impact", study_impact},
                                            {"arm", study_arm},
                                            {"spin", study_spin}};
  return scenes;
}

void introduce(Page& page) {
  page.text("# What a level costs, and what it gives up");
  page.text(
      "Written by `scripts/trade`, including all text; do not edit. Five "
      "scenes ([files](../scenes)), each simulated in many ways and compared "
      "with `full`, nonlinear finite elements on the same mesh. Errors are "
      "those of [`limber compare`](../../../docs/reference/compare.md): root "
      "mean squares over all nodes and outputs, in percent of the reference's; "
      "the displacement (the report's error), its rigid part, and the "
      "deformation "
      "alone, without rigid motion. *Online* is wall time of steps and outputs "
      "per simulated time, the least of repeated runs, one thread of a shared "
      "machine: only ratios within one run are meaningful. *Times cheaper* is "
      "relative to the scene's reference of cost; *with all nodes* the same "
      "ratio when every node's displacement is computed at every output, which "
      "reduced levels otherwise do afterwards. *Offline* is the reduction, "
      "once for each mesh and basis; \"known\" if an earlier row had it.");
}

void write_claims(Page& page, const std::vector<Claim>& claims) {
  page.heading("Claims, and the results of this run");
  for (const Claim& claim : claims) {
    page.text(fmt::format(
        "- **{}** {}{}", claim.is_held ? "Held:" : "MISSED:", claim.text,
        claim.is_held || claim.why.empty() ? "" : " Why: " + claim.why));
  }
}

void write_all(const std::string& folder, const std::string& only) {
  using Clock = std::chrono::steady_clock;
  Page page(folder);
  Context context{.folder = folder,
                  .cache = std::filesystem::temp_directory_path() /
                           fmt::format("limber-trade-{}", getpid()),
                  .claims = {}};
  std::vector<Writer> writers;
  for (const Scene& scene : list_scenes()) {
    if (!only.empty() && only != scene.name) continue;
    const auto begin = Clock::now();
    fmt::print("{} ...", scene.name);
    std::fflush(stdout);
    writers.push_back(scene.study(context));
    fmt::print(" {:.0f} s\n",
               std::chrono::duration<double>(Clock::now() - begin).count());
  }
  std::filesystem::remove_all(context.cache);
  introduce(page);
  write_claims(page, context.claims);
  for (const Writer& write : writers) write(page);
  page.write();
  if (!page.trouble().empty()) fmt::print("warning: {}\n", page.trouble());
  for (const Claim& claim : context.claims) {
    fmt::print("{}: {}\n", claim.is_held ? "held" : "MISSED", claim.text);
  }
  fmt::print("{}/README.md\n", folder);
}

}  // namespace

void add_verdict_claim(Context& context, const std::string& scene,
                       const Verdict& verdict) {
  std::string reported;
  for (const LinkVerdict& link : verdict.links) {
    reported += fmt::format(
        "{}{}: {}{}, by `full` {}", reported.empty() ? "" : "; ", link.link,
        to_string(link.advised),
        link.is_beyond_linear ? " and no level is right" : "",
        link.needed_by_full ? std::string(to_string(*link.needed_by_full))
                            : "no reduced level");
    reported += fmt::format(", by `coupled` {}", to_string(link.needed));
  }
  context.claims.push_back(
      {verdict.agrees_by_full(),
       fmt::format("{}: `limber advise` names the lowest level that suffices "
                   "by comparison with `full` ({}).",
                   scene, reported),
       verdict.agrees()
           ? "the level is right, by comparison with `coupled` in the same "
             "basis; the remaining error against `full` is that of the basis "
             "and of the linear law, which no level avoids."
       : verdict.is_safe() ? "the advice is on the safe side."
                           : "the advice is below what is needed."});
}

}  // namespace limber::bench::trade

int main(int argc, char** argv) {
  std::string folder = "out/trade";
  std::string only;
  CLI::App app("Measures what levels, bases and steps cost and give up");
  app.add_option("--out", folder, "Folder for the page and its pictures");
  app.add_option("--only", only, "One scene, to try it")
      ->check(CLI::IsMember([] {
        std::vector<std::string> names;
        for (const auto& scene : limber::bench::trade::list_scenes()) {
          names.push_back(scene.name);
        }
        return names;
      }()));
  CLI11_PARSE(app, argc, argv);
  try {
    limber::bench::trade::write_all(folder, only);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_trade: {}\n", error.what());
    return 3;
  }
  return 0;
}
