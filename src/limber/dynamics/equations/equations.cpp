// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/equations.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/equations/attachments.hpp"
#include "limber/dynamics/equations/coupler_forces.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/equations/transmission.hpp"
#include "limber/dynamics/system/interpolation.hpp"

namespace limber::dynamics {
namespace {

void apply_load(const SystemModel& model, const SystemState& state,
                const Load& load, Side side, SystemTerms& terms) {
  const double factor = evaluate(load.function, now_of(state, side));
  if (factor == 0.0) return;
  const Attachment& attachment = model.attachments[index(load.where)];
  if (attachment.body == kWorld) return;
  visit_body(model, index(attachment.body), [&](const auto& own) {
    own.add_load(load, factor, state, terms);
  });
}

void apply_body_load(const SystemModel& model, const SystemState& state,
                     const BodyLoad& load, Side side, SystemTerms& terms) {
  const Eigen::Index i = find_interval(load.history.times, state.t, side);
  if (i < 0) return;
  visit_body(model, index(load.body), [&](const auto& own) {
    own.add_nodal_load(load, i, state, terms);
  });
}

}  // namespace

void clear_forces(const SystemModel& model, SystemTerms& terms) {
  visit_bodies(model, [&](const auto& own) { own.clear_forces(terms); });
}

SystemTerms make_terms(const SystemModel& model) {
  SystemTerms terms;
  terms.attachments.resize(model.attachments.size());
  visit_bodies(model, [&](const auto& own) { own.append_terms(terms); });
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    terms.products.push_back(make_product_terms(model, BodyIndex(b)));
  }
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    const Attachment& attachment = model.attachments[i];
    if (attachment.body == kWorld) continue;
    visit_body(model, index(attachment.body), [&](const auto& own) {
      own.size_attachment(attachment, terms.attachments[i], terms);
    });
  }
  terms.couplers.resize(model.couplers.size());
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    if (!joints::is_ideal(model.couplers[c].law)) continue;
    terms.couplers[c].ideal = static_cast<int>(terms.constraints.size());
    terms.constraints.emplace_back();
  }
  terms.transmissions = make_transmission_terms(model);
  terms.pairs = make_pair_terms(model);
  return terms;
}

void calc_inertia_terms(const SystemModel& model, const SystemState& state,
                        SystemTerms& terms) {
  visit_bodies(model, [&](const auto& own) { own.calc_inertia(state, terms); });
}

void calc_forces(const SystemModel& model, const SystemState& state, Side side,
                 SystemTerms& terms, WrenchSource source) {
  visit_bodies(model, [&](const auto& own) { own.reset_forces(state, terms); });
  calc_attachments(model, state, terms);
  apply_couplers(model, state, now_of(state, side), source, terms);
  apply_pairs(model, state, now_of(state, side), terms);
  for (const Load& load : model.loads) {
    apply_load(model, state, load, side, terms);
  }
  for (const BodyLoad& load : model.body_loads) {
    apply_body_load(model, state, load, side, terms);
  }
  visit_bodies(model,
               [&](const auto& own) { own.complete_forces(state, terms); });
}

void calc_terms(const SystemModel& model, const SystemState& state, Side side,
                SystemTerms& terms, WrenchSource source) {
  calc_inertia_terms(model, state, terms);
  calc_forces(model, state, side, terms, source);
}

void solve_accelerations(const SystemModel& model, const SystemTerms& terms,
                         VectorX& accelerations) {
  visit_bodies(model, [&](const auto& own) {
    own.solve_acceleration(terms, accelerations);
  });
}

void calc_residual(const SystemModel& model, const VectorX& acceleration,
                   SystemTerms& terms, VectorX& residual) {
  visit_bodies(model, [&](const auto& own) {
    own.calc_residual(acceleration, terms, residual);
  });
}

}  // namespace limber::dynamics
