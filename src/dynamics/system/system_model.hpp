// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "common/pose.hpp"
#include "dynamics/fidelity.hpp"
#include "dynamics/nodal_frame.hpp"
#include "dynamics/time_function.hpp"
#include "flexbody/nodal_load.hpp"
#include "flexbody/reduced_body.hpp"
#include "joints/coupler_law.hpp"

namespace limber::dynamics {

using BodyIndex = int;
using AttachmentIndex = int;
using CouplerIndex = int;
using TransmissionIndex = int;
using LoadIndex = int;
inline constexpr BodyIndex kWorld = -1;

/// Derivatives of a body's inertia by its modes, and the coupling of modes by
/// rotation, packed for the inner loops. Of one reduced body, whichever bodies
/// of the system it is: they read the same numbers, which stay in caches.
///
/// Equation   J(eta) = J0 + J1 eta + eta' J2 eta / 2,
///            components (xx, yy, zz, xy, xz, yz)
struct ModalInertia {
  Matrix6X J1;   ///< 6 x m
  MatrixX J2;    ///< 6m x m, row 6k + c
  MatrixX beta;  ///< 3m x m, row 3l + c: beta_kl in column k
};

/// One body's constants. m modes, 0 when rigid.
struct BodyModel {
  std::string name;
  Fidelity fidelity = Fidelity::rigid;
  bool clamped = false;          ///< B is fixed in the world
  double mass = 0.0;             ///< [kg]
  Matrix3 J0 = Matrix3::Zero();  ///< inertia, undeformed [kg m^2]
  int modes = 0;
  int offset = 0;   ///< first modal coordinate in the state
  VectorX lambda;   ///< m [rad^2/s^2]
  VectorX damping;  ///< m, diagonal of C [1/s]
  /// Without columns when rigid; never null.
  std::shared_ptr<const ModalInertia> inertia =
      std::make_shared<const ModalInertia>();
  Matrix3X P;  ///< 3 x m, int phi_k dm; no columns unless clamped
  /// What was reduced; null for a rigid body. For probes and pictures.
  std::shared_ptr<const flexbody::ReducedBody> reduced;
  int full = -1;  ///< index into SystemModel::full_bodies, -1 if reduced

  /// Whether frame B moves by equations of its own: that of a clamped body
  /// rests, and that of an unreduced one follows its nodes.
  [[nodiscard]] bool has_rigid_motion() const { return !clamped && full < 0; }
};

/// What level `full` adds to a BodyModel.
struct FullModel {
  BodyIndex body = 0;
  Eigen::Index first = 0;  ///< of its 3N entries in SystemState::u_H
  std::shared_ptr<const flexbody::FullBody> mesh;
  /// Damping acts on the deformation's share in the reduced body's modes.
  MatrixX damped_modes;  ///< 3N x m, M Phi; no columns if undamped
  VectorX damping;       ///< m [1/s]
  /// Whether forces depend on the mean-axis frame: loads that turn with the
  /// body, or damping.
  bool needs_frame = false;

  [[nodiscard]] Eigen::Index dofs() const { return 3 * mesh->node_count(); }
};

/// A frame that follows a body's interface (or the world).
struct Attachment {
  std::string name;
  BodyIndex body = kWorld;
  Vector3 p_BF = Vector3::Zero();  ///< undeformed origin [m]
  Matrix3 R_BF = Matrix3::Identity();
  Matrix3X Phi_B;  ///< 3 x m; zero columns if the body is rigid
  Matrix3X Psi_B;  ///< 3 x m
  std::shared_ptr<const NodalFrame> nodal = nullptr;  ///< of an unreduced body
};

struct Coupler {
  std::string name;
  joints::CouplerLaw law;
  AttachmentIndex frame_F = 0;
  AttachmentIndex frame_M = 0;
};

/// The length of a path through the origins of attachments, which may follow
/// different bodies: z = sum_i |p_i+1 - p_i| [m].
struct PathCoordinate {
  std::vector<AttachmentIndex> points;  ///< two or more
};
/// A sum of joints' coordinates: z = sum_i factor_i q_i - offset.
struct JointSum {
  struct Term {
    CouplerIndex coupler = 0;  ///< a joint
    int coordinate = 0;        ///< of it
    double factor = 1.0;       ///< [unit of z / unit of q]
  };
  std::vector<Term> terms;
  double offset = 0.0;
};

/// What couples more than two frames: laws along one coordinate of them all. A
/// tendon, a pair of gears, a joint that mimics another.
struct Transmission {
  std::string name;
  std::variant<PathCoordinate, JointSum> coordinate;
  std::vector<joints::ScalarLaw> laws;
};

struct Load {
  std::string name;
  AttachmentIndex where = 0;
  Vector3 force = Vector3::Zero();
  Vector3 moment = Vector3::Zero();
  bool in_world = false;
  TimeFunction function;
};

/// Nodal forces on one body, in reduced form.
struct BodyLoad {
  std::string name;
  BodyIndex body = 0;
  flexbody::NodalLoad history;
  MatrixX nodal;  ///< 3N x T nodal forces of an unreduced body, axes of B [N]
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
  int modal_count = 0;                  ///< modal coordinates of all bodies
  std::vector<FullModel> full_bodies;
  Eigen::Index nodal_count = 0;  ///< 3N of all unreduced bodies together
};

}  // namespace limber::dynamics
