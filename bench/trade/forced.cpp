// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "beam_choices.hpp"
#include "sections.hpp"
#include "split.hpp"

/// Scenes 2 and 3: the report's complex forcing and its impact, loads that turn
/// with the beam.
namespace limber::bench::trade {
namespace {

using flexbody::NodalMassKind;

constexpr double kWindow = 0.1;  // of the reference in half steps [s]
constexpr double kSmooth = 0.2;  // end of the run with a half-sine [s]
constexpr double kPulse = 0.01;  // its duration [s]

/// One of the two scenes.
struct Forced {
  std::string name;
  std::string title;
  double limit = 0.0;  ///< the report's error [-]
  int patterns = 0;    ///< static-deformation modes that the loads bring
  StepForces forces;
  std::string description;
};

struct Findings {
  std::vector<std::pair<std::string, Split>> splits;
  /// Physics and the reference's step together, at the start, with the
  /// reference's step and with half of it [-].
  double physics_at_step = 0.0;
  double physics_at_half = 0.0;
  /// `coupled` from `uncoupled`, the same basis and steps [-].
  double coupling = 0.0;
  Verdict verdict;
};

std::string name_exact(const Forced& scene, int vectors, bool has_loads) {
  return has_loads ? fmt::format("{} modes + {} static",
                                 vectors - scene.patterns, scene.patterns)
                   : fmt::format("{} modes", vectors);
}

Choice make_exact_of(const Forced& scene, int vectors, bool has_loads) {
  return make_exact(
      name_exact(scene, vectors, has_loads),
      make_basis(has_loads ? vectors - scene.patterns : vectors, has_loads),
      5e-3);
}

const Outcome& find_consistent(const Study& study) {
  return study.find(make_explicit(NodalMassKind::consistent, 1).name);
}

void add_runs(Study& study, const Forced& scene) {
  const IntegratorKind rk = IntegratorKind::runge_kutta_4;
  const IntegratorKind ga = IntegratorKind::generalized_alpha;
  add_whole_meshes(study);
  const auto ten = make_basis(10, false);
  const auto sixteen = make_basis(16, false);
  study.add(make_stepped("no modes", Fidelity::rigid, ten, rk, 5e-3));
  study.add(make_exact_of(scene, 4, false));
  study.add(make_exact_of(scene, 10, false));
  study.add(make_exact_of(scene, 16, false));
  study.add(make_exact_of(scene, 16, true));
  study.add(make_exact_of(scene, 40, false));
  study.add(make_stepped("16 modes", Fidelity::uncoupled, sixteen, rk, 1e-4));
  study.add(make_stepped("10 modes", Fidelity::one_way, ten, rk, 1e-4));
  study.add(make_stepped("10 modes", Fidelity::coupled, ten, ga, 1e-3));
  const IntegratorKind report = IntegratorKind::explicit_euler;
  for (const double step : {1e-3, 1e-4}) {
    study.add(
        make_stepped("16 modes", Fidelity::coupled, sixteen, report, step));
  }
  study.add(make_stepped("10 modes", Fidelity::coupled, ten, rk, 4e-4));
  study.add(make_stepped("10 modes", Fidelity::coupled, ten, rk, 2e-4));
  study.add(make_stepped("10 modes", Fidelity::coupled, ten, rk, 1e-4));
  study.add(make_stepped("16 modes", Fidelity::coupled, sixteen, rk, 1e-4));
  study.add(make_stepped("16 modes", Fidelity::coupled, sixteen, rk, 5e-5));
  study.add(make_stepped("40 modes", Fidelity::coupled, make_basis(40, false),
                         rk, 5e-5));
}

/// How far all modes, linear and exact, are from the whole mesh in the first
/// kWindow in steps of `step` [s].
double find_physics(const Study& study, const Forced& scene,
                    const FullModes& modes, double step) {
  Choice choice = make_reference();
  choice.step = step;
  choice.change = [](scene::Scene& changed) {
    changed.scenario.settings.end_time = kWindow;
    std::erase_if(changed.scenario.settings.output_times,
                  [](double t) { return t > kWindow + 1e-9; });
  };
  const Outcome run = study.simulate(choice);
  const MatrixX truth = find_deformation(run);
  const MatrixX all = respond_by_all(modes, project(modes, scene.forces),
                                     run.run.history.times);
  return (all - truth).norm() / truth.norm();
}

Findings find_all(const Study& study, const Forced& scene,
                  const FullModes& modes) {
  Findings findings;
  const MatrixX all = respond_by_all(modes, project(modes, scene.forces),
                                     study.reference().run.history.times);
  const IntegratorKind rk = IntegratorKind::runge_kutta_4;
  const auto add = [&](const Choice& exact, const Choice* stepped) {
    findings.splits.emplace_back(
        stepped == nullptr ? exact.name : stepped->name,
        split_error(study.reference(), all, study.find(exact.name),
                    stepped == nullptr ? nullptr : &study.find(stepped->name)));
  };
  for (const int vectors : {10, 16, 40}) {
    add(make_exact_of(scene, vectors, false), nullptr);
  }
  add(make_exact_of(scene, 16, true), nullptr);
  const auto ten = make_basis(10, false);
  const auto sixteen = make_basis(16, false);
  for (const double step : {2e-4, 1e-4}) {
    const Choice stepped =
        make_stepped("10 modes", Fidelity::coupled, ten, rk, step);
    add(make_exact_of(scene, 10, false), &stepped);
  }
  for (const double step : {1e-4, 5e-5}) {
    const Choice stepped =
        make_stepped("16 modes", Fidelity::coupled, sixteen, rk, step);
    add(make_exact_of(scene, 16, false), &stepped);
  }
  const auto take = [&](Fidelity level) {
    return find_deformation(
        study.find(make_stepped("16 modes", level, sixteen, rk, 1e-4).name));
  };
  const MatrixX coupled = take(Fidelity::coupled);
  findings.coupling =
      (take(Fidelity::uncoupled) - coupled).norm() / coupled.norm();
  findings.physics_at_step = find_physics(study, scene, modes, kFullStep);
  findings.physics_at_half = find_physics(study, scene, modes, kFullStep / 2);
  findings.verdict = judge_advice(
      study, make_stepped("advice", Fidelity::coupled, ten, rk, 5e-5));
  return findings;
}

/// The cheapest run of a level with fewer than `limit` as error.
const Outcome& find_cheapest(const Study& study, Fidelity level) {
  const Outcome* cheapest = nullptr;
  for (const Outcome* outcome : study.list()) {
    if (outcome->choice.level != level || !outcome->error) continue;
    if (cheapest == nullptr || outcome->online < cheapest->online) {
      cheapest = outcome;
    }
  }
  return *cheapest;
}

/// Of `coupled` at least `ratio` times cheaper, that with the least error.
const Outcome* find_best_coupled(const Study& study, double ratio) {
  const Outcome* best = nullptr;
  for (const Outcome* outcome : study.list()) {
    if (outcome->choice.level != Fidelity::coupled || !outcome->error) continue;
    if (find_lumped(study).online < ratio * outcome->online) continue;
    if (best == nullptr || outcome->displacement() < best->displacement()) {
      best = outcome;
    }
  }
  return best;
}

void claim_uncoupled(Context& context, const Study& study,
                     const Forced& scene) {
  const Outcome& run = study.find(make_exact_of(scene, 16, false).name);
  const double lumped = find_lumped(study).online / run.online;
  const double consistent = find_consistent(study).online / run.online;
  context.claims.push_back(
      {lumped >= 1000.0,
       fmt::format("{}: `uncoupled` with 16 eigenmodes in closed form is at "
                   "least 1000 times cheaper online than explicit `full`: "
                   "{:.0f} times (lumped mass), {:.0f} times (consistent); "
                   "{:.0f} times with every node's displacement at every "
                   "output (lumped).",
                   scene.title, lumped, consistent,
                   find_lumped(study).with_nodes / run.with_nodes),
       "what is left is the rigid motion's steps and the outputs."});
  context.claims.push_back(
      {run.displacement() < scene.limit,
       fmt::format("{}: its error as the report defines it is below {:.0f} %: "
                   "{} %.",
                   scene.title, 100.0 * scene.limit,
                   to_percent(run.displacement()))});
}

std::string show_rigid(const Outcome& run) {
  return to_percent(run.error->error.rigid.relative().value_or(0.0));
}

void claim_coupled(Context& context, const Study& study, const Forced& scene) {
  const Outcome& uncoupled = study.find(make_exact_of(scene, 16, false).name);
  const Outcome* best = find_best_coupled(study, 300.0);
  const Outcome& cheapest = find_cheapest(study, Fidelity::coupled);
  context.claims.push_back(
      {best != nullptr,
       fmt::format("{}: `coupled` is at least 300 times cheaper than explicit "
                   "`full` (lumped mass): {:.0f} times at best.",
                   scene.title, find_lumped(study).online / cheapest.online)});
  const Outcome& run = best == nullptr ? cheapest : *best;
  context.claims.push_back(
      {best != nullptr && run.displacement() < uncoupled.displacement(),
       fmt::format(
           "{}: with a smaller error than `uncoupled`: `{}` has {} % of "
           "the displacement and {} % of the deformation, `{}` {} % "
           "and {} % (rigid motion alone: {} % and {} %).",
           scene.title, run.choice.name, to_percent(run.displacement()),
           to_percent(run.deformation()), uncoupled.choice.name,
           to_percent(uncoupled.displacement()),
           to_percent(uncoupled.deformation()), show_rigid(run),
           show_rigid(uncoupled)),
       "the physics that `coupled` adds is far smaller than the truncation "
       "error of either basis here, and its steps add an error that the closed "
       "form does not have: in the modes' phases with Runge-Kutta, in the "
       "rigid motion with the report's scheme, which solves modes exactly."});
}

void claim_deformation(Context& context, const Forced& scene,
                       const Findings& findings) {
  const Split& eigen = findings.splits[1].second;
  const Split& mixed = findings.splits[3].second;
  const double least = std::min(eigen.truncation, mixed.truncation);
  context.claims.push_back(
      {least < 0.01,
       fmt::format("{}: with at most 16 vectors the basis omits less than 1 % "
                   "of the deformation: {} % (16 eigenmodes), {} % (with the "
                   "loads' static-deformation modes).",
                   scene.title, to_percent(eigen.truncation),
                   to_percent(mixed.truncation)),
       fmt::format("the load is discontinuous, which excites hundreds of "
                   "modes: no 16 vectors omit less than {} % at these outputs.",
                   to_percent(eigen.bound))});
}

void write_splits(Page& page, const Findings& findings) {
  page.text(
      "Sources of the error of deformation, one at a time, in percent of the "
      "reference's deformation. *Basis*: against all 1731 modes of the mesh, "
      "both linear and exact in time. *Step*: the same basis in steps against "
      "exact in time, with what `coupled` adds to `uncoupled`. *Physics*: all "
      "modes, linear and exact, against the nonlinear whole mesh: an upper "
      "bound, because it includes the error of the reference's step. *Best "
      "basis*: the remainder beyond that many singular values.");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, split] : findings.splits) {
    rows.push_back({name, to_percent(split.truncation), to_percent(split.bound),
                    split.step > 0.0 ? to_percent(split.step) : "0",
                    to_percent(split.physics)});
  }
  page.table({"choice", "basis %", "best basis %", "step %", "physics %"},
             rows);
  page.text(fmt::format(
      "Part of that bound due to the reference's step: over the first {} s the "
      "difference is {} % with its step, and {} % with half of it. The physics "
      "between `uncoupled` and `coupled`, in the same 16 modes and steps of "
      "0.1 ms, are {} %.",
      kWindow, to_percent(findings.physics_at_step),
      to_percent(findings.physics_at_half), to_percent(findings.coupling)));
}

