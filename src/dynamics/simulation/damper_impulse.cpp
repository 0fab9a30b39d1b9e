// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/damper_impulse.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/equations/residual.hpp"
#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

constexpr int kPower = 8;
constexpr int kPasses = 3;
// Velocities per increment, so that stiffness is negligible beside inertia
// [1/s].
constexpr double kScale = 1e30;
// A damper whose power falls by less is resolved by the step [-].
constexpr double kResolved = 0.9;
// Energy relative to the kinetic energy below which no impulse is applied [-].
constexpr double kHarmless = 1e-6;

double find_target_rate(const Transmission& transmission,
                        const joints::ScalarMotion& motion,
                        const joints::CouplerMemory& memory,
                        const Instant& now) {
  joints::TargetRate sum;
  std::size_t first = 0;
  for (const joints::ScalarLaw& law : transmission.laws) {
    sum.add(law, motion, now,
            {memory.switches[first], memory.switches[first + 1]});
    first += static_cast<std::size_t>(joints::switch_count(law));
  }
  return sum.rate();
}

double find_kinetic(const EnergyBalance& energy) {
  return energy.kinetic_rigid + energy.kinetic_modal;
}

void add_velocities(const SystemModel& model, const VectorX& x,
                    SystemState& state) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const Eigen::Index row = first_row(body, b);
    state.etadot.segment(body.offset, body.modes) +=
        kScale * x.segment(row + 6, body.modes);
    if (!body.has_rigid_motion()) continue;
    state.bodies[b].v_WB_W += kScale * x.segment<3>(row);
    state.bodies[b].w_WB_B += kScale * x.segment<3>(row + 3);
  }
  state.udot_H += kScale * x.tail(model.nodal_count);
}

/// Applies powers of X to velocities, by the factors of a Newton matrix whose
/// increments are velocities / kScale and whose stiffness is the damping.
class DamperFilter {
 public:
  DamperFilter(const SystemModel& model, double h, SystemTerms terms)
      : model_(model),
        h_(h),
        matrix_(model),
        terms_(std::move(terms)),
        targets_(link_count(), Vector6::Zero()),
        gaps_(targets_),
        still_(model.bodies.size(), Vector3::Zero()),
        rates_(make_rates(model)),
        residual_(VectorX::Zero(count_unknowns(model))),
        x_(residual_) {}

  // Powers dissipated by couplers, transmissions, pairs and, last, all modes
  // [W].
  std::vector<double> find_powers(const SystemState& state) {
    calc_terms(model_, state, Side::right, terms_);
    std::vector<double> powers;
    double rest = terms_.dissipated_power;
    const auto add = [&](double power) {
      powers.push_back(power);
      rest -= power;
    };
    for (const auto& c : terms_.couplers) add(c.response.dissipation);
    for (const auto& t : terms_.transmissions) add(t.response.dissipation);
    for (const auto& pair : terms_.pairs.responses) add(pair.dissipation);
    powers.push_back(rest);
    return powers;
  }

