// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/stepping/damper_impulse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/equations/relative_energy.hpp"
#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/system/state_increments.hpp"
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
// Energy relative to that of the joined bodies' relative motion below which no
// impulse is applied [-].
constexpr double kHarmless = 1e-6;
// Round-off of a relative velocity, relative to the velocities [-].
constexpr double kVelocityNoise = 8.0 * std::numeric_limits<double>::epsilon();

double find_target_rate(const Transmission& transmission,
                        const joints::ScalarMotion& motion,
                        const joints::CouplerMemory& memory,
                        const EvaluationTime& now) {
  joints::TargetRate sum;
  std::size_t first = 0;
  for (const joints::ScalarLaw& law : transmission.laws) {
    sum.add(law, motion, now,
            {memory.switches[first], memory.switches[first + 1]});
    first += static_cast<std::size_t>(joints::switch_count(law));
  }
  return sum.rate();
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
        still_(make_unknowns(model)),
        residual_(still_),
        x_(residual_) {}

  // Powers dissipated by couplers, transmissions, pairs and the modes of each
  // body [W].
  std::vector<double> find_powers(const SystemState& state) {
    calc_terms(model_, state, Side::right, terms_);
    std::vector<double> powers;
    for (const auto& c : terms_.couplers) {
      powers.push_back(c.response.dissipation);
    }
    for (const auto& t : terms_.transmissions) {
      powers.push_back(t.response.dissipation);
    }
    for (const auto& pair : terms_.pairs.responses) {
      powers.push_back(pair.dissipation);
    }
    for (const BodyModel& body : model_.bodies) {
      const auto rate = state.etadot.segment(body.offset, body.modes);
      powers.push_back(rate.dot(body.damping.cwiseProduct(rate)));
    }
    return powers;
  }

  // The part of each that is round-off of velocities, after find_powers [W].
  [[nodiscard]] std::vector<double> find_power_noise() const {
    std::vector<double> noise;
    for (std::size_t i = 0; i < model_.couplers.size(); ++i) {
      const Coupler& coupler = model_.couplers[i];
      const AttachmentMotion& F = motion_of(coupler.frame_F);
      const AttachmentMotion& M = motion_of(coupler.frame_M);
      const double v = F.v_WF_W.norm() + M.v_WF_W.norm();
      const double w = F.w_WF_W.norm() + M.w_WF_W.norm();
      Vector6 gap;
      gap << v, v, v, w, w, w;
      gap *= kVelocityNoise;
      noise.push_back(
          gap.dot(terms_.couplers[i].response.damping.cwiseAbs() * gap));
    }
    noise.resize(noise.size() + model_.transmissions.size() +
                     model_.pairs.size() + model_.bodies.size(),
                 0.0);
    return noise;
  }

  // Change of the kinetic energy, without the energy of common motion that a
  // difference of two energies would round [J].
  double find_kinetic_change(const SystemState& before,
                             const SystemState& after) {
    leave_dampers_alone();
    VectorX from = make_unknowns(model_);
    VectorX to = make_unknowns(model_);
    get_velocities(model_, before, from);
    get_velocities(model_, after, to);
    calc_residual(model_, to - from, terms_, residual_);
    return 0.5 * residual_.dot(from + to);
  }

  // Changes the velocities of the last find_powers. @returns the work of drives
  // [J]
  double apply(SystemState& state) {
    push_by_velocities(state);
    leave_dampers_alone();
    matrix_.factor(model_, stop(state), terms_, still_, {kScale / h_, kScale});
    matrix_.solve(model_, terms_, residual_, gaps_, x_);
    for (int i = 1; i < kPower; ++i) filter_increments();
    VectorX velocities = make_unknowns(model_);
    get_velocities(model_, state, velocities);
    set_velocities(model_, velocities + kScale * x_, state);
    static_assert(kPower > 1);  // wrenches of the last solve are M's loss
    double work = 0.0;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      work -= h_ * matrix_.wrench_increments()[i].dot(targets_[i]);
    }
    return work;
  }

 private:
  [[nodiscard]] const AttachmentMotion& motion_of(AttachmentIndex i) const {
    return terms_.attachments[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] std::size_t link_count() const {
    return model_.couplers.size() + model_.transmissions.size();
  }

  // Forces of dampers at the state's velocities.
  void push_by_velocities(const SystemState& state) {
    const EvaluationTime now = now_of(state);
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
      residual_.segment(body.row + 6, body.modes) = body.damping.cwiseProduct(
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
    calc_residual(model_, x_, terms_, residual_);
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
    clear_forces(model_, terms_);
  }

  const SystemModel& model_;
  double h_;
  NewtonMatrix matrix_;
  SystemTerms terms_;
  std::vector<Vector6> targets_;  // one per coupler, then one per transmission
  std::vector<Vector6> gaps_;
  VectorX still_;
  VectorX residual_;
  VectorX x_;
};

// The bodies of each entry of DamperFilter::find_powers.
std::vector<JoinedBodies> list_joined_bodies(const SystemModel& model) {
  std::vector<JoinedBodies> all;
  for (const Coupler& c : model.couplers) {
    all.push_back(find_joined_bodies(model, c));
  }
  for (const Transmission& t : model.transmissions) {
    all.push_back(find_joined_bodies(model, t));
  }
  for (const Pair& pair : model.pairs) all.push_back(find_joined_bodies(pair));
  for (BodyIndex b(0); b < std::ssize(model.bodies); ++b) all.push_back({b});
  return all;
}

// Decrease of the power of dampers that the step does not resolve, each beside
// its own bodies' motion; the entry with the largest.
struct Fall {
  double power = 0.0;    // [W]
  double kinetic = 0.0;  // of those bodies [J]
  std::size_t most = 0;
};

// @param kinetic energies of the relative motions [J]
// @param noise decreases that are round-off [W]
Fall find_fall(const std::vector<double>& before,
               const std::vector<double>& after,
               const std::vector<double>& kinetic,
               const std::vector<double>& noise, double h) {
  Fall fall;
  double most = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!(after[i] < kResolved * before[i])) continue;
    const double by = before[i] - after[i];
    if (!(h * by > kHarmless * kinetic[i]) || by <= noise[i]) continue;
    fall.power += by;
    fall.kinetic += kinetic[i];
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
  DamperFilter filter(model, h, make_terms(model));
  const std::vector<double> before = filter.find_powers(state);
  if (std::all_of(before.begin(), before.end(),
                  [](double power) { return power == 0.0; })) {
    return std::nullopt;
  }
  const std::vector<double> noise = filter.find_power_noise();
  std::vector<double> kinetic;
  for (const JoinedBodies& bodies : list_joined_bodies(model)) {
    kinetic.push_back(find_relative_kinetic(model, state, bodies));
  }
  DamperImpulse impulse;
  SystemState changed = state;
  impulse.work = filter.apply(changed);
  const Fall fall =
      find_fall(before, filter.find_powers(changed), kinetic, noise, h);
  if (fall.power == 0.0) return std::nullopt;
  for (int i = 1; i < kPasses; ++i) {
    impulse.work += filter.apply(changed);
    static_cast<void>(filter.find_powers(changed));
  }
  impulse.kinetic = fall.kinetic;
  impulse.dissipated =
      impulse.work - filter.find_kinetic_change(state, changed);
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
      "at t = {:.9g} s dampers, mainly {}, stop a relative motion of bodies "
      "within {:.2g} s, far less than the step of {:.3g} s: an impulse set "
      "their velocities to what the dampers allow; it dissipated {:.3g} J of "
      "the {:.3g} J in the relative motion of the bodies joined there{}",
      t, where, impulse.relaxation, h, impulse.dissipated, impulse.kinetic,
      impulse.work != 0.0
          ? fmt::format(", and drives did {:.3g} J of work", impulse.work)
          : std::string());
}

}  // namespace limber::dynamics
