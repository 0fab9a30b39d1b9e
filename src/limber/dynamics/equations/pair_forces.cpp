// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/pair_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/flexbody/model/mode_products.hpp"

namespace limber::dynamics {
namespace {

// The world is the last.
std::size_t slot_of(BodyIndex body, const PairTerms& terms) {
  return body == kWorld ? terms.bodies.size() - 1 : index(body);
}

void set_pair_coordinates(const BodyModel& body, const SystemState& state,
                          ProductTerms& own, joints::PairBody& out) {
  const double* eta = state.eta.data() + body.offset;
  const double* etadot = state.etadot.data() + body.offset;
  out.modes = count_coordinates(body);
  out.eta = eta;
  out.etadot = etadot;
  if (paired_of(body).empty()) return;
  const int m = body.modes;
  own.eta.head(m) = state.eta.segment(body.offset, m);
  own.etadot.head(m) = state.etadot.segment(body.offset, m);
  flexbody::set_products(paired_of(body), eta, own.eta.data() + m);
  flexbody::set_product_rates(paired_of(body), eta, etadot,
                              own.etadot.data() + m);
  out.eta = own.eta.data();
  out.etadot = own.etadot.data();
}

void set_body(const SystemModel& model, const SystemState& state, std::size_t b,
              const Matrix3& R_WB, ProductTerms& own, joints::PairBody& out) {
  const BodyState& rigid = state.bodies[b];
  out.R_WB = R_WB;
  out.p_WB = rigid.p_WB;
  out.v_WB_W = rigid.v_WB_W;
  out.w_WB_B = rigid.w_WB_B;
  set_pair_coordinates(model.bodies[b], state, own, out);
}

void set_full_body(const SystemModel& model, const SystemState& state,
                   std::size_t f, const MeanFrame& frame, ProductTerms& own,
                   joints::PairBody& out) {
  const FullModel& full = model.full_bodies[f];
  const Matrix3 R_BH = frame.R_HB.transpose();
  out.R_WB = state.X_WH[f].R * frame.R_HB;
  out.p_WB = state.X_WH[f] * frame.p_HB;
  out.v_WB_W = state.X_WH[f].R * frame.v_H;
  out.w_WB_B = R_BH * frame.w_H;
  const ConstNodes u_H = nodes_of(full, state.u_H);
  const ConstNodes udot_H = nodes_of(full, state.udot_H);
  double most_u = 0.0;
  double most_udot = 0.0;
  for (Eigen::Index n = 0; n < u_H.cols(); ++n) {
    const Vector3 arm_H = full.mesh->x_B.col(n) + u_H.col(n) - frame.p_HB;
    const Vector3 deformed = R_BH * arm_H - full.mesh->x_B.col(n);
    const Vector3 rate =
        R_BH * (udot_H.col(n) - frame.v_H - frame.w_H.cross(arm_H));
    own.eta.segment<3>(3 * n) = deformed;
    own.etadot.segment<3>(3 * n) = rate;
    most_u = std::max(most_u, deformed.norm());
    most_udot = std::max(most_udot, rate.norm());
  }
  own.eta[full.dofs()] = most_u;
  own.etadot[full.dofs()] = most_udot;
  out.modes = static_cast<int>(full.dofs() + 1);
  out.eta = own.eta.data();
  out.etadot = own.etadot.data();
}

void set_any_body(const SystemModel& model, const SystemState& state,
                  BodyIndex b, ProductTerms& own, joints::PairBody& out) {
  if (b == kWorld) return;
  const int f = model.bodies[index(b)].full;
  if (f < 0) {
    set_body(model, state, index(b),
             state.bodies[index(b)].quat_WB.toRotationMatrix(), own, out);
    return;
  }
  MeanFrame frame;
  calc_mean_frame(model, model.full_bodies[index(f)], state, frame);
  set_full_body(model, state, index(f), frame, own, out);
}

// f_n = R_HB Phi_n' force_B of each node.
template <typename Field>
void add_to_nodes(const joints::PairPlace& place, const Matrix3& R_HB,
                  const Vector3& force_B, Field&& force_H) {
  for (Eigen::Index n = 0; n < force_H.cols(); ++n) {
    const Vector3 fraction =
        place.Phi_B.middleCols<3>(3 * n).transpose() * force_B;
    force_H.col(n) += R_HB * fraction;
  }
}

void add_force(const SystemModel& model, BodyIndex body,
               const joints::PairPlace& place, const Vector3& arm_B,
               const Vector3& force_W, SystemTerms& terms) {
  if (body == kWorld) return;
  if (const int f = model.bodies[index(body)].full; f >= 0) {
    const joints::PairBody& moving = terms.pairs.bodies[index(body)];
    add_to_nodes(place, terms.full[index(f)].frame.R_HB,
                 moving.R_WB.transpose() * force_W, terms.full[index(f)].force);
    return;
  }
  BodyTerms& t = terms.bodies[index(body)];
  const Vector3 force_B = t.R_WB.transpose() * force_W;
  t.force_W += force_W;
  t.moment_B += arm_B.cross(force_B);
  add_modal_force(model.bodies[index(body)], place, force_B, t,
                  terms.products[index(body)]);
}

void add_body_residual(const SystemModel& model, BodyIndex b,
                       const joints::PairPlace& place, const Vector3& arm_B,
                       const Vector3& force_W, const SystemTerms& terms,
                       VectorX& residual) {
  if (b == kWorld) return;
  const BodyModel& body = model.bodies[index(b)];
  if (body.full >= 0) {
    const FullModel& full = model.full_bodies[index(body.full)];
    Nodes nodes(residual.data() + first_node_row(model) + full.first, 3,
                full.mesh->node_count());
    add_to_nodes(place, terms.full[index(body.full)].frame.R_HB,
                 -(terms.pairs.bodies[index(b)].R_WB.transpose() * force_W),
                 nodes);
    return;
  }
  const Eigen::Index row = body.row;
  const Vector3 force_B = terms.bodies[index(b)].R_WB.transpose() * force_W;
  add_modal_residual(body, place, terms.pairs.bodies[index(b)].eta, force_B,
                     residual.data() + row + 6);
  if (!body.has_rigid_motion()) return;
  residual.segment<3>(row) -= force_W;
  residual.segment<3>(row + 3) -= arm_B.cross(force_B);
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

void add_modal_force(const BodyModel& body, const joints::PairPlace& place,
                     const Vector3& force_B, BodyTerms& terms,
                     ProductTerms& products) {
  for (int k = 0; k < body.modes; ++k) {
    terms.modal_force[k] += place.Phi_B.col(k).dot(force_B);
  }
  for (Eigen::Index pair = 0; pair < products.force.size(); ++pair) {
    products.force[pair] += place.Phi_B.col(body.modes + pair).dot(force_B);
  }
}

void add_modal_residual(const BodyModel& body, const joints::PairPlace& place,
                        const double* eta, const Vector3& force_B,
                        double* residual) {
  for (int k = 0; k < body.modes; ++k) {
    residual[k] -= place.Phi_B.col(k).dot(force_B);
  }
  flexbody::for_each_product(
      paired_of(body), [&](Eigen::Index pair, int i, int j, bool is_square) {
        const double f = place.Phi_B.col(body.modes + pair).dot(force_B);
        residual[i] -= f * eta[j];
        if (!is_square) residual[j] -= f * eta[i];
      });
}

void add_product_forces(const SystemModel& model, const SystemState& state,
                        SystemTerms& terms) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (terms.products[b].force.size() == 0) continue;
    const BodyModel& body = model.bodies[b];
    flexbody::add_product_forces(
        paired_of(body), terms.products[b].force.data(),
        state.eta.data() + body.offset, terms.bodies[b].modal_force.data());
  }
}

ProductTerms make_product_terms(const SystemModel& model, BodyIndex b) {
  const BodyModel& body = model.bodies[index(b)];
  const auto is_in_pair = [b](const Pair& pair) {
    return pair.body_A == b || pair.body_B == b;
  };
  const auto is_loaded = [b](const BodyLoad& load) { return load.body == b; };
  const bool has_some =
      body.clamped ||
      std::any_of(model.pairs.begin(), model.pairs.end(), is_in_pair) ||
      std::any_of(model.body_loads.begin(), model.body_loads.end(), is_loaded);
  if (!has_some) return {};
  if (body.full >= 0) {
    const Eigen::Index size = count_pair_coordinates(model, b);
    return {VectorX(), VectorX::Zero(size), VectorX::Zero(size)};
  }
  if (paired_of(body).empty()) return {};
  const int size = count_coordinates(body);
  return {VectorX::Zero(size - body.modes), VectorX::Zero(size),
          VectorX::Zero(size)};
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
    ProductTerms& own = terms.products[b];
    if (const int f = model.bodies[b].full; f >= 0) {
      set_full_body(model, state, index(f), terms.full[index(f)].frame, own,
                    terms.pairs.bodies[b]);
    } else {
      set_body(model, state, b, terms.bodies[b].R_WB, own,
               terms.pairs.bodies[b]);
    }
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
      add_force(model, pair.body_A, point.on_A, point.acting.A, -point.force_W,
                terms);
      add_force(model, pair.body_B, point.on_B, point.acting.B, point.force_W,
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
  if (model.full_bodies.empty()) return false;
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    if (terms.pairs.responses[i].points().empty()) continue;
    for (const BodyIndex b : {model.pairs[i].body_A, model.pairs[i].body_B}) {
      if (b != kWorld && model.bodies[index(b)].full >= 0) return true;
    }
  }
  return false;
}

void add_residual(const SystemModel& model, const Pair& pair,
                  const joints::PairPoint& point, const Vector3& force_W,
                  const SystemTerms& terms, VectorX& residual) {
  add_body_residual(model, pair.body_A, point.on_A, point.acting.A, -force_W,
                    terms, residual);
  add_body_residual(model, pair.body_B, point.on_B, point.acting.B, force_W,
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
