// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "limber/contact/law/hertz_law.hpp"

namespace limber::contact::test {

/// Two free masses on a line, the first behind the second, that touch at t = 0
/// with a speed of approach, until they part. Integrated by the embedded pair
/// of Dormand and Prince (1980) with 1e-12 a step.
class TwoBodyImpact {
 public:
  /// @param factor beta of the damping [-]
  TwoBodyImpact(const HertzLaw& law, double factor, double mass_A,
                double mass_B)
      : law_(law), factor_(factor), mass_A_(mass_A), mass_B_(mass_B) {}

  struct Outcome {
    double duration = 0.0;     // [s]
    double peak_force = 0.0;   // [N]
    double peak_depth = 0.0;   // [m]
    double speed_A = 0.0;      // afterwards [m/s]
    double speed_B = 0.0;      // [m/s]
    double dissipated = 0.0;   // [J]
    double least_force = 0.0;  // [N]
    int steps = 0;
  };

  [[nodiscard]] Outcome run(double speed) const {
    const double mass = mass_A_ * mass_B_ / (mass_A_ + mass_B_);
    const double depth = std::max(
        law_.find_state_of_energy(0.5 * mass * speed * speed).residual_depth,
        law_.find_state_of_energy(0.5 * mass * speed * speed).hertz_depth);
    const State scale{depth, speed, speed, mass * speed * speed};
    Outcome out;
    State x{0.0, speed, 0.0, 0.0};  // depth, speeds, dissipated
    double h = 1e-6 * depth / speed;
    for (int i = 0; i < 200000; ++i) {
      const Step step = advance(x, h);
      double error = 0.0;
      for (int k = 0; k < 4; ++k) {
        error = std::max(error, std::abs(step.error[k]) / scale[k]);
      }
      const double factor = std::clamp(
          0.9 * std::pow(1e-12 / std::max(error, 1e-20), 0.2), 0.2, 3.0);
      if (error > 1e-12) {
        h *= factor;
        continue;
      }
      if (step.end[0] <= 0.0) {
        if (h < 1e-9 * depth / speed) {
          out.speed_A = step.end[1];
          out.speed_B = step.end[2];
          out.dissipated = step.end[3];
          return out;
        }
        h *= 0.5;
        continue;
      }
      x = step.end;
      out.duration += h;
      ++out.steps;
      const double force = find_force(x).force;
      out.peak_force = std::max(out.peak_force, force);
      out.least_force = std::min(out.least_force, force);
      out.peak_depth = std::max(out.peak_depth, x[0]);
      // Peaks are read at steps' ends.
      h = std::min(h * factor, 2e-3 * depth / speed);
    }
    return out;
  }

 private:
  using State = std::array<double, 4>;
  struct Step {
    State end;
    State error;
  };

  struct Damped {
    double force = 0.0;
    double dissipation = 0.0;
  };

  // f max(0, 1 + s d'), s = beta / sqrt(d'^2 + 2 W / m).
  [[nodiscard]] Damped find_force(const State& x) const {
    const HertzLaw::Response r = law_.evaluate(x[0]);
    const double rate = x[1] - x[2];
    const double inverse_mass = 1.0 / mass_A_ + 1.0 / mass_B_;
    const double speed =
        std::sqrt(rate * rate + 2.0 * r.energy() * inverse_mass);
    const double s = speed > 0.0 ? factor_ / speed : 0.0;
    const double force = r.force * std::max(0.0, 1.0 + s * rate);
    return {force, (force - r.force) * rate};
  }

  [[nodiscard]] State find_rate(const State& x) const {
    const Damped f = find_force(x);
    return {x[1] - x[2], -f.force / mass_A_, f.force / mass_B_, f.dissipation};
  }

  [[nodiscard]] Step advance(const State& x, double h) const {
    static constexpr double a[7][6] = {
        {},
        {1.0 / 5},
        {3.0 / 40, 9.0 / 40},
        {44.0 / 45, -56.0 / 15, 32.0 / 9},
        {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
        {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176,
         -5103.0 / 18656},
        {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784,
         11.0 / 84}};
    static constexpr double e[7] = {
        71.0 / 57600,      0.0,        -71.0 / 16695, 71.0 / 1920,
        -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
    std::array<State, 7> k;
    State end = x;
    for (int i = 0; i < 7; ++i) {
      end = x;
      for (int j = 0; j < i; ++j) {
        for (int n = 0; n < 4; ++n) end[n] += h * a[i][j] * k[j][n];
      }
      k[i] = find_rate(end);
    }
    State error{};
    for (int i = 0; i < 7; ++i) {
      for (int n = 0; n < 4; ++n) error[n] += h * e[i] * k[i][n];
    }
    return {end, error};
  }

  HertzLaw law_;
  double factor_;
  double mass_A_;
  double mass_B_;
};

}  // namespace limber::contact::test
