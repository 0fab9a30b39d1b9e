// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

/// What textbooks say of models/four_bar.urdf: the mechanism of rigid links,
/// and its rod as a slender beam between two pins. Planar, x and z.
namespace limber::test::four_bar {

using Eigen::Vector2d;

// Lengths [m], masses [kg], moments of inertia about centres of mass [kg m^2].
constexpr double kCrank = 0.1;
constexpr double kRod = 0.5;
constexpr double kRocker = 0.3;
constexpr double kGround = 0.5;
constexpr double kThickness = 0.01;  // of the rod, both ways
constexpr double kModulus = 70e9;    // [Pa]
constexpr double kMassPerLength = 2700.0 * kThickness * kThickness;  // [kg/m]
constexpr double kRodMass = kMassPerLength * kRod;
constexpr double kBending =  // E I [N m^2]
    kModulus * kThickness * kThickness * kThickness * kThickness / 12.0;
constexpr double kCrankAboutPivot = 0.004 + 1.5 * 0.02 * 0.02;
constexpr double kRockerAboutPivot = 0.003 + 0.4 * 0.15 * 0.15;

inline Vector2d along(double angle) {
  return {std::cos(angle), std::sin(angle)};
}
inline Vector2d across(double angle) {
  return {-std::sin(angle), std::cos(angle)};
}

/// Where the links are at a crank angle theta, and how they go with it.
struct Position {
  double rod = 0.0;          ///< its angle from x [rad]
  double rod_rate = 0.0;     ///< by theta [-]
  double rocker_rate = 0.0;  ///< by theta [-]
  Vector2d middle_rate;      ///< of the rod's middle, by theta [m]
  /// Kinetic energy is inertia * thetadot^2 / 2 [kg m^2].
  double inertia = 0.0;

