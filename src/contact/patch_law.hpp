// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/law/contact_parameters.hpp"
#include "limber/contact/law/friction_memory.hpp"
#include "limber/contact/law/load_shells.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/contact/patch_points.hpp"
#include "limber/contact/potential/pair_potential.hpp"

namespace limber::contact {

/// What friction has been, and the motion since then.
struct PatchSlip {
  FrictionMemory last;
  BodyTurns turns;
  Vector3 way_W = Vector3::Zero();  ///< of B against A since [m]
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
  double energy = 0.0;          ///< of friction [J]
  double slip_work = 0.0;       ///< lost by slip and release, >= 0 [J]
  double damped = 0.0;          ///< by the normal damping, >= 0 [W]
  double rubbed = 0.0;          ///< by the damper of friction, >= 0 [W]
  double friction_power = 0.0;  ///< of friction on both bodies [W]
  FrictionMemory next;          ///< what to commit
};

/// Damping and friction of a patch, whose elastic forces follow from its
/// potential.
///
/// Equation   damping -s D twist, D = N (n n', -n x S n x) of the pressure
///            along the normal, s = beta / sqrt(sum twist . D twist / sum N + 2
///            sum W / m) over all patches of the pair,
///            the normal force >= 0; friction of LoadShells for a flat, of
///            stiffness kappa N^2 / (2 W), within mu N; r_e = 0.943 sqrt(tr S)
///            of a round patch, 0.866 of a line; about n the stiffness is
///            1.875 G_r / G* times as large, which is right under Hertz's
///            pressure and 25 % high for a round flat
/// Source     [@hunt1975] with find_restitution_factor; kappa of [@mindlin1949]
/// Limits     one shell: right for flats, whose stiffness is constant, which
///            the tangent takes it to be
class PatchLaw {
 public:
  /// @throws InputError as check(parameters).
  PatchLaw(const ContactParameters& parameters, const PairModuli& moduli);

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

  /// Of friction's springs [J].
  [[nodiscard]] double find_energy(const FrictionMemory& memory) const;

 private:
  void add_damping(const Input& in, PatchResponse& out) const;
  void add_friction(const Input& in, PatchResponse& out) const;

  LoadShells shells_;
  bool has_friction_;
  double factor_;  // beta [-]
};

/// r_e of a patch's resistance to spin [m].
[[nodiscard]] double find_spin_radius(const Matrix3& spread_W,
                                      const Vector3& normal_W);

}  // namespace limber::contact
