// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "scene/carried_load.hpp"
#include "scene/coupler_laws.hpp"
#include "scene/mounts.hpp"

namespace limber::scene {

/// Puts a scene's couplers on its bodies: joints first, then loops, springs and
/// bushings, latches; then what couples more than two frames, tendons and
/// gears. All have the names of the robot's file in the built model.
class CouplerAssembly {
 public:
  CouplerAssembly(const Scene& scene, const BodyPlans& plans,
                  const Mounts& mounts, dynamics::SystemBuilder& builder,
                  std::vector<std::string>& warnings);

  void add_all();

 private:
  /// What is between the two mounts of a joint or loop.
  struct JointSpec {
    std::string name;
    joints::JointKind kind;
    Vector3 axis;
    Vector3 second;
    const CouplerOptions& coupler;
    const std::vector<JointAction>& actions;
    double max_effort;
    double max_speed;
    CarriedLoad load;
  };
  /// A joint of the model with one coordinate, for gears.
  struct Geared {
    dynamics::CouplerIndex coupler;
    Hold hold;
    std::vector<joints::AxisCoordinate> coordinates;
    std::array<Mount, 2> mounts;  ///< of F and M
  };

  void add_joint(int index);
  void add_joint(const JointSpec& spec, const Mount& F, const Mount& M);
  Mount mount_joint(const Joint& joint, int link, const Pose& X_LF);
  void check_joint_interface(const Joint& joint, int link, const Mount& mount);
  void add_loop(const Loop& loop);
  void check_gap(const Pose& from, const Pose& to, const char* where) const;
  void add_connector(const Connector& connector);
  void add_latch(const Latch& latch);
  void add_tendon(const Tendon& tendon);
  void check_start(const Gear& gear);
  void add_gear(const Gear& gear);
  dynamics::CouplerIndex add_coupler(const std::string& name,
                                     const joints::CouplerLaw& law,
                                     const Mount& F, const Mount& M);

  const Scene& scene_;
  const BodyPlans& plans_;
  const Mounts& mounts_;
  dynamics::SystemBuilder& builder_;
  std::vector<std::string>& warnings_;
  CarriedLoads loads_;
  std::vector<LinkMotion> at_zero_;  ///< links where all joints are at zero
  std::map<std::string, JointStart> starts_;  ///< of the tree, gears followed
  std::map<std::string, Geared> geared_;
};

}  // namespace limber::scene
