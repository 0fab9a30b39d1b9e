// SPDX-License-Identifier: BSD-3-Clause
#include "reference/verification.hpp"

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "common/rotation.hpp"
#include "reference/scene_mechanism.hpp"

namespace limber::reference {
namespace {

using dynamics::BodyState;

/// Angle between two orientations, accurate when small [rad].
double find_angle(const Quaternion& a, const Quaternion& b) {
  return log_rotation(Quaternion(a.conjugate() * b)).norm();
}

Magnitudes find_difference(const BodyState& a, const BodyState& b) {
  return {(a.p_WB - b.p_WB).norm(), find_angle(a.quat_WB, b.quat_WB),
          (a.v_WB_W - b.v_WB_W).norm(), (a.w_WB_B - b.w_WB_B).norm()};
}

/// How far from its start and how fast.
Magnitudes find_motion(const BodyState& start, const BodyState& now) {
  return {(now.p_WB - start.p_WB).norm(),
          find_angle(start.quat_WB, now.quat_WB), now.v_WB_W.norm(),
          now.w_WB_B.norm()};
}

void take_larger(Magnitudes& largest, const Magnitudes& m) {
  largest.position = std::max(largest.position, m.position);
  largest.rotation = std::max(largest.rotation, m.rotation);
  largest.velocity = std::max(largest.velocity, m.velocity);
  largest.angular_velocity =
      std::max(largest.angular_velocity, m.angular_velocity);
}

void measure_witness(const std::vector<Snapshot>& snapshots,
                     Verification& verification) {
  const Snapshot& start = snapshots.front();
  for (const Snapshot& now : snapshots) {
    for (std::size_t b = 0; b < now.frames.size(); ++b) {
      take_larger(verification.motion,
                  find_motion(start.frames[b], now.frames[b]));
    }
    verification.energy =
        std::max(verification.energy, now.kinetic + now.coupler);
  }
}

dynamics::SimulationSettings halve_steps(dynamics::SimulationSettings settings,
                                         int times) {
  const double factor = std::pow(0.5, times);
  settings.step *= factor;
  for (dynamics::StepChange& change : settings.step_changes) {
    change.step *= factor;
  }
  return settings;
}

double find_longest(const dynamics::SimulationSettings& settings) {
  double longest = settings.step;
  for (const dynamics::StepChange& change : settings.step_changes) {
    longest = std::max(longest, change.step);
  }
  return longest;
}

Agreement run_ours(const scene::BuiltScene& built,
                   const dynamics::SimulationSettings& settings,
                   const std::vector<Snapshot>& witness,
                   const Progress& progress) {
  std::vector<dynamics::SystemState> states;
  std::vector<dynamics::EnergyBalance> energies;
  dynamics::SystemState state = built.initial;
  const auto observer = [&](const dynamics::SystemState& now,
                            const dynamics::EnergyBalance& energy) {
    states.push_back(now);
    energies.push_back(energy);
  };
  dynamics::simulate(built.model, state, settings, observer, progress);
  Agreement agreement = compare(witness, states, energies);
  agreement.step = find_longest(settings);
  return agreement;
}

/// The start and the end are always looked at.
void add_ends(const dynamics::SystemState& initial,
              dynamics::SimulationSettings& settings) {
  std::vector<double>& times = settings.output_times;
  if (times.empty() || times.front() > initial.t) {
    times.insert(times.begin(), initial.t);
  }
  if (times.back() < settings.end_time) times.push_back(settings.end_time);
}

double find_share(double part, double whole) {
  return whole > 0.0 ? part / whole : 0.0;
}

}  // namespace

double find_relative(const Magnitudes& difference, const Magnitudes& motion) {
  return std::max(
      {find_share(difference.position, motion.position),
       find_share(difference.rotation, motion.rotation),
       find_share(difference.velocity, motion.velocity),
       find_share(difference.angular_velocity, motion.angular_velocity)});
}

Agreement compare(const std::vector<Snapshot>& witness,
                  const std::vector<dynamics::SystemState>& states,
                  const std::vector<dynamics::EnergyBalance>& energies) {
  LIMBER_EXPECT(states.size() == witness.size());
  LIMBER_EXPECT(energies.size() == witness.size());
  Agreement agreement;
  for (std::size_t i = 0; i < witness.size(); ++i) {
    const Snapshot& theirs = witness[i];
    LIMBER_EXPECT(states[i].t == theirs.time);
    LIMBER_EXPECT(states[i].bodies.size() == theirs.frames.size());
    agreement.bodies.resize(theirs.frames.size());
    for (std::size_t b = 0; b < theirs.frames.size(); ++b) {
      const Magnitudes difference =
          find_difference(theirs.frames[b], states[i].bodies[b]);
      take_larger(agreement.bodies[b], difference);
      take_larger(agreement.largest, difference);
    }
    agreement.energy = std::max(
        agreement.energy,
        std::abs(energies[i].total() - (theirs.kinetic + theirs.coupler)));
  }
  return agreement;
}

Verification verify(const scene::Scene& scene, const scene::BuiltScene& built,
                    const VerificationOptions& options,
                    const Progress& progress) {
  LIMBER_EXPECT(options.refinements >= 0);
  const Mechanism mechanism = make_mechanism(scene, built);
  dynamics::SimulationSettings settings = built.settings;
  add_ends(built.initial, settings);
  const WitnessRun witness =
      simulate(mechanism, options.witness,
               dynamics::find_landmarks(built.model, built.initial.t, settings),
               progress);

  Verification verification;
  for (const dynamics::BodyModel& body : built.model.bodies) {
    verification.bodies.push_back(body.name);
  }
  verification.witness_steps = witness.steps;
  measure_witness(witness.snapshots, verification);
  for (int i = 0; i <= options.refinements; ++i) {
    verification.runs.push_back(
        run_ours(built, halve_steps(settings, i), witness.snapshots, progress));
  }
  return verification;
}

}  // namespace limber::reference
