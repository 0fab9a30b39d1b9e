// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/reference/joint_model.hpp"
#include "limber/reference/mechanism.hpp"
#include "limber/reference/simbody_forces.hpp"
#include "limber/reference/snapshot.hpp"

/// Not installed.
namespace limber::reference {

/// A mechanism as a Simbody system.
class SimbodyModel {
 public:
  SimbodyModel(const Mechanism& mechanism, JointModel joints);
  SimbodyModel(const SimbodyModel&) = delete;
  SimbodyModel& operator=(const SimbodyModel&) = delete;

  [[nodiscard]] const SimTK::MultibodySystem& system() const { return system_; }
  /// Set before integrating from one jump to the next.
  [[nodiscard]] Interval& interval() { return interval_; }
  /// The state at time 0. Poses and velocities of all bodies follow from the
  /// joints' coordinates by Simbody's own kinematics.
  [[nodiscard]] SimTK::State make_start() const;
  [[nodiscard]] Snapshot observe(const SimTK::State& state) const;

 private:
  [[nodiscard]] const SimTK::MobilizedBody& body(int index) const;
  [[nodiscard]] SimTK::MobilizedBody& body(int index);
  [[nodiscard]] SimbodyFrame frame(const MechanismFrame& frame) const;
  void add_body(const MechanismBody& part, bool is_free);
  void add_bushing(const BushingElement& element);
  void add_universal(const UniversalElement& element);
  void add_coordinate(const CoordinateElement& element);
  void add_spring(const SpringElement& element);
  void add_loads();
  [[nodiscard]] SimTK::State make_joint_start() const;

  const Mechanism& mechanism_;
  JointModel joints_;
  Interval interval_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  std::vector<SimTK::MobilizedBody> bodies_;
  std::vector<SimTK::Force> couplers_;  ///< those that store energy
};

}  // namespace limber::reference
