// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/exact_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/simulation/modal_loads.hpp"
#include "limber/dynamics/system/body_model.hpp"

namespace limber::dynamics {
namespace {

// Number of times at which energies are sampled to find the modes that move.
constexpr int kEnergyLooks = 256;
constexpr double kExcited = 1e-6;  // of the largest of a mode of the body
constexpr double kLooksAPeriod = 10.0;

void drop_modes(BodyModel& body) {
  body.modes = 0;
  body.elasticity = {};
  body.damping.resize(0);
  body.inertia = std::make_shared<const ModalInertia>();
  body.P.resize(3, 0);
}

// [rad/s]
double find_fastest(const flexbody::ModalLoads& loads) {
  double fastest = 0.0;
  for (const flexbody::SinusoidalLoad& load : loads.sinusoids) {
    if (load.cosine.isZero(0.0) && load.sine.isZero(0.0)) continue;
    fastest = std::max(fastest, load.omega);
  }
  return fastest;
}

}  // namespace

ExactModes::ExactModes(const SystemModel& model, const SystemState& start)
    : model_(model), rest_(model), start_(start.t) {
  rest_.modal_count = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    BodyModel& left = rest_.bodies[b];
    left.offset = rest_.modal_count;
    left.row = 6 * static_cast<Eigen::Index>(b) + left.offset;
    const auto index = static_cast<BodyIndex>(b);
    if (has_closed_modal_loads(model, index)) {
      const flexbody::ModalState state{
          start.t, start.eta.segment(body.offset, body.modes),
          start.etadot.segment(body.offset, body.modes)};
      const flexbody::ModalLoads loads = find_modal_loads(model, index, start);
      const VectorX& lambda = require_eigenvalues(body, "their closed form");
      parts_.push_back({body.offset,
                        lambda,
                        {lambda, body.damping, loads, state},
                        {},
                        find_fastest(loads),
                        {},
                        {}});
      count_ += body.modes;
      drop_modes(left);
    }
    rest_.modal_count += left.modes;
  }
  for (Attachment& attachment : rest_.attachments) {
    if (attachment.body == kWorld) continue;
    const int modes =
        rest_.bodies[static_cast<std::size_t>(attachment.body)].modes;
    if (modes > 0) continue;
    attachment.Phi_B.resize(3, 0);
    attachment.Psi_B.resize(3, 0);
  }
}

bool ExactModes::has_motion_left() const {
  for (std::size_t b = 0; b < rest_.bodies.size(); ++b) {
    const UnknownRanges unknowns = list_unknowns(rest_, b);
    if (unknowns.begin() != unknowns.end()) return true;
  }
  return false;
}

SystemState ExactModes::take_rest(const SystemState& whole) const {
  SystemState rest = whole;
  rest.eta.resize(rest_.modal_count);
  rest.etadot.resize(rest_.modal_count);
  for (std::size_t b = 0; b < rest_.bodies.size(); ++b) {
    const BodyModel& left = rest_.bodies[b];
    const int from = model_.bodies[b].offset;
    rest.eta.segment(left.offset, left.modes) =
        whole.eta.segment(from, left.modes);
    rest.etadot.segment(left.offset, left.modes) =
        whole.etadot.segment(from, left.modes);
  }
  return rest;
}

void ExactModes::prepare(const std::vector<double>& times) {
  for (Part& part : parts_) {
    part.history = part.response.evaluate(times);
    const flexbody::ModalLosses losses = part.response.evaluate_losses(times);
    part.work = losses.work.colwise().sum();
    part.dissipated = losses.dissipated.colwise().sum();
  }
}

void ExactModes::join_rest(const SystemState& rest, SystemState& whole) const {
  whole.t = rest.t;
  whole.bodies = rest.bodies;
  whole.maxwell = rest.maxwell;
  whole.X_WH = rest.X_WH;
  whole.u_H = rest.u_H;
  whole.udot_H = rest.udot_H;
  whole.memory = rest.memory;
  whole.pair_memory = rest.pair_memory;
  whole.far_pairs = rest.far_pairs;
  for (std::size_t b = 0; b < rest_.bodies.size(); ++b) {
    const BodyModel& left = rest_.bodies[b];
    const int to = model_.bodies[b].offset;
    whole.eta.segment(to, left.modes) =
        rest.eta.segment(left.offset, left.modes);
    whole.etadot.segment(to, left.modes) =
        rest.etadot.segment(left.offset, left.modes);
  }
}

void ExactModes::join(const SystemState& rest, std::size_t i,
                      SystemState& whole) const {
  join_rest(rest, whole);
  const auto column = static_cast<Eigen::Index>(i);
  for (const Part& part : parts_) {
    const Eigen::Index modes = part.history.eta.rows();
    whole.eta.segment(part.offset, modes) = part.history.eta.col(column);
    whole.etadot.segment(part.offset, modes) = part.history.etadot.col(column);
  }
}

void ExactModes::join(const SystemState& rest, SystemState& whole) const {
  join_rest(rest, whole);
  for (const Part& part : parts_) {
    const flexbody::ModalHistory now = part.response.evaluate({rest.t});
    whole.eta.segment(part.offset, part.lambda.size()) = now.eta;
    whole.etadot.segment(part.offset, part.lambda.size()) = now.etadot;
  }
}

double ExactModes::find_longest_look(double end) const {
  std::vector<double> times;
  for (int i = 0; i <= kEnergyLooks; ++i) {
    times.push_back(start_ + (end - start_) * i / kEnergyLooks);
  }
  double fastest = 0.0;
  for (const Part& part : parts_) {
    std::vector<double> looks = times;
    for (const double t : part.response.interval_starts()) {
      if (t > start_ && t < end) looks.push_back(t);
    }
    const flexbody::ModalEnergies e = part.response.evaluate_energies(looks);
    const VectorX energies = (e.kinetic + e.elastic).rowwise().maxCoeff();
    const double most = energies.maxCoeff();
    if (!(most > 0.0)) continue;
    fastest = std::max(fastest, part.fastest_load);
    for (Eigen::Index k = 0; k < energies.size(); ++k) {
      if (energies[k] < kExcited * most) continue;
      fastest = std::max(fastest, std::sqrt(part.lambda[k]));
    }
  }
  const double period = 2.0 * std::numbers::pi / fastest;
  return period / kLooksAPeriod;
}

ExactModes::Losses ExactModes::losses(std::size_t i) const {
  Losses sum;
  for (const Part& part : parts_) {
    sum.work += part.work[static_cast<Eigen::Index>(i)];
    sum.dissipated += part.dissipated[static_cast<Eigen::Index>(i)];
  }
  return sum;
}

}  // namespace limber::dynamics
