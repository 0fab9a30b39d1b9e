// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/scene_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/dynamics/equations/node_motion.hpp"

namespace limber::results {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr std::size_t kSearched = 64;

// Outputs of the largest elastic energies, and evenly spaced ones.
std::set<std::size_t> list_candidates(const History& history) {
  const std::size_t count = history.states.size();
  const std::size_t most = std::min(count, kSearched);
  // Energies, of which the least comes first; the earliest of equal ones stay.
  std::set<std::pair<double, std::ptrdiff_t>> largest;
  std::ptrdiff_t output = 0;
  for (const dynamics::EnergyBalance& energy : history.energies) {
    if (std::isfinite(energy.elastic)) largest.emplace(energy.elastic, output);
    if (largest.size() > most) largest.erase(largest.begin());
    --output;
  }
  if (history.energies.size() != count) largest.clear();
  std::set<std::size_t> candidates;
  for (const auto& [energy, i] : largest) {
    candidates.insert(static_cast<std::size_t>(-i));
  }
  for (std::size_t k = 0; k < most; ++k) candidates.insert(k * count / most);
  candidates.insert(count - 1);
  return candidates;
}

double find_deformation(const dynamics::SystemModel& model, std::size_t b,
                        const dynamics::SystemState& state) {
  const Eigen::Index n = model.bodies[b].reduced->rows.x_B.cols();
  if (n == 0) return 0.0;
  MatrixX u_B(3 * n, 1);
  calc_node_deformations(model, static_cast<dynamics::BodyIndex>(b),
                         {&state, 1}, u_B);
  return u_B.reshaped(3, n).colwise().norm().maxCoeff();
}

Matrix3 find_spread(const Matrix3X& points) {
  const Matrix3X centred = points.colwise() - points.rowwise().mean();
  return centred * centred.transpose();
}

/// With a trace of 1, or zero.
Matrix3 normalise(const Matrix3& spread) {
  const double trace = spread.trace();
  return trace > 0.0 ? Matrix3(spread / trace) : Matrix3(Matrix3::Zero());
}

}  // namespace

DeformationPeak find_largest_deformation(const dynamics::SystemModel& model,
                                         const History& history) {
  DeformationPeak peak;
  for (const std::size_t i : list_candidates(history)) {
    const dynamics::SystemState state = history.states[i];
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (!model.bodies[b].reduced) continue;
      const double u = find_deformation(model, b, state);
      if (u > peak.deformation) peak = {i, u};
    }
  }
  return peak;
}

double find_magnification(double deformation, double size) {
  constexpr double kSeen = 0.02;
  constexpr double kWanted = 0.06;
  if (!(deformation > 1e-9 * size) || deformation > kSeen * size) return 1.0;
  const double factor = kWanted * size / deformation;
  const double power = std::pow(10.0, std::floor(std::log10(factor)));
  if (factor >= 5.0 * power) return 5.0 * power;
  return factor >= 2.0 * power ? 2.0 * power : power;
}

Vector3 find_eye(const ViewAngles& view) {
  const double x = view.rot_x / kDegrees;
  const double z = view.rot_z / kDegrees;
  return {std::sin(x) * std::sin(z), -std::sin(x) * std::cos(z), std::cos(x)};
}

ViewAngles find_view(const std::vector<Matrix3X>& shots) {
  Matrix3 motion = Matrix3::Zero();
  Matrix3 extent = Matrix3::Zero();
  for (const Matrix3X& shot : shots) {
    if (shot.cols() == 0) return {};
    const Matrix3X moved = shot - shots.front();
    motion += moved * moved.transpose();
    extent += find_spread(shot);
  }
  const Matrix3 seen = normalise(motion) + 0.5 * normalise(extent);
  if (!(seen.trace() > 0.0) || !seen.allFinite()) return {};
  Vector3 eye = dense::find_eigenpairs(seen).vectors.col(0);
  const bool is_level = std::abs(eye.z()) < 1e-3;
  if (is_level ? eye.y() > 0.0 : eye.z() < 0.0) eye = -eye;
  constexpr double kTurn = 15.0;
  const double rot_x = kDegrees * std::acos(std::clamp(eye.z(), -1.0, 1.0));
  double rot_z = kTurn;
  if (rot_x > kTurn) rot_z += kDegrees * std::atan2(eye.x(), -eye.y());
  return {std::clamp(rot_x, 20.0, 75.0), std::fmod(rot_z + 360.0, 360.0)};
}

}  // namespace limber::results
