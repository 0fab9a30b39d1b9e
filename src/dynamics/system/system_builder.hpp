// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/pose.hpp"
#include "dynamics/fidelity.hpp"
#include "dynamics/name_register.hpp"
#include "dynamics/system_model.hpp"
#include "dynamics/time_function.hpp"
#include "flexbody/reduced_body.hpp"
#include "joints/coupler_law.hpp"

namespace limber::dynamics {

/// Mass of a rigid body about its centre of mass, body axes.
struct RigidInertia {
  double mass = 0.0;  ///< > 0 [kg]
  /// Symmetric, positive definite, and that of a mass: no principal moment
  /// more than the sum of the others, but for rounding to three digits
  /// [kg m^2].
  Matrix3 inertia = Matrix3::Zero();
};

/// Damping of a flexible body's modes: ratio_k omega_k 2 plus Rayleigh
/// alpha + beta omega_k^2.
struct ModalDamping {
  double rayleigh_mass = 0.0;       ///< alpha >= 0 [1/s]
  double rayleigh_stiffness = 0.0;  ///< beta >= 0 [s]
  std::vector<double> ratios;       ///< >= 0 per mode [-]; one value: all
};

/// Frame in which a load's components are constant.
enum class LoadFrame { body, world };

/// Puts a system together, each method checking what it is given: names that
/// are empty or twice among bodies, couplers, transmissions or loads, and
/// values that are not finite or outside their range throw InputError; indices
/// of what does not exist and tables of another size ContractError. Texts name
/// the thing; what was refused is not added. Frames' names may repeat.
class SystemBuilder {
 public:
  /// Body with frame B at its centre of mass.
  BodyIndex add_rigid_body(const std::string& name,
                           const RigidInertia& inertia);

  /// Flexible body; at Fidelity::rigid only its mass properties are used.
  BodyIndex add_flexible_body(const std::string& name,
                              std::shared_ptr<const flexbody::ReducedBody> body,
                              Fidelity fidelity, const ModalDamping& damping);

  /// Body without reduction (Fidelity::full). `body` is the same mesh reduced,
  /// with the rows of all nodes: for mass, names, damping and pictures.
  /// @throws InputError if their nodes differ.
  BodyIndex add_full_body(const std::string& name,
                          std::shared_ptr<const flexbody::ReducedBody> body,
                          std::shared_ptr<const flexbody::FullBody> full,
                          const ModalDamping& damping);

  /// A frame fixed to frame B of a body, whose deformation it does not feel:
  /// pose X_BF.
  AttachmentIndex attach_frame(const std::string& name, BodyIndex body,
                               const Pose& X_BF);
  /// A frame on a flexible body's interface; X_BF its undeformed pose.
  AttachmentIndex attach_interface(const std::string& name, BodyIndex body,
                                   const flexbody::InterfaceTable& interface,
                                   const Pose& X_BF);
  /// A frame on weighted nodes of an unreduced body; X_BF its undeformed pose.
  AttachmentIndex attach_nodes(const std::string& name, BodyIndex body,
                               const flexbody::NodeSet& nodes,
                               const Pose& X_BF);
  /// A frame fixed in the world.
  AttachmentIndex attach_world(const std::string& name, const Pose& X_WF);

  CouplerIndex add_coupler(const std::string& name,
                           const joints::CouplerLaw& law,
                           AttachmentIndex frame_F, AttachmentIndex frame_M);

  /// Laws along the length of a path through `points`, in order.
  TransmissionIndex add_path(const std::string& name,
                             const std::vector<AttachmentIndex>& points,
                             const std::vector<joints::ScalarLaw>& laws);

  /// Laws along a sum of joints' coordinates.
  TransmissionIndex add_joint_sum(const std::string& name, const JointSum& sum,
                                  const std::vector<joints::ScalarLaw>& laws);

  /// Force and moment at a body's attachment, constant components in the body
  /// frame B or the world frame, times `function`.
  LoadIndex add_load(const std::string& name, AttachmentIndex where,
                     const Vector3& force, const Vector3& moment,
                     LoadFrame frame, const TimeFunction& function);

  /// Nodal forces on a flexible body, which follow it.
  /// @param nodal 3N x T, of all nodes, for an unreduced body [N]
  void add_nodal_load(const std::string& name, BodyIndex body,
                      const flexbody::NodalLoad& history,
                      const MatrixX& nodal = {});

  /// Uniform gravitational acceleration [m/s^2], world frame.
  void set_gravity(const Vector3& gravity_W);

  /// @throws InputError if no body was added.
  [[nodiscard]] SystemModel build() const;

 private:
  BodyIndex add_body(const std::string& name, BodyModel body);
  [[nodiscard]] std::shared_ptr<const ModalInertia> find_inertia(
      const std::string& what, const flexbody::ReducedBody& reduced);
  [[nodiscard]] const BodyModel& find_body(const std::string& what,
                                           BodyIndex body) const;
  [[nodiscard]] const Attachment& find_frame(const std::string& what,
                                             AttachmentIndex frame) const;

  SystemModel model_;
  NameRegister names_;
  std::map<const flexbody::ReducedBody*, std::shared_ptr<const ModalInertia>>
      inertias_;
};

}  // namespace limber::dynamics
