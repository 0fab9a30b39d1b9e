// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/archive.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/event.hpp"
#include "dynamics/residual.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/system_state.hpp"

/// What of a run goes into a checkpoint, and in which order.
namespace limber::joints {

inline void exchange(Archive& archive, CouplerMemory& memory) {
  archive(memory.near, memory.switches, memory.latch, memory.X_FM);
}

}  // namespace limber::joints

namespace limber::dynamics {

inline void exchange(Archive& archive, BodyState& body) {
  archive(body.p_WB, body.quat_WB, body.v_WB_W, body.w_WB_B);
}

inline void exchange(Archive& archive, SystemState& state) {
  archive(state.t, state.bodies, state.eta, state.etadot, state.X_WH, state.u_H,
          state.udot_H, state.memory);
}

inline void exchange(Archive& archive, Rates& rates) {
  archive(rates.translation, rates.rotation, rates.modes, rates.nodes);
}

inline void exchange(Archive& archive, Accelerations& a) {
  archive(a.a_WB_W, a.dw_WB_B, a.etaddot, a.uddot_H);
}

inline void exchange(Archive& archive, Event& event) {
  archive(event.time, event.source, event.what, event.rate);
}

inline void exchange(Archive& archive, EnergyBalance& energy) {
  archive(energy.kinetic_rigid, energy.kinetic_modal, energy.elastic,
          energy.coupler, energy.dissipated, energy.work,
          energy.linear_momentum, energy.angular_momentum);
}

/// Counts of work, which add up over a run.
inline void exchange_costs(Archive& archive, SimulationStatistics& statistics) {
  archive(statistics.steps, statistics.rejected_steps, statistics.halved_steps,
          statistics.newton_iterations, statistics.factorizations,
          statistics.linear_solves);
}

}  // namespace limber::dynamics
