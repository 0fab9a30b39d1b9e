// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>

#include "beam_choices.hpp"
#include "sections.hpp"

/// Scene 1: the report's accelerating rotation.
namespace limber::bench::trade {
namespace {

void add_runs(Study& study) {
  const IntegratorKind rk = IntegratorKind::runge_kutta_4;
  const IntegratorKind ga = IntegratorKind::generalized_alpha;
  add_whole_meshes(study);
  const auto ten = make_basis(10, false);
  const auto mixed = make_basis(10, true);
  study.add(make_stepped("no modes", Fidelity::rigid, ten, rk, 5e-3));
  study.add(make_stepped("10 modes", Fidelity::uncoupled, ten, ga, 1e-3));
  study.add(make_stepped("10 modes", Fidelity::uncoupled, ten, rk, 1e-4));
  study.add(make_stepped("10 modes", Fidelity::one_way, ten, rk, 1e-4));
  study.add(make_stepped("10 modes", Fidelity::coupled, ten, ga, 1e-3));
  study.add(make_stepped("10 modes", Fidelity::coupled, ten, rk, 2e-4));
  study.add(make_stepped("10 modes", Fidelity::coupled, ten, rk, 1e-4));
  study.add(make_stepped("10 + loads", Fidelity::coupled, mixed, rk, 2e-5));
  study.add(make_stepped("40 modes", Fidelity::coupled, make_basis(40, false),
                         rk, 5e-5));
}

void write(Page& page, const Context& context, const Study& study,
           const Verdict& verdict) {
  const std::string fast = "uncoupled, 10 modes, generalized-alpha 0.001 s";
  const Outcome& cheap = study.find(fast);
  const Outcome& fine = study.find("coupled, 10 modes, Runge-Kutta 0.0001 s");
  const Outcome& lumped = find_lumped(study);
  page.heading("Scene 1: accelerating rotation");
  page.text(fmt::format(
      "All levels agree in the beam's displacement to {} %: `rigid` suffices "
      "for it, and `uncoupled` in steps of 1 ms costs {:.0f} times less than "
      "the whole mesh. The deformation is different: a load applied at once "
      "excites hundreds of modes, and ten eigenmodes are {} % off at any "
      "level, even in steps of 0.1 ms. A couple of 100 N on the end faces, "
      "fixed in space ([scene](../scenes/rotation.toml)); outputs every 5 ms "
      "for 0.5 s. The reference of cost is the whole mesh with lumped mass by "
      "central differences; the reference of errors has the consistent mass.",
      to_percent(cheap.displacement()), lumped.online / cheap.online,
      to_percent(fine.deformation())));
  write_choices(page, context.folder, "rotation", "accelerating rotation",
                study, lumped);
  write_verdict(page, verdict);
}

}  // namespace

Writer study_rotation(Context& context) {
  const auto study = std::make_shared<Study>("rotation", context.cache);
  add_runs(*study);
  const Verdict verdict = judge_advice(
      *study, make_stepped("advice", Fidelity::coupled, make_basis(10, false),
                           IntegratorKind::runge_kutta_4, 5e-5));
  add_verdict_claim(context, "Scene 1: accelerating rotation", verdict);
  return [study, verdict, &context](Page& page) {
    write(page, context, *study, verdict);
  };
}

}  // namespace limber::bench::trade
