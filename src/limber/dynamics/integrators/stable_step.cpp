// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "limber/common/errors.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/state_increments.hpp"
#include "limber/dynamics/terms/maxwell.hpp"

namespace limber::dynamics {
namespace {

// A change of positions or of velocities, or of the accelerations by it.
using Change = VectorX;

// Visits numbers that have the same weight in the norm.
template <typename Visit>
void for_each_vector(const SystemModel& model, Change& x, const Visit& visit) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    for (const UnknownRange& range : list_unknowns(model, b)) {
      visit(x.data() + range.row, range.size, std::sqrt(range.mass));
    }
  }
}

// Mass-weighted Euclidean norm.
double measure_change(const SystemModel& model, Change& x) {
  double sum = 0.0;
  for_each_vector(model, x, [&](double* at, Eigen::Index n, double weight) {
    sum += weight * weight * Eigen::Map<const VectorX>(at, n).squaredNorm();
  });
  return std::sqrt(sum);
}

void scale(const SystemModel& model, Change& x, double factor) {
  for_each_vector(model, x, [&](double* at, Eigen::Index n, double) {
    Eigen::Map<VectorX>(at, n) *= factor;
  });
}

// Square of a body's part of the mass-weighted norm.
double measure_part(const SystemModel& model, const Change& x, std::size_t b) {
  double part = 0.0;
  for (const UnknownRange& range : list_unknowns(model, b)) {
    part += range.mass * x.segment(range.row, range.size).squaredNorm();
  }
  return part;
}

// Factor of a change that moves no body by more than a small fraction of its
// size, large against round-off [-].
double find_increment(const SystemModel& model, const Change& x) {
  constexpr double kFraction = 1e-7;
  double largest = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    largest = std::max(largest,
                       measure_part(model, x, b) / model.bodies[b].J0.trace());
  }
  return kFraction / std::sqrt(largest);
}

constexpr double kSlow = 0.01;

class Iteration {
 public:
  // @param has_modes whether modes have their own springs and dampers
  Iteration(const SystemModel& model, const SystemState& state, bool has_modes)
      : model_(model),
        state_(state),
        displaced_(state),
        terms_(make_terms(model)),
        x_(make_unknowns(model)),
        rest_(x_),
        v_(x_),
        has_modes_(has_modes) {
    find_accelerations(state_, rest_);
    get_velocities(model_, state_, v_);
  }

  // Largest eigenvalue of -d(acceleration)/d(position).
  double find_largest_stiffness() { return find_largest(0.0); }
  // Of -d(acceleration)/d(velocity), by velocities that are small beside those
  // of an oscillation as fast as `rate` [1/s] and as small as the changes of
  // positions.
  double find_largest_damping(double rate) {
    return find_largest(kSlow * (rate > 0.0 ? rate : 1.0));
  }

  // The body with the largest part of the last eigenvector.
  std::size_t find_largest_body() {
    double most = -1.0;
    std::size_t largest = 0;
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const double part = measure_part(model_, x_, b);
      if (!(part > most)) continue;
      most = part;
      largest = b;
    }
    return largest;
  }

 private:
  // @param rate of velocities by changes [1/s]; 0: positions
  double find_largest(double rate) {
    constexpr double kEnough = 1e-5;  // settles to about a thousandth
    constexpr int kMostIterations = 3000;
    constexpr int kSettled = 20;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for_each_vector(model_, x_, [&](double* at, Eigen::Index n, double weight) {
      for (Eigen::Index i = 0; i < n; ++i) at[i] = uniform(random) / weight;
    });
    displaced_ = state_;
    double eigenvalue = 0.0;
    int settled = 0;
    for (int i = 0; i < kMostIterations && settled < kSettled; ++i) {
      const double size = measure_change(model_, x_);
      if (!(size > 0.0)) return 0.0;
      scale(model_, x_, 1.0 / size);
      apply(rate);
      const double next = measure_change(model_, x_);
      settled = std::abs(next - eigenvalue) <= kEnough * next ? settled + 1 : 0;
      eigenvalue = next;
    }
    return eigenvalue;
  }

  void find_accelerations(const SystemState& at, Change& accelerations) {
    calc_terms(model_, at, Side::right, terms_);
    solve_accelerations(model_, terms_, accelerations);
    if (has_modes_) return;
    for (const BodyModel& body : model_.bodies) {
      const auto of_body = [&](const VectorX& x) {
        return x.segment(body.offset, body.modes).array();
      };
      mode_rows(body, accelerations).array() +=
          flexbody::rest_stiffness(body.elasticity).array() * of_body(at.eta) +
          body.damping.array() * of_body(at.etadot);
    }
  }

  // x <- -(a(state + e x) - a(state)) / e
  void apply(double rate) {
    const bool of_velocity = rate > 0.0;
    const double e = (of_velocity ? rate : 1.0) * find_increment(model_, x_);
    if (of_velocity) {
      set_velocities(model_, v_ + e * x_, displaced_);
    } else {
      displaced_ = state_;
      displace(model_, x_, e, displaced_);
      stretch_maxwell(model_, x_, e, displaced_.maxwell);
    }
    find_accelerations(displaced_, x_);
    x_ = (rest_ - x_) / e;
  }

  const SystemModel& model_;
  const SystemState& state_;
  SystemState displaced_;
  SystemTerms terms_;
  Change x_;
  Change rest_;
  VectorX v_;  // of state_
  bool has_modes_;
};

// Of Maxwell elements [1/s].
double find_fastest_relaxation(const SystemModel& model) {
  double fastest = 0.0;
  for (const BodyModel& body : model.bodies) {
    for (const double time : body.maxwell.times) {
      fastest = std::max(fastest, 1.0 / time);
    }
  }
  return fastest;
}

}  // namespace

double find_stable_step(const SystemModel& model, const SystemState& state,
                        IntegratorKind scheme) {
  Iteration iteration(model, state, scheme != IntegratorKind::splitting);
  const double omega_squared = iteration.find_largest_stiffness();
  const double c = iteration.find_largest_damping(std::sqrt(omega_squared));
  const auto divide = [](double longest, double rate) {
    return rate > 0.0 ? longest / rate
                      : std::numeric_limits<double>::infinity();
  };
  switch (scheme) {
    case IntegratorKind::central_differences:
      return divide(2.0, c + std::sqrt(c * c + omega_squared));
    case IntegratorKind::splitting:
      return divide(2.0, std::max(c, std::sqrt(omega_squared)));
    case IntegratorKind::runge_kutta_4:
      return divide(2.6,
                    std::max(0.5 * (c + std::sqrt(c * c + 4.0 * omega_squared)),
                             find_fastest_relaxation(model)));
    case IntegratorKind::generalized_alpha:
    case IntegratorKind::explicit_euler:
    case IntegratorKind::implicit_euler:
    case IntegratorKind::energy_conserving:
      break;
  }
  throw ContractError("the stable step of " + to_string(scheme) +
                      " is not known");
}

std::size_t find_fastest_body(const SystemModel& model,
                              const SystemState& state) {
  Iteration iteration(model, state, true);
  (void)iteration.find_largest_stiffness();
  return iteration.find_largest_body();
}

}  // namespace limber::dynamics
