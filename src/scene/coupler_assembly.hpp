// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene/mounts.hpp"

namespace limber::scene {

/// Puts a scene's couplers on its bodies, joints first.
class CouplerAssembly {
 public:
  CouplerAssembly(const Scene& scene, const BodyPlans& plans,
                  const Mounts& mounts, dynamics::SystemBuilder& builder,
                  std::vector<std::string>& warnings)
      : scene_(scene),
        plans_(plans),
        mounts_(mounts),
        builder_(builder),
        warnings_(warnings) {}

  void add_joints();
  void add_connectors();

 private:
  void add_joint(const Joint& joint);
  Mount mount_joint(const Joint& joint, int link, const Pose& X_LF);
  void check_joint_interface(const Joint& joint, int link, const Mount& mount);
  void add_connector(const Connector& connector);
  void add_coupler(const std::string& name, const joints::CouplerLaw& law,
                   const Mount& F, const Mount& M);

  const Scene& scene_;
  const BodyPlans& plans_;
  const Mounts& mounts_;
  dynamics::SystemBuilder& builder_;
  std::vector<std::string>& warnings_;
};

}  // namespace limber::scene
