// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/common/types.hpp"
#include "limber/contact/law/contact_damping.hpp"
#include "limber/contact/law/contact_parameters.hpp"
#include "limber/contact/law/hertz_law.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/contact/law/point_memory.hpp"

namespace limber::contact {

/// Motion at one contact point, world frame; n points from body A to body B,
/// relative quantities are those of B's material point minus A's.
struct PointMotion {
  Vector3 normal_W = Vector3::Zero();     ///< n, unit [-]
  double depth = 0.0;                     ///< d > 0 [m]
  double curvature = 0.0;                 ///< 1/R_e >= 0 [1/m]
  double residual = 0.0;                  ///< R >= 0 [m/N]
  double share = 1.0;                     ///< factor on the force > 0 [-]
  Vector3 velocity_W = Vector3::Zero();   ///< [m/s]
  Vector3 increment_W = Vector3::Zero();  ///< since the last commit [m]
  BodyTurns turns;
  double spin = 0.0;  ///< n . of B's rate of turn against A [rad/s]
  double time = 0.0;  ///< [s]

  /// d' for a constant normal [m/s].
  [[nodiscard]] double rate() const { return -normal_W.dot(velocity_W); }
};

/// What one contact point stores.
struct ElasticPoint {
  ElasticForce force;
  double energy = 0.0;  ///< [J]
  double area = 0.0;    ///< that touches, Hertz's [m^2]
  /// Constant stiffness of the surface, 0 for Hertz's [N/m].
  double flat_stiffness = 0.0;
};

/// Forces on B at one contact point.
struct PointResponse {
  Vector3 force_W = Vector3::Zero();     ///< normal force and friction [N]
  double normal_force = 0.0;             ///< [N]
  Vector3 friction_W = Vector3::Zero();  ///< [N]
  bool slips = false;
  double energy = 0.0;       ///< stored by friction [J]
  double dissipation = 0.0;  ///< of both dampers [W]
  double rubbed = 0.0;       ///< the part of it by friction's damper [W]
  double slip_power = 0.0;   ///< of slip and release, mean since the commit [W]
  Matrix3 stiffness = Matrix3::Zero();  ///< -d force / d position [N/m]
  Matrix3 damping = Matrix3::Zero();    ///< -d force / d velocity [N s/m]
  double moment = 0.0;                  ///< of friction about n [N m]
  /// d force / d turn [N], d moment / d turn [N m], d moment / d position [N].
  Vector3 force_by_turn = Vector3::Zero();
  double moment_by_turn = 0.0;
  Vector3 moment_by_position = Vector3::Zero();
  /// d force_W / d elastic force, if that depends on other points [-].
  Vector3 by_elastic_W = Vector3::Zero();
  PointMemory next = {};  ///< but for its places
};

/// Normal force and friction of one contact point.
///
/// Equation   f n + t: HertzLaw, damp and LoadShells, with k of the materials
///            and R_e, or of neither's material the default law; p = 3/2,
///            dN/dd and R of Hertz's law; of a flat surface one shell with a
///            tenth of the critical damping of the reduced mass. Materials
///            have friction about n too: r_e = 3 pi a / 16 of full slip
///            under Hertz's pressure, a = cbrt(3 N R_e / (4 E*)), and
///            c = 512 / (27 pi^2) G_r / G*, with which an area that sticks
///            turns with 16 a^3 G_r / 3
/// Source     [@johnson1985, chs. 4 and 7]
class PointLaw {
 public:
  /// @param moduli of both sides; none if neither has a material
  /// @param mass reduced mass of both bodies > 0 [kg]
  /// @param size largest R_e, for edges, corners and flat faces: half of the
  /// smaller body's size [m]
  /// @throws InputError as check(parameters).
  PointLaw(const ContactParameters& parameters,
           const std::optional<PairModuli>& moduli, double mass, double size);

  [[nodiscard]] bool has_friction() const { return has_friction_; }

  /// @param motion of a point with depth > 0
  [[nodiscard]] ElasticPoint find_elastic(const PointMotion& motion) const;

  /// Of the restitution, as of find_restitution_factor [-].
  [[nodiscard]] double damping_factor() const { return factor_; }
  /// For all points of a touch; the constant b of the parameters, if there.
  [[nodiscard]] DampingRate find_damping(const TouchMotion& touch) const;

  /// @param elastic at motion's depth, or the mean over a step
  [[nodiscard]] PointResponse evaluate(const PointMotion& motion,
                                       const ElasticPoint& elastic,
                                       const DampingRate& damping,
                                       const PointMemory& memory) const;

  /// The elastic force law for these surfaces; for a share w that of w k and
  /// R / w, so that the force at any depth is w times that of a whole point.
  [[nodiscard]] HertzLaw find_law(double curvature, double residual,
                                  double share = 1.0) const;
  /// Memory of a point after a first touch at this rate of depth [m/s].
  [[nodiscard]] PointMemory begin(double rate) const;
  /// T_c of an impact of both bodies at a speed > 0 [s].
  [[nodiscard]] double find_duration(const HertzLaw& law, double speed) const;

 private:
  void add_friction(const PointMotion& motion, const ElasticPoint& elastic,
                    const DampedForce& pressed, PointResponse& out) const;
  [[nodiscard]] LoadShells make_shells() const;
  [[nodiscard]] ShellLoad find_shell_load(const PointMotion& motion,
                                          const ElasticPoint& elastic) const;
  [[nodiscard]] double find_spin_radius(const PointMotion& motion,
                                        double force) const;
  // R_e [m]
  [[nodiscard]] double find_radius(double curvature) const;

  ContactParameters parameters_;
  std::optional<PairModuli> moduli_;
  double mass_;  // [kg]
  double size_;  // [m]
  bool has_friction_;
  LoadShells shells_;
  double factor_ = 0.0;  // beta of the restitution [-]
};

}  // namespace limber::contact
