// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>

#include "sections.hpp"

/// Scene 4: the capture arm, struck.
namespace limber::bench::trade {
namespace {

constexpr double kStep = 1e-3;         // of the reference too [s]
constexpr double kFineStep = 1.25e-4;  // to measure its error [s]

Choice make_choice(const std::string& name, Fidelity level,
                   scene::BasisChoice basis, double step) {
  return {.name = fmt::format("{}, {}, {:g} s", to_string(level), name, step),
          .label = fmt::format("{} {:g} s", name, step),
          .level = level,
          .basis = basis,
          .step = step};
}

scene::BasisChoice make_basis(int eigenmodes, bool has_interfaces) {
  return {
      .eigenmodes = eigenmodes, .interfaces = has_interfaces, .loads = false};
}

const scene::BasisChoice kUsual = make_basis(6, true);

Choice make_full() {
  return {.name = "full on all six links, 0.001 s",
          .level = Fidelity::full,
          .step = kStep,
          .repeats = 1};
}

/// The link that carries the struck finger as a whole mesh.
Choice make_mixed() {
  Choice mixed = make_choice("mixed", Fidelity::coupled, kUsual, kStep);
  mixed.name = "coupled, lower_1 full, 6 + interfaces, 0.001 s";
  mixed.label = "lower_1 full";
  mixed.links = {{"lower_1", Fidelity::full}};
  mixed.repeats = 1;
  return mixed;
}

Choice make_usual(Fidelity level, double step = kStep) {
  return make_choice("6 + interfaces", level, kUsual, step);
}

void add_runs(Study& study) {
  study.add_reference(make_full());
  study.add(make_mixed());
  study.add(make_choice("no modes", Fidelity::rigid, kUsual, kStep));
  study.add(make_usual(Fidelity::uncoupled));
  study.add(make_usual(Fidelity::one_way));
  study.add(
      make_choice("6 modes", Fidelity::coupled, make_basis(6, false), kStep));
  study.add(
      make_choice("18 modes", Fidelity::coupled, make_basis(18, false), kStep));
  study.add(make_choice("0 + interfaces", Fidelity::coupled,
                        make_basis(0, true), kStep));
  study.add(make_usual(Fidelity::coupled));
  study.add(make_choice("20 + interfaces", Fidelity::coupled,
                        make_basis(20, true), kStep));
}

/// Deformation of one run against another, all links [-].
double compare(const Outcome& one, const Outcome& other) {
  return results::calc_motion_error(
             {one.run.built.model, one.run.history.states},
             {other.run.built.model, other.run.history.states})
      .error.deformation.relative()
      .value_or(0.0);
}

void write(Page& page, const Context& context, const Study& study,
           const Verdict& verdict) {
  const Outcome& usual = study.find(make_usual(Fidelity::coupled).name);
  const Outcome finer =
      study.simulate(make_usual(Fidelity::coupled, kFineStep));
  const Outcome& plain = study.find("coupled, 6 modes, 0.001 s");
  const Outcome& mixed = study.find(make_mixed().name);
  page.heading("Scene 4: the capture arm, struck");
  page.text(fmt::format(
      "The interfaces' static-deformation modes are essential: with them "
      "`coupled` is {} % off in displacement and {} % in deformation, {:.0f} "
      "times cheaper than whole meshes; with six eigenmodes alone {} %. "
      "`uncoupled` in the same basis is {} % off. One fingertip is hit by 100 "
      "N for 10 ms ([scene](../scenes/struck_finger.toml)); six links bend, "
      "outputs each ms for 50 ms. The reference of cost is the reference.",
      to_percent(usual.displacement()), to_percent(usual.deformation()),
      study.reference().online / usual.online, to_percent(plain.deformation()),
      to_percent(
          study.find(make_usual(Fidelity::uncoupled).name).deformation())));
  page.text(fmt::format(
      "All runs, including the reference, take generalized-alpha steps of 1 "
      "ms, so that differences are due to basis and level only. The error of "
      "the step is larger: the deformation of `coupled` is {} % from its own "
      "in steps of 0.125 ms, which cost {:.0f} times more. A mixed scene with "
      "one whole mesh, of the link that carries the struck finger, is {} % off "
      "in deformation.",
      to_percent(compare(usual, finer)), finer.online / usual.online,
      to_percent(mixed.deformation())));
  write_choices(page, context.folder, "arm", "capture arm, struck", study,
                study.reference());
  write_verdict(page, verdict);
}

}  // namespace

Writer study_arm(Context& context) {
  const auto study = std::make_shared<Study>("struck_finger", context.cache);
  add_runs(*study);
  const Verdict verdict = judge_advice(*study, make_usual(Fidelity::coupled));
  add_verdict_claim(context, "Scene 4: arm", verdict);
  return [study, verdict, &context](Page& page) {
    write(page, context, *study, verdict);
  };
}

}  // namespace limber::bench::trade