void write(Page& page, const Context& context, const Study& study,
           const Forced& scene, const Findings& findings) {
  const Outcome& run = study.find(make_exact_of(scene, 16, false).name);
  const Outcome& lumped = find_lumped(study);
  page.heading(scene.title);
  page.text(fmt::format(
      "`uncoupled` with 16 eigenmodes is off by {} % of the displacement, {} % "
      "of the deformation alone, and costs {:.0f} times less than explicit "
      "finite elements; `coupled` adds only the cost of steps here. {}",
      to_percent(run.displacement()), to_percent(run.deformation()),
      lumped.online / run.online, scene.description));
  page.text(fmt::format(
      "The reference of cost is the whole mesh with its lumped mass, {:.1f} "
      "times cheaper than with the consistent one; but lumping changes the "
      "mass's moments on this coarse mesh, and causes an error of displacement "
      "of {} %. So the reference of errors has the consistent mass.",
      find_consistent(study).online / lumped.online,
      to_percent(lumped.displacement())));
  write_choices(page, context.folder, scene.name, scene.title, study, lumped);
  write_splits(page, findings);
  write_verdict(page, findings.verdict);
}

/// The impact as a half-sine of the same duration.
void smooth(scene::Scene& scene) {
  scene.scenario.settings.end_time = kSmooth;
  std::erase_if(scene.scenario.settings.output_times,
                [](double t) { return t > kSmooth + 1e-9; });
  for (scene::LoadSpec& load : scene.scenario.loads) {
    load.time = dynamics::Pulse{dynamics::PulseShape::half_sine, 0.0, kPulse};
  }
}

