// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "dynamics/system_builder.hpp"
#include "scene/body_plan.hpp"
#include "scene/interface_tables.hpp"
#include "scene/link_motion.hpp"
#include "scene/probe.hpp"
#include "scene/scene.hpp"

namespace limber::scene {

/// Puts a scene's system together, part by part.
class Assembly {
 public:
  Assembly(const Scene& scene, const BodyPlans& plans,
           const std::vector<LinkMotion>& motions);

  void add_bodies();
  void add_joints();
  void add_connectors();
  void add_loads();
  [[nodiscard]] std::vector<Probe> make_probes() const;

  /// @throws InputError with every problem found so far.
  [[nodiscard]] dynamics::SystemModel build() const;
  [[nodiscard]] dynamics::SystemState make_initial_state(
      const dynamics::SystemModel& model) const;
  [[nodiscard]] const std::vector<std::string>& warnings() const {
    return warnings_;
  }

 private:
  const BodyPlan& plan_of(int link) const;
  void add_body(const BodyPlan& plan);
  void add_joint(const Joint& joint);
  void check_joint_interface(const Joint& joint, int link,
                             const flexbody::InterfaceTable& table,
                             const Pose& X_BF);
  dynamics::AttachmentIndex attach(const std::string& name, int link,
                                   const Pose& X_LF, const Anchor& anchor);
  Pose pose_of(const ConnectorEnd& end) const;
  dynamics::AttachmentIndex attach_end(const std::string& name,
                                       const ConnectorEnd& end,
                                       const Pose& X_WF);
  void add_connector(const Connector& connector);
  void add_load(const LoadSpec& load);
  void add_nodal_load(const LoadSpec& load);
  Probe make_probe(const ProbeSpec& spec) const;
  void deform(const dynamics::SystemModel& model,
              const dynamics::BodyModel& body, VectorX& u_B, VectorX& udot_B,
              dynamics::SystemState& state) const;
  void remember_turns(const dynamics::SystemModel& model,
                      dynamics::SystemState& state) const;

  const Scene& scene_;
  const BodyPlans& plans_;
  const std::vector<LinkMotion>& motions_;
  std::vector<dynamics::BodyIndex> body_index_;  ///< one a plan
  dynamics::SystemBuilder builder_;
  std::vector<std::string> warnings_;
};

}  // namespace limber::scene
