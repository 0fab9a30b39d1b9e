// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reference/verification.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/reference/scene_mechanism.hpp"
#include "limber/reference/stiffening.hpp"

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

/// Displacement from the start, and speeds.
Magnitudes find_magnitudes(const BodyState& start, const BodyState& now) {
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

void measure_simbody(const std::vector<Snapshot>& snapshots,
                     Verification& verification) {
  const Snapshot& start = snapshots.front();
  for (const Snapshot& now : snapshots) {
    for (std::size_t b = 0; b < now.frames.size(); ++b) {
      take_larger(verification.motion,
                  find_magnitudes(start.frames[b], now.frames[b]));
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

Agreement run_ours(const dynamics::SystemModel& model,
                   dynamics::SystemState state,
                   const dynamics::SimulationSettings& settings,
                   const std::vector<Snapshot>& theirs,
                   const Progress& progress) {
  std::vector<dynamics::SystemState> states;
  std::vector<dynamics::EnergyBalance> energies;
  const auto observer = [&](const dynamics::SystemState& now,
                            const dynamics::EnergyBalance& energy) {
    states.push_back(now);
    energies.push_back(energy);
  };
  dynamics::simulate(model, state, settings, observer, progress);
  Agreement agreement = compare(theirs, states, energies);
  agreement.step = find_longest_step(settings);
  return agreement;
}

/// The start and the end are always compared.
void add_ends(const dynamics::SystemState& initial,
              dynamics::SimulationSettings& settings) {
  std::vector<double>& times = settings.output_times;
  if (times.empty() || times.front() > initial.t) {
    times.insert(times.begin(), initial.t);
  }
  if (times.back() < settings.end_time) times.push_back(settings.end_time);
}

/// Several runs as one: the part [begin, begin + width] of them.
Progress report_part(const Progress& progress, double begin, double width) {
  return [&progress, begin, width](std::string_view, double fraction) {
    report(progress, "all our runs", begin + width * fraction);
  };
}

/// One Simbody run, and comparisons of our runs with it.
class Comparison {
 public:
  Comparison(const scene::Scene& scene, const scene::BuiltScene& built,
             const VerificationOptions& options, const Progress& progress)
      : built_(built), options_(options), settings_(built.settings) {
    LIMBER_EXPECT(options.refinements >= 0);
    add_ends(built.initial, settings_);
    simbody_ = simulate(
        make_mechanism(scene, built), options.simbody,
        dynamics::find_breakpoints(built.model, built.initial.t, settings_),
        progress);
  }

  /// Our run with joints `factor` times as stiff.
  [[nodiscard]] Verification run(double factor,
                                 const Progress& progress) const {
    Verification verification;
    for (const dynamics::BodyModel& body : built_.model.bodies) {
      verification.bodies.push_back(body.name);
    }
    verification.simbody_steps = simbody_.steps;
    measure_simbody(simbody_.snapshots, verification);
    const dynamics::SystemModel model =
        factor == 1.0 ? built_.model : stiffen_joints(built_.model, factor);
    const double total = std::exp2(options_.refinements + 1) - 1.0;
    for (int i = 0; i <= options_.refinements; ++i) {
      const double steps = std::exp2(i);  // of the first run
      verification.runs.push_back(run_ours(
          model, built_.initial, halve_steps(settings_, i), simbody_.snapshots,
          report_part(progress, (steps - 1.0) / total, steps / total)));
    }
    return verification;
  }

 private:
  const scene::BuiltScene& built_;
  VerificationOptions options_;
  dynamics::SimulationSettings settings_;
  SimbodyRun simbody_;
};

void check_factors(const std::vector<double>& factors) {
  const bool increase =
      std::adjacent_find(factors.begin(), factors.end(),
                         std::greater_equal<>()) == factors.end();
  const bool are_finite =
      std::all_of(factors.begin(), factors.end(),
                  [](double f) { return f > 0.0 && std::isfinite(f); });
  if (factors.size() >= 2 && increase && are_finite) return;
  throw InputError(fmt::format(
      "factors of stiffness are {:g}; expected two or more numbers > 0, "
      "increasing",
      fmt::join(factors, ", ")));
}

double find_fraction(double part, double whole) {
  return whole > 0.0 ? part / whole : 0.0;
}

void refuse_ideal_joints(const dynamics::SystemModel& model,
                         const char* remedy) {
  for (const dynamics::Coupler& coupler : model.couplers) {
    if (!joints::is_ideal(coupler.law)) continue;
    throw InputError(
        fmt::format("joint '{}' is ideal: {}", coupler.name, remedy));
  }
}

}  // namespace

double find_relative(const Magnitudes& difference, const Magnitudes& motion) {
  return std::max(
      {find_fraction(difference.position, motion.position),
       find_fraction(difference.rotation, motion.rotation),
       find_fraction(difference.velocity, motion.velocity),
       find_fraction(difference.angular_velocity, motion.angular_velocity)});
}

Agreement compare(const std::vector<Snapshot>& reference,
                  const std::vector<dynamics::SystemState>& states,
                  const std::vector<dynamics::EnergyBalance>& energies) {
  LIMBER_EXPECT(states.size() == reference.size());
  LIMBER_EXPECT(energies.size() == reference.size());
  Agreement agreement;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const Snapshot& theirs = reference[i];
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
  if (options.simbody.joints != JointModel::ideal) {
    refuse_ideal_joints(built.model,
                        "compare with Simbody's ideal joints (--joints ideal)");
  }
  return Comparison(scene, built, options, progress).run(1.0, progress);
}

StiffenedVerification verify_stiffened(const scene::Scene& scene,
                                       const scene::BuiltScene& built,
                                       const std::vector<double>& factors,
                                       const VerificationOptions& options,
                                       const Progress& progress) {
  check_factors(factors);
  if (options.simbody.joints != JointModel::ideal) {
    throw InputError(
        "stiffened joints are compared with ideal ones, no others");
  }
  refuse_ideal_joints(built.model, "there is no stiffness to increase");
  const Comparison comparison(scene, built, options, progress);
  StiffenedVerification all;
  const double width = 1.0 / static_cast<double>(factors.size());
  for (std::size_t i = 0; i < factors.size(); ++i) {
    try {
      const Progress part =
          report_part(progress, static_cast<double>(i) * width, width);
      all.results.push_back(comparison.run(factors[i], part));
    } catch (const NumericalError& error) {
      if (all.results.size() < 2) throw;
      all.ended = error.what();
      break;
    }
  }
  return all;
}

}  // namespace limber::reference
