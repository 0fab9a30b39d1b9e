// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/natural_frequencies.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "common/errors.hpp"
#include "common/rotation.hpp"
#include "dynamics/equations.hpp"

namespace limber::dynamics {
namespace {

// One way to move: displaces a state, and reads the acceleration along it.
struct Coordinate {
  std::function<void(SystemState&, double)> displace;
  std::function<double(const Accelerations&)> acceleration;
  double step = 0.0;
};

void add_rigid_coordinates(const BodyModel& body, std::size_t b,
                           std::vector<Coordinate>& all) {
  constexpr double kStep = 1e-5;  // of a body's size, and in [rad]
  const double size = std::sqrt(body.J0.trace() / body.mass);
  for (const int axis : {0, 1, 2}) {
    all.push_back(
        {[b, axis](SystemState& s, double h) { s.bodies[b].p_WB[axis] += h; },
         [b, axis](const Accelerations& a) { return a.a_WB_W[b][axis]; },
         kStep * size});
    all.push_back(
        {[b, axis](SystemState& s, double h) {
           s.bodies[b].quat_WB =
               s.bodies[b].quat_WB * exp_quaternion(h * Vector3::Unit(axis));
         },
         [b, axis](const Accelerations& a) { return a.dw_WB_B[b][axis]; },
         kStep});
  }
}

std::vector<Coordinate> find_coordinates(const SystemModel& model) {
  std::vector<Coordinate> all;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    if (body.full >= 0) {
      throw InputError(fmt::format(
          "body '{}' is at level full, whose frequencies are not computed; "
          "use coupled",
          body.name));
    }
    if (body.has_rigid_motion()) add_rigid_coordinates(body, b, all);
    for (int k = 0; k < body.modes; ++k) {
      const Eigen::Index i = body.offset + k;
      const double size = std::sqrt(body.J0.trace());
      all.push_back({[i](SystemState& s, double h) { s.eta[i] += h; },
                     [i](const Accelerations& a) { return a.etaddot[i]; },
                     1e-5 * size});
    }
  }
  return all;
}

SystemState at_rest(const SystemState& state) {
  SystemState rest = state;
  for (BodyState& body : rest.bodies) {
    body.v_WB_W.setZero();
    body.w_WB_B.setZero();
  }
  rest.etadot.setZero();
  return rest;
}

}  // namespace

VectorX find_natural_frequencies(const SystemModel& model,
                                 const SystemState& state) {
  const std::vector<Coordinate> coordinates = find_coordinates(model);
  const SystemState rest = at_rest(state);
  SystemTerms terms = make_terms(model);
  Accelerations at = make_accelerations(model);
  const auto n = static_cast<Eigen::Index>(coordinates.size());
  const auto accelerate = [&](const Coordinate& coordinate, double h) {
    SystemState displaced = rest;
    coordinate.displace(displaced, h);
    calc_terms(model, displaced, Side::right, terms);
    solve_accelerations(model, terms, at);
    VectorX a(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      a[i] = coordinates[static_cast<std::size_t>(i)].acceleration(at);
    }
    return a;
  };
  // In units of each coordinate's step, so that no entry is out of proportion.
  MatrixX A(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Coordinate& c = coordinates[static_cast<std::size_t>(j)];
    A.col(j) = 0.5 * (accelerate(c, -c.step) - accelerate(c, c.step));
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    A.row(i) /= coordinates[static_cast<std::size_t>(i)].step;
  }
  const Eigen::EigenSolver<MatrixX> solver(A, false);
  VectorX frequencies = solver.eigenvalues().real();
  // What is round-off of the stiffest motion is free.
  constexpr double kFree = 1e-10;
  const double least = kFree * frequencies.cwiseAbs().maxCoeff();
  for (double& f : frequencies) {
    f = std::abs(f) < least ? 0.0
                            : std::copysign(std::sqrt(std::abs(f)), f) /
                                  (2.0 * std::numbers::pi);
  }
  std::sort(frequencies.begin(), frequencies.end());
  return frequencies;
}

}  // namespace limber::dynamics