/// Errors of 16 vectors under the smooth impact, against `full`.
std::vector<std::pair<std::string, double>> study_smooth(
    const Forced& scene, const std::filesystem::path& cache) {
  Study study("impact", cache);
  const auto add = [](Choice choice) {
    choice.change = smooth;
    choice.repeats = 1;
    return choice;
  };
  study.add_reference(add(make_reference()));
  std::vector<std::pair<std::string, double>> errors;
  for (const bool has_loads : {false, true}) {
    const Outcome& run = study.add(add(make_exact_of(scene, 16, has_loads)));
    errors.emplace_back(run.choice.name, run.deformation());
  }
  return errors;
}

Writer study_forced(Context& context, const Forced& scene,
                    const FullModes& modes) {
  const auto study = std::make_shared<Study>(scene.name, context.cache);
  add_runs(*study, scene);
  const Findings findings = find_all(*study, scene, modes);
  claim_uncoupled(context, *study, scene);
  claim_coupled(context, *study, scene);
  claim_deformation(context, scene, findings);
  add_verdict_claim(context, scene.title, findings.verdict);
  return [study, scene, findings, &context](Page& page) {
    write(page, context, *study, scene, findings);
  };
}

}  // namespace

Writer study_complex(Context& context) {
  const Body beam = reduce_beam(make_recipe());
  return study_forced(
      context,
      {.name = "complex",
       .title = "Scene 2: complex forcing",
       .limit = 0.02,
       .patterns = 2,
       .forces = make_complex_forcing(*beam, 0.5),
       .description =
           "Two opposite edges are pulled along y, more strongly from 0.5 s "
           "on, by forces that rotate with the beam "
           "([scene](../scenes/complex.toml)); outputs every 5 ms for 1 s."},
      find_full_modes(false));
}

