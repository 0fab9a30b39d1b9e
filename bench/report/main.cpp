// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "sections.hpp"

/// Regenerates the WOBBLE report's Tables 1 to 3 and Figures 7 to 20, each
/// number beside the report's, as a page with pictures. Exit status 1 if a
/// claim of the page does not hold in this run.
namespace limber::bench {
namespace {

struct Section {
  std::string name;
  std::function<void(Page&, Shared&)> write;
};

std::vector<Section> list_sections() {
  const auto alone = [](void (*write)(Page&)) {
    return [write](Page& page, Shared&) { write(page); };
  };
  return {{"mesh-statistics", alone(write_mesh_statistics)},
          {"effective-masses", write_effective_masses},
          {"step-approximation", alone(write_step_approximation)},
          {"truncation", write_truncation},
          {"static-modes", write_static_modes},
          {"decision-boundary", write_decision_boundary},
          {"energy", write_energy},
          {"time-steps", write_time_steps},
          {"beam-theory", alone(write_beam_theory)},
          {"shear-swing", alone(write_shear_swing)},
          {"large-rotation", write_large_rotation},
          {"case-study", write_case_study},
          {"case-cost", alone(write_case_cost)},
          {"boundary-savings", alone(write_boundary_savings)}};
}

void introduce(Page& page) {
  page.text("# The WOBBLE report's tables and figures, by Limber");
  page.text(
      "Written by `scripts/report`, including all text; do not edit. Tables 1 "
      "to 3 and Figures 7 to 20 of the report (`morrison2023` in "
      "[references.bib](../../../docs/references.bib)), as far as they do not "
      "need other programs. Beam of 1 x 1 x 5 m, E = 200 GPa, Poisson's ratio "
      "0, 8000 kg/m^3; mesh `meshes/beam579.msh` and ten eigenmodes unless "
      "said otherwise. The report's SimpleRB is the level `uncoupled`, "
      "CoupledRB `coupled` (Limber's is complete), PureMA a clamped body; its "
      "time stepping is the integrator `explicit-euler`. The report's figures "
      "are not available, only their captions and text: assumed loads and "
      "durations are stated where they are used. Akantu's curves, which need "
      "that program, are replaced by an independent explicit finite-element "
      "code's (tests/data/beam).");
  page.text(
      "*Holds* marks a claim that the program checks in the run that wrote "
      "this page. Times are of one run on two shared cores.");
}

int write_report(const std::string& folder, const std::string& only) {
  using Clock = std::chrono::steady_clock;
  Page page(folder);
  Shared shared;
  introduce(page);
  const std::vector<Section> sections = list_sections();
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (!only.empty() && only != sections[i].name) continue;
    const auto begin = Clock::now();
    fmt::print("[{:2}/{}] {} ...", i + 1, sections.size(), sections[i].name);
    std::fflush(stdout);
    sections[i].write(page, shared);
    page.write();
    fmt::print(" {:.1f} s\n",
               std::chrono::duration<double>(Clock::now() - begin).count());
  }
  if (!page.trouble().empty()) fmt::print("warning: {}\n", page.trouble());
  fmt::print("{}/README.md: {} claims checked, {} failed\n", folder,
             page.checks(), page.failures());
  return page.failures() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace limber::bench

int main(int argc, char** argv) {
  std::string folder = "out/report";
  std::string only;
  CLI::App app("Regenerates the WOBBLE report's tables and figures");
  app.add_option("--out", folder, "Folder for the page and its pictures");
  app.add_option("--only", only, "One section, to try it")
      ->check(CLI::IsMember([] {
        std::vector<std::string> names;
        for (const auto& s : limber::bench::list_sections()) {
          names.push_back(s.name);
        }
        return names;
      }()));
  CLI11_PARSE(app, argc, argv);
  try {
    return limber::bench::write_report(folder, only);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_report: {}\n", error.what());
    return 3;
  }
}
