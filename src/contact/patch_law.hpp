// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/law/contact_parameters.hpp"
#include "limber/contact/patch_points.hpp"
#include "limber/contact/potential/pair_potential.hpp"

namespace limber::contact {

/// The bristle of a patch: its spring, and its motion since then.
struct PatchSlip {
  Vector3 spring_W = Vector3::Zero();  ///< k s at the last step's end [N]
  double spin = 0.0;                   ///< likewise about n, over r_e [N]
  double stiffness = 0.0;              ///< k_t then [N/m]
  Vector3 way_W = Vector3::Zero();     ///< of B against A since [m]
  double turn = 0.0;                   ///< about n since [rad]
};

/// The speed of a pair's patches, one or more.
struct PatchMotion {
  double load = 0.0;          ///< sum N, elastic [N]
  double square = 0.0;        ///< sum twist . D twist [N m^2/s^2]
  double energy = 0.0;        ///< sum W [J]
  double inverse_mass = 0.0;  ///< of all along their normals [1/kg]
};

/// What acts on B, about the centre of pressure.
struct PatchResponse {
  PatchWrench wrench;
  Vector3 normal_W = Vector3::Zero();    ///< from A to B [-]
  double normal_force = 0.0;             ///< damping included, >= 0 [N]
  Vector3 friction_W = Vector3::Zero();  ///< force on B [N]
  bool slips = false;
  double energy = 0.0;          ///< of the bristle [J]
  double slip_work = 0.0;       ///< lost by slip and release, >= 0 [J]
  double damped = 0.0;          ///< by the normal damping, >= 0 [W]
  double rubbed = 0.0;          ///< by the bristle's damper, >= 0 [W]
  double friction_power = 0.0;  ///< of friction on both bodies [W]
  PatchSlip next;               ///< spring, spin and stiffness after it
};

/// Damping and friction of a patch, whose elastic forces follow from its
/// potential.
///
/// Equation   damping -s D twist, D = N (n n', -n x S n x) of the pressure
///            along the normal, s = beta / sqrt(sum twist . D twist / sum N + 2
///            sum W / m) over all patches of the pair,
///            the normal force >= 0; friction of one bristle of stiffness kappa
///            N^2 / (2 W) in two directions and about n, there times r_e^2,
///            within mu N (ConeReturn), its spring released with the stiffness;
///            r_e = 0.943 sqrt(tr S) of a round patch, 0.866 of a line
/// Source     [@hunt1975] with find_restitution_factor; kappa of [@mindlin1949]
/// Limits     one bristle: right for flats, whose stiffness is constant; mu's
///            change with the speed is not in the tangent
class PatchLaw {
 public:
  /// @throws InputError as check(parameters).
  PatchLaw(const ContactParameters& parameters, double tangential_ratio);

  [[nodiscard]] bool has_friction() const { return has_friction_; }
  [[nodiscard]] double damping_factor() const { return factor_; }

  struct Input {
    const Patch& patch;  ///< that touches
    Vector6 elastic_W;   ///< wrench on B: -gradient, or the mean over a step
    Vector6 twist_W;     ///< of B against A about the centre
    PatchMotion all;     ///< of all patches, this one included
    PatchSlip slip;
    /// d way / d motion in the tangent: 2 over a step, whose motions are those
    /// of its middle [-].
    double way_by_motion = 1.0;
  };
  [[nodiscard]] PatchResponse evaluate(const Input& in) const;

  /// twist . D twist of a patch [N m^2/s^2].
  [[nodiscard]] static double find_square(const Patch& patch,
                                          const Vector6& twist_W);

 private:
  void add_damping(const Input& in, PatchResponse& out) const;
  void add_friction(const Input& in, PatchResponse& out) const;

  FrictionLimit friction_;
  double tangential_ratio_;  // kappa [-]
  bool has_friction_;
  double factor_;  // beta [-]
};

/// r_e of a patch's resistance to spin [m].
[[nodiscard]] double find_spin_radius(const Matrix3& spread_W,
                                      const Vector3& normal_W);

}  // namespace limber::contact