Writer study_impact(Context& context) {
  const Body beam = reduce_beam(make_recipe());
  const Forced scene{
      .name = "impact",
      .title = "Scene 3: impact",
      .limit = 0.04,
      .patterns = 1,
      .forces = make_strike(*beam, kPulse),
      .description =
          "A patch near the beam's end is hit for 10 ms by 100 N and 10 N "
          "([scene](../scenes/impact.toml)); outputs every 5 ms for 1 s."};
  const Writer write_scene =
      study_forced(context, scene, find_full_modes(false));
  const auto errors = study_smooth(scene, context.cache);
  context.claims.push_back(
      {errors[1].second < 0.01,
       fmt::format("Scene 3 with the same impact as a half-sine: deformation "
                   "within 1 % of `full` by 16 vectors: {} % ({}), {} % ({}).",
                   to_percent(errors[0].second), errors[0].first,
                   to_percent(errors[1].second), errors[1].first)});
  return [write_scene, errors](Page& page) {
    write_scene(page);
    page.text(fmt::format(
        "The same impact as a half-sine, {} s: deformation off by {} % with 16 "
        "eigenmodes, by {} % with the load's static-deformation mode in place "
        "of the last one. The discontinuity needs so many modes, not the "
        "impact.",
        kSmooth, to_percent(errors[0].second), to_percent(errors[1].second)));
  };
}

}  // namespace limber::bench::trade
