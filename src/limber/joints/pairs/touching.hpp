// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/joints/pairs/pair_interaction.hpp"
#include "limber/joints/pairs/pair_mobility.hpp"

namespace limber::joints {

/// Whether two bodies touch, as a function of time.
struct PairTouch {
  double depth = 0.0;  ///< > 0 where they overlap, else minus a distance [m]
  double rate = 0.0;   ///< of the depth [m/s]
  Vector3 normal_W = Vector3::Zero();  ///< from A to B, unit [-]
  Vector3 p_W = Vector3::Zero();       ///< midway between both [m]
  /// Whether one is wholly within the other, where no surface presses: the
  /// depth is 0.
  bool is_enclosed = false;
};

/// How far a body's points that may touch can move.
struct TouchReach {
  double extent = 0.0;  ///< of the undeformed points from Bo, at most [m]
  VectorX modes;        ///< of each mode the largest displacement of a point,
                        ///< or empty [kg^-1/2]
};

/// What two bodies exert on each other while they touch, of all points
/// together.
struct TouchReading {
  double normal_force = 0.0;           ///< sum of all points' [N]
  double friction_force = 0.0;         ///< of the largest force [N]
  Vector3 normal_W = Vector3::Zero();  ///< from A to B, of the largest
                                       ///< force [-]
  Vector3 p_W = Vector3::Zero();       ///< of the largest force [m]
  Vector3 force_W = Vector3::Zero();   ///< resultant on B [N]
  double depth = 0.0;                  ///< largest, of the surfaces alone [m]
  double area = 0.0;                   ///< of all points' [m^2]
  double energy = 0.0;                 ///< stored [J]
  double series_energy = 0.0;  ///< the part of it in flexibility in series with
                               ///< the surfaces [J]
  /// Of the vibration of both bodies on this touch, at least the rate at which
  /// its damper acts [rad/s].
  double frequency = 0.0;
  double normal_speed = 0.0;  ///< root mean square of all points' [m/s]
  /// At which both bodies have as much kinetic energy as the touch has elastic
  /// energy [m/s].
  double elastic_speed = 0.0;
  int points = 0;      ///< that touch, count
  bool slips = false;  ///< whether one does
  /// The part of force_W that is friction [N].
  Vector3 friction_W = Vector3::Zero();
  /// Second moments of all points' pressure about their centre [m^2].
  Matrix3 spread_W = Matrix3::Zero();
};

/// Interface of a pair interaction for the beginning and end of contact: the
/// times at which they do are located, steps are adapted and impacts are
/// recorded.
class Touching {
 public:
  Touching() = default;
  Touching(const Touching&) = delete;
  Touching& operator=(const Touching&) = delete;
  virtual ~Touching() = default;

  /// Of the deepest point, or, where all are apart, of the nearest one.
  /// @param scratch of the law's size, here and below
  [[nodiscard]] virtual PairTouch find_touch(const PairBodies& bodies,
                                             PairResponse& scratch) const = 0;
  /// A lower bound of the distance, 0 where they may touch; cheap [m].
  [[nodiscard]] virtual double find_clearance(
      const PairBodies& bodies) const = 0;
  /// An upper bound of the speed at which the distance can change, at this
  /// motion [m/s].
  [[nodiscard]] virtual double find_speed_bound(
      const PairBodies& bodies) const = 0;
  [[nodiscard]] virtual TouchReach find_reach_A() const = 0;
  [[nodiscard]] virtual TouchReach find_reach_B() const = 0;
  /// Of the smaller body near the contact: what moves farther in a step may
  /// pass through it [m].
  [[nodiscard]] virtual double find_size() const = 0;
  /// Changes the memory where both begin to touch.
  /// @returns T_c of a free impact at this speed [s]
  virtual double begin_touch(const PairBodies& bodies, double t,
                             std::span<double> memory,
                             PairResponse& scratch) const = 0;
  /// Keeps what joints leave of both bodies' freedom until they leave each
  /// other; unless this is called after begin_touch(), both are free.
  virtual void set_mobility(const PairMobility& mobility,
                            std::span<double> memory) const = 0;
  /// Resets the memory where both leave each other: the next touch is new.
  virtual void end_touch(std::span<double> memory) const = 0;
  [[nodiscard]] virtual TouchReading read(const PairBodies& bodies,
                                          const EvaluationTime& now,
                                          std::span<const double> memory,
                                          PairResponse& scratch) const = 0;
};

}  // namespace limber::joints