  // Changes the velocities of the last find_powers. @returns the work of drives
  // [J]
  double apply(SystemState& state) {
    push_by_velocities(state);
    leave_dampers_alone();
    matrix_.factor(model_, stop(state), terms_, still_, {kScale / h_, kScale});
    matrix_.solve(model_, terms_, residual_, gaps_, x_);
    for (int i = 1; i < kPower; ++i) filter_increments();
    add_velocities(model_, x_, state);
    static_assert(kPower > 1);  // wrenches of the last solve are M's loss
    double work = 0.0;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      work -= h_ * matrix_.wrench_increments()[i].dot(targets_[i]);
    }
    return work;
  }

 private:
  [[nodiscard]] std::size_t link_count() const {
    return model_.couplers.size() + model_.transmissions.size();
  }

  // Forces of dampers at the state's velocities.
  void push_by_velocities(const SystemState& state) {
    const Instant now = now_of(state);
    const std::size_t couplers = model_.couplers.size();
    for (std::size_t c = 0; c < couplers; ++c) {
      const CouplerTerms& t = terms_.couplers[c];
      targets_[c] = joints::find_target_velocity(
          model_.couplers[c].law, t.motion, state.memory[c], now);
      Vector6 velocity;
      velocity << t.motion.v_FM_F, t.motion.w_FM_F;
      gaps_[c] = t.response.damping * (targets_[c] - velocity);
    }
    for (std::size_t i = 0; i < model_.transmissions.size(); ++i) {
      const TransmissionTerms& t = terms_.transmissions[i];
      targets_[couplers + i][0] = find_target_rate(
          model_.transmissions[i], t.motion, state.memory[couplers + i], now);
      gaps_[couplers + i].setZero();
      gaps_[couplers + i][0] =
          t.response.damping * (targets_[couplers + i][0] - t.motion.rate);
    }
    residual_.setZero();
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const BodyModel& body = model_.bodies[b];
      residual_.segment(first_row(body, b) + 6, body.modes) =
          body.damping.cwiseProduct(
              state.etadot.segment(body.offset, body.modes));
    }
    for (std::size_t i = 0; i < model_.pairs.size(); ++i) {
      for (const auto& point : terms_.pairs.responses[i].points()) {
        add_residual(model_, model_.pairs[i], point,
                     -(point.damping * point.velocity_W), terms_, residual_);
      }
    }
  }

  // X x = x - (M + h C)^-1 M x: unlike h C x, without round-off of large
  // damping in undamped directions.
  void filter_increments() {
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const BodyModel& body = model_.bodies[b];
      const Eigen::Index row = first_row(body, b);
      rates_.translation[b] = x_.segment<3>(row);
      rates_.rotation[b] = x_.segment<3>(row + 3);
      rates_.modes.segment(body.offset, body.modes) =
          x_.segment(row + 6, body.modes);
    }
    rates_.nodes = x_.tail(model_.nodal_count);
    calc_residual(model_, rates_, terms_, residual_);
    residual_ *= -kScale / h_;
    for (Vector6& gap : gaps_) gap.setZero();
    const VectorX before = x_;
    matrix_.solve(model_, terms_, residual_, gaps_, x_);
    x_ = before - x_;
  }

  // Damping in place of stiffness; otherwise inertia only.
  void leave_dampers_alone() {
    for (CouplerTerms& coupler : terms_.couplers) {
      coupler.response.stiffness = kScale * coupler.response.damping;
      coupler.response.damping.setZero();
    }
    for (TransmissionTerms& t : terms_.transmissions) {
      t.response.stiffness = kScale * t.response.damping;
      t.response.damping = 0.0;
    }
    for (joints::PairResponse& pair : terms_.pairs.responses) {
      for (joints::PairPoint& point : pair.points()) {
        point.stiffness = kScale * point.damping;
        point.damping.setZero();
      }
      pair.uncouple();
    }
    for (BodyTerms& body : terms_.bodies) {
      body.force_W.setZero();
      body.moment_B.setZero();
      body.modal_force.setZero();
      body.bias_r.setZero();
      body.bias_e.setZero();
    }
    for (FullTerms& full : terms_.full) {
      full.force.setZero();
      full.internal.setZero();
    }
  }

  const SystemModel& model_;
  double h_;
  NewtonMatrix matrix_;
  SystemTerms terms_;
  std::vector<Vector6> targets_;  // one per coupler, then one per transmission
  std::vector<Vector6> gaps_;
  std::vector<Vector3> still_;
  Rates rates_;
  VectorX residual_;
  VectorX x_;
};

// Decrease of the power of dampers that the step does not resolve, and the
// entry with the largest.
struct Fall {
  double power = 0.0;  // [W]
  std::size_t most = 0;
};

Fall find_fall(const std::vector<double>& before,
               const std::vector<double>& after) {
  Fall fall;
  double most = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!(after[i] < kResolved * before[i])) continue;
    const double by = before[i] - after[i];
    fall.power += by;
    if (by <= most) continue;
    most = by;
    fall.most = i;
  }
  return fall;
}

std::string name_link(const SystemModel& model, std::size_t link) {
  if (link < model.couplers.size()) return model.couplers[link].name;
  link -= model.couplers.size();
  if (link < model.transmissions.size()) return model.transmissions[link].name;
  link -= model.transmissions.size();
  return link < model.pairs.size() ? model.pairs[link].name : std::string();
}

}  // namespace

std::optional<DamperImpulse> apply_damper_impulse(const SystemModel& model,
                                                  double h,
                                                  SystemState& state) {
  SystemTerms terms = make_terms(model);
  DamperImpulse impulse;
  impulse.kinetic = find_kinetic(calc_energy(model, state, terms));
  const double harmless = kHarmless * impulse.kinetic;
  if (!(h * terms.dissipated_power > harmless)) return std::nullopt;
  DamperFilter filter(model, h, std::move(terms));
  const std::vector<double> before = filter.find_powers(state);
  SystemState changed = state;
  impulse.work = filter.apply(changed);
  const Fall fall = find_fall(before, filter.find_powers(changed));
  if (!(h * fall.power > harmless)) return std::nullopt;
  for (int i = 1; i < kPasses; ++i) {
    impulse.work += filter.apply(changed);
    static_cast<void>(filter.find_powers(changed));
  }
  impulse.dissipated = impulse.kinetic + impulse.work -
                       find_kinetic(calc_energy(model, changed));
  impulse.coupler = name_link(model, fall.most);
  impulse.relaxation = 2.0 * impulse.dissipated / fall.power;
  state = changed;
  return impulse;
}

std::string describe(const DamperImpulse& impulse, double t, double h) {
  const std::string where =
      impulse.coupler.empty() ? std::string("in modes")
                              : fmt::format("at coupler '{}'", impulse.coupler);
  return fmt::format(
      "at t = {:.9g} s bodies move in ways that dampers, most {}, end within "
      "{:.2g} s, far less than the step of {:.3g} s: an impulse brought their "
      "velocities onto what the dampers allow; it took {:.3g} J of {:.3g} J "
      "of kinetic energy{}",
      t, where, impulse.relaxation, h, impulse.dissipated, impulse.kinetic,
      impulse.work != 0.0
          ? fmt::format(", and drives did {:.3g} J of work", impulse.work)
          : std::string());
}

}  // namespace limber::dynamics
