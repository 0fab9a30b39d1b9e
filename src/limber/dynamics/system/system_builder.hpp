// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/dynamics/system/default_stiffness.hpp"
#include "limber/dynamics/system/fidelity.hpp"
#include "limber/dynamics/system/modal_damping.hpp"
#include "limber/dynamics/system/name_register.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/time_function.hpp"
#include "limber/flexbody/elasticity/modal_elasticity.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/joints/coupler_law.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::dynamics {

/// Mass properties of a rigid body about its centre of mass, body frame.
struct RigidInertia {
  double mass = 0.0;  ///< > 0 [kg]
  /// Symmetric, positive definite and physical: no principal moment exceeds the
  /// sum of the others, up to rounding to three digits [kg m^2].
  Matrix3 inertia = Matrix3::Zero();
};

/// Frame in which a load's components are constant.
enum class LoadFrame { body, world };

/// One side of a joint: a frame on a body, or in the world.
struct JointSide {
  BodyIndex body = kWorld;
  /// Pose of the joint's frame on the undeformed body. By default the middle of
  /// the interface, with the axes of B; without interface the frame B itself.
  std::optional<Pose> X_BF{};
  /// The interface that carries the joint on a flexible body: by name, or as a
  /// table.
  std::variant<std::monostate, std::string, flexbody::InterfaceTable>
      interface {};
};

/// Of a joint; all by default.
struct JointOptions {
  Vector3 second_F = Vector3::UnitX();  ///< of universal ones; any length [-]
  CouplerOptions held{};                ///< default: find_joint_parameters
  /// End stops, friction, springs, drives along its coordinates.
  std::vector<joints::JointElement> elements{};
};

/// Builds a system; each method checks its arguments. Empty or duplicate names
/// among bodies, couplers, transmissions, loads, inputs or controllers, and
/// values that are not finite or out of range throw InputError; invalid indices
/// and tables of wrong size ContractError. Messages name the object; a rejected
/// object is not added. Names of frames may repeat.
class SystemBuilder {
 public:
  /// Body with frame B at its centre of mass.
  BodyIndex add_rigid_body(const std::string& name,
                           const RigidInertia& inertia);

  /// Flexible body; at Fidelity::rigid only its mass properties are used.
  /// Fidelity::nonlinear needs a body with a manifold.
  /// @param elasticity of its modes, in place of the reduced body's linear one
  /// @throws InputError for an elasticity with another number of modes, or for
  /// damping by natural frequencies if it couples the modes; at level nonlinear
  /// for a body without second-order tables, or with an elasticity.
  BodyIndex add_flexible_body(
      const std::string& name,
      std::shared_ptr<const flexbody::ReducedBody> body, Fidelity fidelity,
      const ModalDamping& damping,
      const std::optional<flexbody::ModalElasticity>& elasticity = {});

  /// Body without reduction (Fidelity::full). `body` is the same mesh reduced,
  /// with the rows of all nodes: for mass, names, damping and pictures.
  /// @throws InputError if their nodes differ.
  BodyIndex add_full_body(const std::string& name,
                          std::shared_ptr<const flexbody::ReducedBody> body,
                          std::shared_ptr<const flexbody::FullBody> full,
                          const ModalDamping& damping);

  /// A frame fixed to frame B of a body, independent of its deformation: pose
  /// X_BF.
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

  /// A joint between frame F on `parent` and frame M on `child`, which coincide
  /// where its coordinates are zero. The frames are attached as NAME.F and
  /// NAME.M, see attach_frame and attach_interface.
  /// @param axis_F of any length; ignored if the kind has no axis
  /// @throws InputError also for an unknown interface, with the nearest; a
  /// flexible body without interface; one that does not define a rotation that
  /// the joint needs; two sides that cannot move.
  /// @throws ContractError also for an element on a coordinate that the kind
  /// does not have.
  CouplerIndex add_joint(const std::string& name, joints::JointKind kind,
                         const JointSide& parent, const JointSide& child,
                         const Vector3& axis_F = Vector3::UnitZ(),
                         const JointOptions& options = {});

  /// Laws along the length of a path through `points`, in order.
  TransmissionIndex add_path(const std::string& name,
                             const std::vector<AttachmentIndex>& points,
                             const std::vector<joints::ScalarLaw>& laws);

  /// Laws along a sum of joints' coordinates.
  TransmissionIndex add_joint_sum(const std::string& name, const JointSum& sum,
                                  const std::vector<joints::ScalarLaw>& laws);

  /// A law between two bodies, or a body and the world (kWorld). The pairs of a
  /// system are fixed; their points come and go.
  /// @throws InputError also for a body at level `full`, a body with itself,
  /// and a law that does not fit the bodies.
  PairIndex add_pair(const std::string& name, BodyIndex body_A,
                     BodyIndex body_B,
                     std::shared_ptr<const joints::PairInteraction> law);
  /// The origin of an attachment as a place of a pair, world frame in the
  /// world.
  [[nodiscard]] joints::PairPlace find_place(AttachmentIndex attachment) const;

  /// Force and moment at a body's attachment, constant components in the body
  /// frame B or the world frame, times `function`.
  LoadIndex add_load(const std::string& name, AttachmentIndex where,
                     const Vector3& force, const Vector3& moment,
                     LoadFrame frame, const TimeFunction& function);

  /// Nodal forces on a flexible body, constant in its frame.
  /// @param nodal 3N x T, of all nodes, for an unreduced body [N]
  void add_nodal_load(const std::string& name, BodyIndex body,
                      const flexbody::NodalLoad& history,
                      const MatrixX& nodal = {});

  /// A value that loads (InputFunction) and drives (joints::InputSignal) added
  /// later can follow.
  InputIndex add_input(const std::string& name, double initial,
                       InputHold hold = InputHold::held);

  /// Adds a controller. @throws InputError also for an input that another
  /// controller writes, a period that is not > 0, or no input.
  ControllerIndex add_controller(const ControllerModel& controller);

  /// Uniform gravitational acceleration [m/s^2], world frame.
  void set_gravity(const Vector3& gravity_W);

  /// @throws InputError if no body was added, or as check_model does.
  [[nodiscard]] SystemModel build() const;

 private:
  BodyIndex add_body(const std::string& name, BodyModel body);
  [[nodiscard]] std::shared_ptr<const ModalInertia> find_inertia(
      const std::string& what, const flexbody::ReducedBody& reduced,
      Fidelity fidelity);
  struct Mount;
  [[nodiscard]] Mount find_mount(const std::string& what,
                                 const JointSide& side) const;
  AttachmentIndex attach(const std::string& name, BodyIndex body,
                         const Mount& mount);
  [[nodiscard]] const BodyModel& find_body(const std::string& what,
                                           BodyIndex body) const;
  [[nodiscard]] const Attachment& find_frame(const std::string& what,
                                             AttachmentIndex frame) const;
  void check_inputs(const std::string& what,
                    const std::vector<int>& inputs) const;

  SystemModel model_;
  NameRegister names_;
  // By reduced body, and whether to second order.
  std::map<std::pair<const flexbody::ReducedBody*, bool>,
           std::shared_ptr<const ModalInertia>>
      inertias_;
};

}  // namespace limber::dynamics
