// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/dynamics/kernels/modal_inertia.hpp"
#include "limber/dynamics/system/controller.hpp"
#include "limber/dynamics/system/fidelity.hpp"
#include "limber/dynamics/system/indices.hpp"
#include "limber/dynamics/system/nodal_frame.hpp"
#include "limber/dynamics/system/time_function.hpp"
#include "limber/flexbody/elasticity/modal_elasticity.hpp"
#include "limber/flexbody/modal/maxwell_elements.hpp"
#include "limber/flexbody/model/nodal_load.hpp"
#include "limber/flexbody/model/quadratic_frame.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/joints/coupler_law.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::dynamics {

/// One body's constants. m modes, 0 when rigid.
struct BodyModel {
  std::string name;
  Fidelity fidelity = Fidelity::rigid;
  bool clamped = false;          ///< B is fixed in the world
  double mass = 0.0;             ///< [kg]
  Matrix3 J0 = Matrix3::Zero();  ///< inertia, undeformed [kg m^2]
  int modes = 0;                 ///< number of modes m
  int offset = 0;        ///< index of the first modal coordinate in the state
  Eigen::Index row = 0;  ///< index of its first unknown (unknowns.hpp)
  flexbody::ModalElasticity elasticity;  ///< of m modes
  VectorX damping;                       ///< m, diagonal of C [1/s]
  flexbody::MaxwellElements maxwell;     ///< J of each mode; J = 0: none
  int maxwell_offset = 0;  ///< index of the first in SystemState::maxwell
  /// Without columns when rigid; never null.
  std::shared_ptr<const ModalInertia> inertia =
      std::make_shared<const ModalInertia>();
  Matrix3X P;  ///< 3 x m, int phi_k dm [kg^1/2]; no columns unless clamped
  /// The reduced body; null for a rigid body. For probes and pictures.
  std::shared_ptr<const flexbody::ReducedBody> reduced;
  int full = -1;  ///< index into SystemModel::full_bodies, -1 if reduced

  /// Whether frame B has its own equations of motion: that of a clamped body is
  /// fixed, and that of an unreduced one follows its nodes.
  [[nodiscard]] bool has_rigid_motion() const { return !clamped && full < 0; }
  /// Whether the world holds it.
  [[nodiscard]] bool is_held() const { return clamped; }
};

/// Additional data of a BodyModel at level `full`.
struct FullModel {
  BodyIndex body;
  Eigen::Index first = 0;  ///< index of its 3N entries in SystemState::u_H
  std::shared_ptr<const flexbody::FullBody> mesh;
  /// Damping acts on the deformation's fraction in the reduced body's modes.
  MatrixX damped_modes;  ///< 3N x m, M Phi [kg^1/2]; no columns if undamped
  VectorX damping;       ///< m [1/s]
  /// Whether forces depend on the mean-axis frame: loads that rotate with the
  /// body, or damping.
  bool needs_frame = false;

  [[nodiscard]] Eigen::Index dofs() const { return 3 * mesh->node_count(); }
};

/// A frame that follows a body's interface (or the world).
struct Attachment {
  std::string name;
  BodyIndex body = kWorld;
  Vector3 p_BF = Vector3::Zero();      ///< undeformed origin [m]
  Matrix3 R_BF = Matrix3::Identity();  ///< [-]
  Matrix3X Phi_B;  ///< 3 x m [kg^-1/2]; zero columns if the body is rigid
  Matrix3X Psi_B;  ///< 3 x m [kg^-1/2 m^-1]
  std::shared_ptr<const NodalFrame> nodal = nullptr;  ///< of an unreduced body
  /// Of an interface at level nonlinear; else null.
  std::shared_ptr<const flexbody::QuadraticFrame> second = nullptr;
};

struct Coupler {
  std::string name;
  joints::CouplerLaw law;
  AttachmentIndex frame_F;
  AttachmentIndex frame_M;
};

/// The length of a path through the origins of attachments, which may follow
/// different bodies: z = sum_i |p_i+1 - p_i| [m].
struct PathCoordinate {
  std::vector<AttachmentIndex> points;  ///< two or more
};
/// A sum of joints' coordinates: z = sum_i factor_i q_i - offset.
struct JointSum {
  struct Term {
    CouplerIndex coupler;  ///< a joint
    int coordinate = 0;    ///< index of the joint's coordinate
    double factor = 1.0;   ///< [unit of z / unit of q]
  };
  std::vector<Term> terms;
  double offset = 0.0;  ///< [unit of z]
};

/// Couples more than two frames by laws along one coordinate: a tendon, a pair
/// of gears, a joint that mimics another.
struct Transmission {
  std::string name;
  std::variant<PathCoordinate, JointSum> coordinate;
  std::vector<joints::ScalarLaw> laws;
};

/// Two bodies, or a body and the world, that may act on each other at points
/// that appear and disappear.
struct Pair {
  std::string name;
  BodyIndex body_A = kWorld;
  BodyIndex body_B = kWorld;
  std::shared_ptr<const joints::PairInteraction> law;
  std::size_t first_memory = 0;  ///< of it in SystemState::pair_memory
};

struct Load {
  std::string name;
  AttachmentIndex where;
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< [N m]
  bool in_world = false;
  TimeFunction function;
};

/// Nodal forces on one body, in reduced form.
struct BodyLoad {
  std::string name;
  BodyIndex body;
  flexbody::NodalLoad history;
  MatrixX nodal;  ///< 3N x T nodal forces of an unreduced body, frame B [N]
};

/// Bodies, couplers and loads; immutable once built, shared by threads.
struct SystemModel {
  std::vector<BodyModel> bodies;
  std::vector<Attachment> attachments;
  std::vector<Coupler> couplers;
  std::vector<Transmission> transmissions;
  std::vector<Load> loads;
  std::vector<BodyLoad> body_loads;
  Vector3 gravity_W = Vector3::Zero();  ///< [m/s^2]
  int modal_count = 0;                  ///< number of modes of all bodies
  int maxwell_count = 0;                ///< number of their Maxwell elements
  std::vector<FullModel> full_bodies;
  Eigen::Index nodal_count = 0;  ///< number 3N of all unreduced bodies together
  std::vector<Input> inputs;
  std::vector<ControllerModel> controllers;
  std::vector<Pair> pairs;
  std::size_t pair_memory_size = 0;  ///< number of values of all pairs together

  /// @throws InputError for an unknown name, with the nearest; for an
  /// attachment also if several have it.
  [[nodiscard]] BodyIndex find_body(std::string_view name) const;
  [[nodiscard]] AttachmentIndex find_attachment(std::string_view name) const;
  [[nodiscard]] CouplerIndex find_coupler(std::string_view name) const;
  [[nodiscard]] TransmissionIndex find_transmission(
      std::string_view name) const;
  [[nodiscard]] LoadIndex find_load(std::string_view name) const;
};

/// Whether a joint holds its directions by constraints, not by stiffness.
[[nodiscard]] bool has_ideal_joints(const SystemModel& model);

}  // namespace limber::dynamics
