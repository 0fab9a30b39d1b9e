// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/pair_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/system/body_model.hpp"

namespace limber::dynamics {
namespace {

// The world is the last.
std::size_t slot_of(BodyIndex body, const PairTerms& terms) {
  return body == kWorld ? terms.bodies.size() - 1 : index(body);
}

void set_any_body(const SystemModel& model, const SystemState& state,
                  BodyIndex b, ProductTerms& own, joints::PairBody& out) {
  if (b == kWorld) return;
  visit_body(model, index(b),
             [&](const auto& body) { body.set_pair_body(state, own, out); });
}

void add_force(const SystemModel& model, BodyIndex body, const PairForce& force,
               SystemTerms& terms) {
  if (body == kWorld) return;
  visit_body(model, index(body),
             [&](const auto& own) { own.add_force(force, terms); });
}

void add_body_residual(const SystemModel& model, BodyIndex body,
                       const PairForce& force, const SystemTerms& terms,
                       VectorX& residual) {
  if (body == kWorld) return;
  visit_body(model, index(body), [&](const auto& own) {
    own.add_force_residual(force, terms, residual);
  });
}

}  // namespace

PairMotion::PairMotion(const SystemModel& model, const Pair& pair) {
  const auto make = [&](BodyIndex b) {
    return b == kWorld ? ProductTerms{} : make_product_terms(model, b);
  };
  coordinates_A_ = make(pair.body_A);
  coordinates_B_ = make(pair.body_B);
}

joints::PairBodies PairMotion::set(const SystemModel& model, const Pair& pair,
                                   const SystemState& state) {
  set_any_body(model, state, pair.body_A, coordinates_A_, A_);
  set_any_body(model, state, pair.body_B, coordinates_B_, B_);
  return bodies();
}

PairMotion find_pair_motion(const SystemModel& model, const Pair& pair,
                            const SystemState& state) {
  PairMotion motion(model, pair);
  motion.set(model, pair, state);
  return motion;
}

ProductTerms make_product_terms(const SystemModel& model, BodyIndex b) {
  const BodyModel& body = model.bodies[index(b)];
  const auto is_in_pair = [b](const Pair& pair) {
    return pair.body_A == b || pair.body_B == b;
  };
  const auto is_loaded = [b](const BodyLoad& load) { return load.body == b; };
  const bool has_some =
      body.is_held() ||
      std::any_of(model.pairs.begin(), model.pairs.end(), is_in_pair) ||
      std::any_of(model.body_loads.begin(), model.body_loads.end(), is_loaded);
  if (!has_some) return {};
  return visit_body(model, index(b),
                    [](const auto& own) { return own.make_products(); });
}

joints::PairResponse make_response(const SystemModel& model, const Pair& pair) {
  return {pair.law->most_points(), count_pair_coordinates(model, pair.body_A),
          count_pair_coordinates(model, pair.body_B),
          pair.law->couples_points()};
}

PairTerms make_pair_terms(const SystemModel& model) {
  PairTerms terms;
  if (model.pairs.empty()) return terms;
  terms.bodies.resize(model.bodies.size() + 1);
  std::vector<bool> is_in(model.bodies.size() + 1, false);
  for (const Pair& pair : model.pairs) {
    for (const BodyIndex b : {pair.body_A, pair.body_B}) {
      is_in[slot_of(b, terms)] = true;
    }
    terms.responses.push_back(make_response(model, pair));
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (is_in[b]) terms.members.push_back(b);
  }
  return terms;
}

joints::PairBodies find_bodies(const Pair& pair, const PairTerms& terms) {
  return {terms.bodies[slot_of(pair.body_A, terms)],
          terms.bodies[slot_of(pair.body_B, terms)]};
}

void set_pair_bodies(const SystemModel& model, const SystemState& state,
                     SystemTerms& terms) {
  for (const std::size_t b : terms.pairs.members) {
    visit_body(model, b, [&](const auto& own) {
      own.set_pair_body(state, terms, terms.products[b], terms.pairs.bodies[b]);
    });
  }
}

void check_finite(const joints::PairResponse& response) {
  bool is_finite = std::isfinite(response.energy) &&
                   std::isfinite(response.dissipation) &&
                   std::isfinite(response.slip_power);
  for (const joints::PairPoint& point : response.points()) {
    is_finite = is_finite && point.force_W.allFinite() &&
                point.stiffness.allFinite() && point.damping.allFinite();
  }
  if (is_finite) return;
  throw NumericalError(
      "its force, energy or stiffness is NaN or too large; a smaller step may "
      "help");
}

void throw_pair(const std::string& name, double t,
                const NumericalError& error) {
  throw NumericalError(
      fmt::format("pair '{}' at t = {:.9g} s: {}", name, t, error.what()));
}

void apply_pairs(const SystemModel& model, const SystemState& state,
                 const EvaluationTime& now, SystemTerms& terms) {
  set_pair_bodies(model, state, terms);
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    const Pair& pair = model.pairs[i];
    joints::PairResponse& response = terms.pairs.responses[i];
    response.clear();
    if (is_far(state, i)) continue;
    const joints::PairBodies bodies = find_bodies(pair, terms.pairs);
    name_pair(pair.name, now.t, [&] {
      pair.law->evaluate(bodies, now, memory_of(pair, state), response);
      check_finite(response);
    });
    for (joints::PairPoint& point : response.points()) {
      point.acting = {find_arm(bodies.A, point.on_A),
                      find_arm(bodies.B, point.on_B)};
      point.moving = point.acting;
      point.velocity_W = find_velocity(bodies.B, point.on_B) -
                         find_velocity(bodies.A, point.on_A);
      add_force(model, pair.body_A,
                {point.on_A, point.acting.A, -point.force_W}, terms);
      add_force(model, pair.body_B, {point.on_B, point.acting.B, point.force_W},
                terms);
    }
  }
}

bool has_points(const SystemTerms& terms) {
  return std::any_of(terms.pairs.responses.begin(), terms.pairs.responses.end(),
                     [](const joints::PairResponse& response) {
                       return !response.points().empty();
                     });
}

bool acts_on_nodes(const SystemModel& model, const SystemTerms& terms) {
  if (model.nodal_count == 0) return false;
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    if (terms.pairs.responses[i].points().empty()) continue;
    for (const BodyIndex b : {model.pairs[i].body_A, model.pairs[i].body_B}) {
      if (b != kWorld && !has_dense_block(model, index(b))) return true;
    }
  }
  return false;
}

void add_residual(const SystemModel& model, const Pair& pair,
                  const joints::PairPoint& point, const Vector3& force_W,
                  const SystemTerms& terms, VectorX& residual) {
  add_body_residual(model, pair.body_A, {point.on_A, point.acting.A, -force_W},
                    terms, residual);
  add_body_residual(model, pair.body_B, {point.on_B, point.acting.B, force_W},
                    terms, residual);
}

PairCommit::PairCommit(const SystemModel& model) : model_(model) {
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    if (model.pairs[i].law->memory_size() == 0) continue;
    pairs_.push_back(i);
    scratch_.push_back(make_response(model, model.pairs[i]));
    motions_.emplace_back(model, model.pairs[i]);
  }
}

void PairCommit::operator()(SystemState& state) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (is_far(state, pairs_[i])) continue;
    const Pair& pair = model_.pairs[pairs_[i]];
    pair.law->commit(motions_[i].set(model_, pair, state), state.t,
                     memory_of(pair, state), scratch_[i]);
  }
}

}  // namespace limber::dynamics
