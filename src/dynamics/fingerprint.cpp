// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/fingerprint.hpp"

#include "common/digest.hpp"
#include "dynamics/archives.hpp"
#include "dynamics/equations.hpp"
#include "dynamics/landmarks.hpp"

namespace limber::dynamics {
namespace {

void add_settings(const SimulationSettings& settings, Digest& digest) {
  digest.add(settings.integrator);
  digest.add(settings.end_time);
  digest.add(settings.step);
  digest.add(settings.tolerance);
  for (const StepChange& change : settings.step_changes) {
    digest.add(change.from);
    digest.add(change.step);
  }
  digest.add(settings.output_times);
  digest.add(settings.most_steps);
  digest.add(settings.rho_inf);
  digest.add(settings.newton_tolerance);
  digest.add(settings.newton_iterations);
  digest.add(settings.exact_modes);
}

void add_body(const BodyModel& body, Digest& digest) {
  digest.add(body.name);
  digest.add(body.fidelity);
  digest.add(body.clamped);
  digest.add(body.mass);
  digest.add(MatrixX(body.J0));
  for (const VectorX& values : {body.lambda, body.damping}) {
    digest.add(MatrixX(values));
  }
  digest.add(MatrixX(body.inertia->J1));
  digest.add(body.inertia->J2);
  digest.add(body.inertia->beta);
  digest.add(MatrixX(body.P));
}

void add_forces(const SystemTerms& terms, Digest& digest) {
  for (const BodyTerms& body : terms.bodies) {
    digest.add(body.force_W);
    digest.add(body.moment_B);
    digest.add(MatrixX(body.modal_force));
  }
  for (const FullTerms& full : terms.full) {
    digest.add(MatrixX(full.force));
    digest.add(MatrixX(full.internal));
  }
  digest.add(terms.load_power);
}

}  // namespace

std::string find_fingerprint(const SystemModel& model,
                             const SystemState& initial,
                             const SimulationSettings& settings) {
  Digest digest;
  add_settings(settings, digest);
  for (const BodyModel& body : model.bodies) add_body(body, digest);
  for (const Coupler& coupler : model.couplers) digest.add(coupler.name);
  Archive archive;
  SystemState state = initial;
  archive(state);
  digest.add(archive.numbers());
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  add_forces(terms, digest);
  for (const Landmark& mark : find_landmarks(model, initial.t, settings)) {
    if (mark.is_output && !mark.is_jump) continue;
    state.t = mark.time;
    calc_terms(model, state, Side::left, terms);
    add_forces(terms, digest);
  }
  return digest.text();
}

}  // namespace limber::dynamics
