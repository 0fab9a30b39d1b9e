// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <optional>

#include "duration.hpp"
#include "limber/common/errors.hpp"
#include "page.hpp"
#include "picture.hpp"
#include "refusals.hpp"

/// Sweeps scenes to extremes, classes every cell and draws maps.
namespace limber::bench {
namespace {

using dynamics::IntegratorKind;
using Kind = Class;
using Work = std::vector<std::function<std::string()>>;

constexpr int kAtATime = 2;
// Processor time of a cell [s]. 2e4 steps of an explicit scheme, each divided
// into a thousand parts of 15 us, take 300 s.
constexpr double kLimit = 600.0;
constexpr double kReferenceLimit = 30.0;  // [s]
constexpr double kLongLimit = 600.0;      // of a run of 1e7 steps [s]

struct Sweep {
  Map map;
  std::vector<Verdicts> verdicts;  // by integrator
};

std::vector<Ending> work_through(const std::string& what, const Work& work,
                                 double limit) {
  const bool shows = isatty(STDERR_FILENO) == 1;
  auto endings = do_isolated(work, limit, kAtATime, [&](std::size_t done) {
    if (shows) fmt::print(stderr, "\r{}: {} of {} ", what, done, work.size());
  });
  if (shows) fmt::print(stderr, "\n");
  return endings;
}

std::vector<Cell> list_cells(const Map& map) {
  std::vector<Cell> cells;
  for (const IntegratorKind integrator : map.integrators) {
    for (const double y : map.y.values) {
      for (const double x : map.x.values) {
        cells.push_back(make_cell(map, integrator, x, y));
      }
    }
  }
  return cells;
}

std::map<std::string, Reference> find_references(const std::vector<Cell>& cells,
                                                 const Beams& beams) {
  std::map<std::string, Cell> scenes;
  for (const Cell& cell : cells) scenes.emplace(name_reference(cell), cell);
  Work work;
  for (const auto& [key, cell] : scenes) {
    work.emplace_back([&, cell = cell] { return run_reference(cell, beams); });
  }
  const auto endings = work_through("references", work, kReferenceLimit);
  std::map<std::string, Reference> references;
  std::size_t i = 0;
  for (const auto& [key, cell] : scenes) {
    references[key] = read_reference(endings[i++]);
  }
  return references;
}

std::vector<Ending> judge_all(const std::vector<Cell>& cells,
                              const Beams& beams) {
  const auto references = find_references(cells, beams);
  Work work;
  for (const Cell& cell : cells) {
    work.emplace_back([&, reference = &references.at(name_reference(cell))] {
      return judge(cell, beams, *reference);
    });
  }
  return work_through("cells", work, kLimit);
}

std::vector<Sweep> sweep(const std::vector<Map>& maps, Beams& beams) {
  std::vector<Cell> cells;
  for (const Map& map : maps) {
    for (const Cell& cell : list_cells(map)) cells.push_back(cell);
  }
  for (const Cell& cell : cells) beams.prepare(cell);
  const std::vector<Ending> endings = judge_all(cells, beams);
  std::vector<Sweep> sweeps;
  std::size_t i = 0;
  for (const Map& map : maps) {
    Sweep& one = sweeps.emplace_back(Sweep{map, {}});
    for (std::size_t k = 0; k < map.integrators.size(); ++k) {
      Verdicts& verdicts = one.verdicts.emplace_back(map.y.values.size());
      for (auto& row : verdicts) {
        for (std::size_t x = 0; x < map.x.values.size(); ++x) {
          row.push_back(read_verdict(endings[i++]));
        }
      }
    }
  }
  return sweeps;
}

/// Calls with every cell and its verdict.
void visit(const Sweep& sweep,
           const std::function<void(const Cell&, const Verdict&)>& call) {
  const Map& map = sweep.map;
  for (std::size_t k = 0; k < map.integrators.size(); ++k) {
    for (std::size_t y = 0; y < map.y.values.size(); ++y) {
      for (std::size_t x = 0; x < map.x.values.size(); ++x) {
        call(make_cell(map, map.integrators[k], map.x.values[x],
                       map.y.values[y]),
             sweep.verdicts[k][y][x]);
      }
    }
  }
}

using Counts = std::array<int, 4>;

Counts count(const Sweep& sweep) {
  Counts counts{};
  visit(sweep, [&](const Cell&, const Verdict& verdict) {
    ++counts[static_cast<std::size_t>(verdict.kind)];
  });
  return counts;
}

std::vector<Duration> run_durations(bool full, Beams& beams) {
  Work work;
  std::vector<Cell> cells;
  for (const std::string& name : dynamics::integrator_names()) {
    const Cell cell = make_long_cell(dynamics::parse_integrator(name));
    const bool is_default =
        cell.integrator == IntegratorKind::generalized_alpha;
    beams.prepare(cell);
    cells.push_back(cell);
    work.emplace_back([&beams, cell, steps = full || is_default ? 1e7 : 1e6] {
      return run_long(cell, beams, steps);
    });
  }
  const auto endings = work_through("duration", work, kLongLimit);
  std::vector<Duration> durations;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    durations.push_back(read_duration(cells[i], endings[i]));
  }
  return durations;
}

Plot plot_durations(const std::vector<Duration>& durations) {
  Panel energy{.title = "Energy that is left open",
               .x_label = "steps",
               .y_label = "of what passed through",
               .is_log_x = true,
               .is_log_y = true,
               .curves = {},
               .commands = {}};
  Panel momentum = energy;
  momentum.title = "Change of angular momentum since the blow";
  momentum.y_label = "of itself";
  for (std::size_t i = 0; i < durations.size(); ++i) {
    const Duration& d = durations[i];
    const std::string name = dynamics::to_string(d.integrator);
    const int colour = static_cast<int>(i);
    if (d.steps.empty()) continue;
    energy.curves.push_back(
        {name, d.steps, d.energy, Mark::line_points, colour});
    momentum.curves.push_back({name,
                               {d.steps.begin() + 1, d.steps.end()},
                               {d.momentum.begin() + 1, d.momentum.end()},
                               Mark::line_points,
                               colour});
  }
  for (Panel* panel : {&energy, &momentum}) {
    panel->commands = {"set key right outside vertical maxrows 10",
                       "set tmargin 2"};
  }
  return {.panels = {energy, momentum},
          .columns = 1,
          .panel_width = 760,
          .panel_height = 330};
}

void write_durations(const std::vector<Duration>& durations, Page& page) {
  page.heading("Duration");
  page.text(
      "Two beams on a hinge of 1e7 N/m, without damping, struck and rotating "
      "freely at 0.05 of their critical speed, in steps of 10 us. Only the "
      "scheme changes their energy or angular momentum.");
  std::vector<std::vector<std::string>> rows;
  for (const Duration& d : durations) {
    const bool has_rows = !d.steps.empty();
    rows.push_back({dynamics::to_string(d.integrator),
                    to_string(d.verdict.kind),
                    has_rows ? fmt::format("{:.0e}", d.steps.back()) : "-",
                    has_rows ? fmt::format("{:.1e}", d.energy.back()) : "-",
                    has_rows ? fmt::format("{:.1e}", d.momentum.back()) : "-",
                    fmt::format("{:.0f}", d.verdict.seconds), d.verdict.text});
  }
  page.table({"integrator", "class", "steps", "energy error",
              "angular momentum", "wall time [s]", "message"},
             rows);
  page.figure(plot_durations(durations), "duration",
              "Errors of long runs over the number of their steps");
}

struct Refusals {
  int count = 0;
  std::string text;
  std::string cell;
};

void write_refusals(const std::vector<Sweep>& sweeps, Page& page) {
  std::map<std::string, Refusals> kinds;
  for (const Sweep& one : sweeps) {
    visit(one, [&](const Cell& cell, const Verdict& verdict) {
      if (verdict.kind != Kind::refused) return;
      Refusals& kind = kinds[find_kind(verdict.text)];
      if (kind.count++ > 0) return;
      kind.text = verdict.text;
      kind.cell = describe(cell);
    });
  }
  page.heading("Refusals");
  page.text(
      "Every kind of message with which cells were refused, with an example:");
  for (const auto& [kind, refusals] : kinds) {
    page.text(fmt::format("- {} times: *{}* ({})", refusals.count,
                          refusals.text, refusals.cell));
  }
  if (kinds.empty()) page.text("None was.");
}

void write_failures(const std::vector<Sweep>& sweeps, Page& page) {
  page.heading("Failures, and cells without a reference");
  bool is_empty = true;
  for (const Sweep& one : sweeps) {
    visit(one, [&](const Cell& cell, const Verdict& verdict) {
      const bool fails = verdict.kind == Kind::failed;
      if (!fails && (verdict.kind != Kind::inaccurate || verdict.error >= 0.0))
        return;
      is_empty = false;
      page.text(fmt::format("- {}{}: {}", fails ? "**failed**: " : "",
                            verdict.text, describe(cell)));
    });
  }
  if (is_empty) page.text("None.");
}

void write_cells(const std::vector<Sweep>& sweeps,
                 const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "map,integrator,bodies,length,slenderness,mass_ratio,stiffness,"
         "damping,spin,pulse,step,span,class,error,seconds\n";
  for (const Sweep& one : sweeps) {
    visit(one, [&](const Cell& cell, const Verdict& verdict) {
      out << fmt::format(
          "{},{},{},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{},{:.3g},"
          "{:.2f}\n",
          one.map.name, dynamics::to_string(cell.integrator), cell.bodies,
          cell.length, cell.slenderness, cell.mass_ratio, cell.stiffness,
          cell.damping, cell.spin, cell.pulse, cell.step, find_span(cell),
          to_string(verdict.kind), verdict.error, verdict.seconds);
    });
  }
  out.flush();
  if (!out) {
    throw InputError(fmt::format("'{}' cannot be written", file.string()));
  }
}

void check_claims(const std::vector<Sweep>& sweeps,
                  const std::vector<Duration>& durations, Page& page) {
  int cells = 0;
  int failures = 0;
  int stiff = 0;
  int accurate = 0;
  for (const Sweep& one : sweeps) {
    visit(one, [&](const Cell& cell, const Verdict& verdict) {
      ++cells;
      failures += verdict.kind == Kind::failed ? 1 : 0;
      if (one.map.name != "stiffness" || cell.step > 1.01e-5 ||
          cell.integrator != IntegratorKind::generalized_alpha) {
        return;
      }
      ++stiff;
      accurate += verdict.kind == Kind::accurate ? 1 : 0;
    });
  }
  for (const Duration& duration : durations) {
    ++cells;
    failures += duration.verdict.kind == Kind::failed ? 1 : 0;
  }
  page.check(failures == 0,
             fmt::format("of {} cells {} end in NaN or infinity, a wrong "
                         "result reported as a success, a crash or a hang.",
                         cells, failures));
  if (stiff > 0) {
    page.check(accurate == stiff,
               fmt::format("generalized-alpha is accurate at steps of 1 us and "
                           "10 us at every stiffness from 1e2 to 1e14 N/m: {} "
                           "of {} cells.",
                           accurate, stiff));
  }
  for (const Duration& duration : durations) {
    if (duration.integrator != IntegratorKind::generalized_alpha) continue;
    page.check(duration.verdict.kind == Kind::accurate &&
                   duration.steps.back() > 0.99e7,
               fmt::format("1e7 steps of generalized-alpha have an energy "
                           "error of less than 1 %: {:.2g}.",
                           duration.verdict.error));
  }
}

void write_map(const Sweep& one, const std::filesystem::path& folder,
               Page& page) {
  page.heading(one.map.title);
  const Counts counts = count(one);
  page.text(fmt::format(
      "{} cells accurate, {} stable but inaccurate, {} refused, {} failed.",
      counts[0], counts[1], counts[2], counts[3]));
  page.picture(draw(one.map, one.verdicts, folder / (one.map.name + ".png")),
               one.map.name,
               one.map.title + "; numbers: error in % of the motion's range");
}

void introduce(Page& page) {
  const Cell cell;
  page.text("# Scenes at the extremes");
  page.text(
      "Written by `bench_extremes`, including all text; do not edit. Beams of "
      "aluminium with a square section, end to end on hinges, free in space, "
      "rotate as one body, mostly about their long axis, and the last is "
      "struck at its tip by a half sine. Each is a mesh of hexahedra, reduced "
      "to four eigenmodes and the static-deformation modes of both ends, at "
      "level `coupled`. Unless a map varies it: " +
      describe(cell) + ".");
  page.text(
      "A cell is one run, in a process of its own, over about ten periods of a "
      "beam's bending, at least ten steps, and at most 1e5 (3e5 over the "
      "number of bodies). Its error is the largest distance of any point of a "
      "body from a converged run of the same scene at ten outputs, over the "
      "largest distance from the start that the converged run has. The latter "
      "is generalized-alpha with steps to a tolerance of a thousandth of that, "
      "or with 20 000 fixed steps where it agrees with 10 000 as well. Below 1 "
      "% a cell is *accurate*; below ten times the range *stable but "
      "inaccurate*, and so is one without a converged run (`?`). *Refused* is "
      "one that ends with an `InputError` or a `NumericalError`. NaN or "
      "infinity, a larger error reported as a success, any other exception, a "
      "crash or " +
      fmt::format("{:g}", kLimit) + " s of processor time is a *failure*.");
}

void write_page(const std::filesystem::path& folder, bool full,
                const std::optional<std::string>& only, Page& page) {
  Beams beams;
  std::vector<Map> maps = make_maps(full);
  std::erase_if(maps,
                [&](const Map& map) { return only && *only != map.name; });
  const std::vector<Sweep> sweeps = sweep(maps, beams);
  std::vector<Duration> durations;
  if (!only || *only == "duration") durations = run_durations(full, beams);
  if (sweeps.empty() && durations.empty()) {
    throw InputError(fmt::format("no map is called '{}'", *only));
  }
  introduce(page);
  check_claims(sweeps, durations, page);
  for (const Sweep& one : sweeps) write_map(one, folder, page);
  if (!durations.empty()) write_durations(durations, page);
  write_refusals(sweeps, page);
  write_failures(sweeps, page);
  write_cells(sweeps, folder / "data" / "cells.csv");
  page.write();
  if (!page.trouble().empty()) fmt::print("warning: {}\n", page.trouble());
}

}  // namespace
}  // namespace limber::bench

int main(int argc, char** argv) {
  std::string folder = "out/extremes";
  std::optional<std::string> only;
  bool full = false;
  CLI::App app("Sweeps scenes to extremes and draws what becomes of them");
  app.add_option("--out", folder, "Folder for the page and its pictures");
  app.add_flag("--full", full, "Finer grids, all integrators on all maps");
  app.add_option("--only", only, "One map alone, as its picture is called");
  CLI11_PARSE(app, argc, argv);
  try {
    limber::bench::Page page(folder);
    limber::bench::write_page(folder, full, only, page);
    fmt::print("{}/README.md: {} claims checked, {} failed\n", folder,
               page.checks(), page.failures());
    return page.failures() == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_extremes: {}\n", error.what());
    return 3;
  }
}
