// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/contact/law/contact_parameters.hpp"
#include "limber/contact/law/friction_memory.hpp"
#include "limber/contact/law/load_shells.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/contact/patches/patch_points.hpp"
#include "limber/contact/potential/pair_potential.hpp"

namespace limber::contact {

/// Friction at the last commit, and the motion since then.
struct PatchSlip {
  FrictionMemory last;
  BodyRotations rotations;
  Vector3 way_W = Vector3::Zero();  ///< of B against A since [m]
};

/// The speed of a pair's patches, one or more.
struct PatchMotion {
  double load = 0.0;          ///< sum N, elastic [N]
  double square = 0.0;        ///< sum twist . D twist [N m^2/s^2]
  double energy = 0.0;        ///< sum W [J]
  double inverse_mass = 0.0;  ///< of all along their normals [1/kg]
  /// Mean of both axes across them; 0 without rolling friction [1/(kg m^2)].
  double inverse_inertia = 0.0;
};

/// The wrench on B, about the centre of pressure.
struct PatchResponse {
  PatchWrench wrench;
  Vector3 normal_W = Vector3::Zero();    ///< from A to B [-]
  double normal_force = 0.0;             ///< damping included, >= 0 [N]
  Vector3 friction_W = Vector3::Zero();  ///< force on B [N]
  bool slips = false;
  double energy = 0.0;          ///< of friction, that of rolling included [J]
  double slip_work = 0.0;       ///< lost by slip and release, >= 0 [J]
  double damped = 0.0;          ///< by the normal damping, >= 0 [W]
  double rubbed = 0.0;          ///< by the damper of friction, >= 0 [W]
  double friction_power = 0.0;  ///< of friction on both bodies [W]
  FrictionMemory next;          ///< what to commit
};

/// Damping and friction of a patch, whose elastic forces follow from its
/// potential.
///
/// Equation   damping -s D twist, D = N P, P = (n n', -n x S n x) of the
///            pressure along the normal, s = beta / sqrt(sum twist . D twist /
///            sum N + 2 sum W / m) over all patches of the pair, or the
///            requested damping for, the normal force >= 0; friction of
///            LoadShells with the load N ~ d^p of the patch's exponent and k =
///            p / (p + 1) N^2 / W; r_e = 0.943 sqrt(tr S) of a round patch,
///            0.866 of a line; about n the stiffness is 1.875 G_r / G* times as
///            large, which is right under Hertz's pressure and 25 % high for a
///            round flat; of a point r_e = 3 pi a / 16 and 512 / (27 pi^2) G_r
///            / G*; resist_rolling
/// Source     [@hunt1975] with find_restitution_factor; kappa of [@mindlin1949]
/// Limits     one shell of all patches but points: right for flats, whose
///            stiffness is constant
class PatchLaw {
 public:
  /// @param is_point whether the bodies touch as HertzPair
  /// @param size of the bodies > 0, whose depth has the shells' k_0 [m]
  /// @throws InputError as check(parameters).
  PatchLaw(const ContactParameters& parameters, const PairModuli& moduli,
           bool is_point, double size);

  /// That slides or rolls.
  [[nodiscard]] bool has_friction() const { return slides_ || rolls(); }
  [[nodiscard]] bool is_point() const { return is_point_; }
  [[nodiscard]] bool rolls() const { return rolling_arm_ > 0.0; }
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

  /// P of a patch: motion . P motion is the mean square of its motion along the
  /// normal, weighted by the pressure [-; m^2].
  [[nodiscard]] static Matrix6 find_approach(const Patch& patch);
  /// twist . D twist of a patch [N m^2/s^2].
  [[nodiscard]] static double find_square(const Patch& patch,
                                          const Vector6& twist_W);

  /// Of friction's springs [J].
  [[nodiscard]] double find_energy(const FrictionMemory& memory) const;

 private:
  struct Rate;  // s of the damping
  [[nodiscard]] Rate find_rate(const PatchMotion& all) const;
  void add_damping(const Input& in, PatchResponse& out) const;
  void add_friction(const Input& in, PatchResponse& out) const;
  // @param pressed without friction
  void add_sliding(const Input& in, const PatchWrench& pressed,
                   const FrictionFrame& frame, ShellMemory& next,
                   PatchResponse& out) const;
  void add_rolling(const Input& in, const PatchWrench& pressed,
                   const FrictionFrame& frame, RollingSpring& next,
                   PatchResponse& out) const;

  // r_e [m]
  [[nodiscard]] double find_radius(const Patch& patch,
                                   const Vector3& normal_W) const;

  bool is_point_;
  LoadShells shells_;
  bool slides_;
  double rolling_arm_;             // [m]
  double factor_ = 0.0;            // beta [-]
  std::optional<double> damping_;  // s in place of it [s/m]
};

/// r_e of a patch's resistance to spin [m].
[[nodiscard]] double find_spin_radius(const Matrix3& spread_W,
                                      const Vector3& normal_W);

}  // namespace limber::contact
