// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/dynamics/equations/equations.hpp"

namespace limber::dynamics {

/// Groups of bodies whose corrections Newton's method judges together, each by
/// its own motion: bodies that couplers and transmissions connect, except by
/// way of the world. So no test depends on other bodies of the scene, nor on a
/// velocity that all bodies of a group have.
class MotionGroups {
 public:
  explicit MotionGroups(const SystemModel& model);

  [[nodiscard]] std::size_t count() const { return is_held_.size(); }
  /// The group of body `b`.
  [[nodiscard]] std::size_t of(std::size_t b) const { return group_of_[b]; }

  /// Joins groups whose bodies touch at `terms`, until the next call.
  void join_touching(const SystemModel& model, const SystemTerms& terms);
  /// The representative of all groups that are joined with that of body `b`.
  [[nodiscard]] std::size_t find_joined(std::size_t b) const {
    return find(of(b));
  }

  /// A step's motion in each group [m], on the scale of newton_measures.hpp;
  /// those that touch each other have one.
  ///
  /// Equation   max over b of the length of the increments of body b less
  ///            sum m dp / sum m of the group; less nothing if the world holds
  ///            or touches it
  /// @param state with X_WH of unreduced bodies
  /// @param terms as for join_touching
  void measure_motion(const SystemModel& model, const SystemState& state,
                      const SystemTerms& terms, const VectorX& motion,
                      std::vector<double>& lengths);

 private:
  // Of one or more groups.
  struct Common {
    std::size_t with = 0;  // another one that has it; itself: is the first
    bool is_held = false;
    double mass = 0.0;                      // [kg]
    Vector3 momentum = Vector3::Zero();     // times the step [kg m]
    Vector3 translation = Vector3::Zero();  // [m]
    double squared = 0.0;                   // largest motion relative to it
  };
  [[nodiscard]] std::size_t find(std::size_t group) const;

  std::vector<std::size_t> group_of_;
  std::vector<char> is_held_;
  std::vector<Common> common_;
};

}  // namespace limber::dynamics