  /// Of the rod's middle across the rod, by theta [m].
  [[nodiscard]] double middle_across() const {
    return middle_rate.dot(across(rod));
  }
};

/// Loop closure a e(theta) + b e(phi) = g e_x + c e(psi), the rocker's end on
/// the left of the way from the crank's end to the rocker's pivot.
inline Position find_position(double theta) {
  const Vector2d crank_end = kCrank * along(theta);
  const Vector2d pivot(kGround, 0.0);
  const Vector2d way = pivot - crank_end;
  const double squared = way.squaredNorm();
  Position p;
  p.rod = std::atan2(way.y(), way.x()) +
          std::acos((kRod * kRod + squared - kRocker * kRocker) /
                    (2.0 * kRod * std::sqrt(squared)));
  const Vector2d rocker = crank_end + kRod * along(p.rod) - pivot;
  const double psi = std::atan2(rocker.y(), rocker.x());
  // The closure by theta, times e(psi), then times e(phi).
  p.rod_rate = -kCrank * across(theta).dot(along(psi)) /
               (kRod * across(p.rod).dot(along(psi)));
  p.rocker_rate = kCrank * across(theta).dot(along(p.rod)) /
                  (kRocker * across(psi).dot(along(p.rod)));
  p.middle_rate =
      kCrank * across(theta) + 0.5 * kRod * p.rod_rate * across(p.rod);
  const double rod_about_middle =
      kRodMass * (kRod * kRod + kThickness * kThickness) / 12.0;
  p.inertia = kCrankAboutPivot +
              kRockerAboutPivot * p.rocker_rate * p.rocker_rate +
              kRodMass * p.middle_rate.squaredNorm() +
              rod_about_middle * p.rod_rate * p.rod_rate;
  return p;
}

/// Without forces the energy is all kinetic and stays.
///
/// Equation   thetadot = thetadot_0 sqrt(I(theta_0) / I(theta))
inline double find_rate(double theta, double rate_at_zero) {
  return rate_at_zero *
         std::sqrt(find_position(0.0).inertia / find_position(theta).inertia);
}

/// theta at `times` from theta = 0 at 0, by quadrature of the rate with 20
/// Runge-Kutta steps from one time to the next [rad].
inline std::vector<double> find_angles(const std::vector<double>& times,
                                       double rate_at_zero) {
  constexpr int kSteps = 20;
  std::vector<double> angles;
  double theta = 0.0;
  double t = 0.0;
  const auto rate = [&](double x) { return find_rate(x, rate_at_zero); };
  for (const double time : times) {
    const double h = (time - t) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const double k1 = rate(theta);
      const double k2 = rate(theta + 0.5 * h * k1);
      const double k3 = rate(theta + 0.5 * h * k2);
      const double k4 = rate(theta + h * k3);
      theta += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    t = time;
    angles.push_back(theta);
  }
  return angles;
}

/// First bending frequency between rigid pins [Hz].
///
/// Equation   (pi / 2) sqrt(EI / (mu L^4))
inline double find_pinned_frequency() {
  return 0.5 * std::numbers::pi *
         std::sqrt(kBending / (kMassPerLength * std::pow(kRod, 4)));
}

/// Momentum across the rod, per thetadot, that a half sine of the rod with
/// unit amplitude shares with theta [kg m].
///
/// Equation   c = mu (2 L / pi) n . d(middle)/dtheta
inline double find_shared_inertia(const Position& p) {
  return kMassPerLength * 2.0 * kRod / std::numbers::pi * p.middle_across();
}

/// First bending frequency between pins that the linkage carries, free to turn
/// on [Hz].
///
/// Equation   pinned / sqrt(1 - c^2 / (m I)), m = mu L / 2 of the half sine:
///            of I thetaddot + c wddot = 0, c thetaddot + m wddot + k w = 0
inline double find_frequency(const Position& p) {
  const double shared = find_shared_inertia(p);
  return find_pinned_frequency() /
         std::sqrt(1.0 - shared * shared / (0.5 * kRodMass * p.inertia));
}

/// Deflection of the middle across the rod, from the line between the pins,
/// under the rod's own inertia [m]. Accelerations go linearly from pin to pin;
/// of such a load only the mean bends the middle.
///
/// Equation   -5 mu a L^4 / (384 EI), a = n . acceleration of the middle
inline double find_deflection(double theta, double rate_at_zero) {
  // d(middle)/dt = middle_rate thetadot; by theta by differences, 1e-10.
  constexpr double kStep = 1e-5;
  const auto velocity = [&](double x) {
    const double rate = find_rate(x, rate_at_zero);
    return Vector2d(find_position(x).middle_rate * rate);
  };
  const Vector2d acceleration =
      (velocity(theta + kStep) - velocity(theta - kStep)) / (2.0 * kStep) *
      find_rate(theta, rate_at_zero);
  const double a = acceleration.dot(across(find_position(theta).rod));
  return -5.0 * kMassPerLength * a * std::pow(kRod, 4) / (384.0 * kBending);
}

/// Reduction of the crank's speed by the flexible rod, averaged over the
/// vibration of an initially straight rod [rad/s].
///
/// Equation   (E(0) + 3 E(theta)) / (I thetadot), E = k w^2 / 2 of the
///            deflection w, k = pi^4 EI / (2 L^3) of the half sine. E(0) rings,
///            or was dissipated since. A deflection that follows the motion,
///            w = g(theta) thetadot^2, gives the Lagrangian I thetadot^2 / 2 +
///            k w^2 / 2, which has the energy I thetadot^2 / 2 + 3 k w^2 / 2.
inline double find_slowing(double theta, double rate_at_zero) {
  const double k =
      std::pow(std::numbers::pi, 4) * kBending / (2.0 * std::pow(kRod, 3));
  const auto energy = [&](double x) {
    const double w = find_deflection(x, rate_at_zero);
    return 0.5 * k * w * w;
  };
  return (energy(0.0) + 3.0 * energy(theta)) /
         (find_position(theta).inertia * find_rate(theta, rate_at_zero));
}

}  // namespace limber::test::four_bar
