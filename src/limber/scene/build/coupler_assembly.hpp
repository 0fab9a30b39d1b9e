// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limber/scene/build/attachment_sites.hpp"
#include "limber/scene/build/carried_load.hpp"
#include "limber/scene/build/coupler_laws.hpp"

namespace limber::scene {

/// Adds a scene's couplers to its bodies: joints first, then loops, springs and
/// bushings, latches; then transmissions: tendons and gears. All have the names
/// of the robot's file in the built model.
class CouplerAssembly {
 public:
  CouplerAssembly(const Scene& scene, const BodyPlans& plans,
                  const AttachmentSites& sites,
                  dynamics::SystemBuilder& builder,
                  std::vector<std::string>& warnings);

  void add_all();

  /// A note if an explicit scheme has given default joints of rigid sides
  /// another stiffness than the implicit ones would.
  [[nodiscard]] std::optional<std::string> describe_explicit_defaults() const;

 private:
  /// Specification of a joint or loop between two sites.
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
    Vector3 p_W;  ///< its place at the start
  };
  /// A joint of the model with one coordinate, for gears.
  struct Geared {
    dynamics::CouplerIndex coupler;
    Constraint constraint;
    std::vector<joints::AxisCoordinate> coordinates;
    std::array<AttachmentSite, 2> sites;  ///< of F and M
  };

  [[nodiscard]] double choose_rigid_frequency(const Vector3& p_W) const;
  void record_default(const std::string& name, const CouplerOptions& options,
                      const AttachmentSite& F, const AttachmentSite& M,
                      const joints::ConstraintStiffness& held);
  void add_joint(int index);
  void add_joint(const JointSpec& spec, const AttachmentSite& F,
                 const AttachmentSite& M);
  AttachmentSite find_joint_site(const Joint& joint, int link,
                                 const Pose& X_LF);
  void check_joint_interface(const Joint& joint, int link,
                             const AttachmentSite& site);
  void add_loop(const Loop& loop);
  struct LoopEnds {
    const ConnectorEnd& from;
    const ConnectorEnd& to;
  };
  void check_gap(const LoopEnds& ends, const std::vector<LinkMotion>& motions,
                 const char* where) const;
  void add_connector(const Connector& connector);
  void add_latch(const Latch& latch);
  void add_tendon(const Tendon& tendon);
  void check_start(const Gear& gear);
  void add_gear(const Gear& gear);
  dynamics::CouplerIndex add_coupler(const std::string& name,
                                     const joints::CouplerLaw& law,
                                     const AttachmentSite& F,
                                     const AttachmentSite& M);

  const Scene& scene_;
  const BodyPlans& plans_;
  const AttachmentSites& sites_;
  dynamics::SystemBuilder& builder_;
  std::vector<std::string>& warnings_;
  CarriedLoads loads_;
  std::vector<LinkMotion> at_zero_;           ///< links with all joints at zero
  std::map<std::string, JointStart> starts_;  ///< of the tree, including gears
  std::map<std::string, Geared> geared_;
  std::vector<std::string> rigid_defaults_;  ///< see record_default
};

}  // namespace limber::scene
