// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "limber/common/types.hpp"
#include "limber/contact/law/friction_limit.hpp"

namespace limber::contact {

/// Most shells of a contact.
inline constexpr std::size_t kShells = 5;

/// The part of a contact's area that belongs to one range of its stiffness.
struct LoadShell {
  double stiffness = 0.0;  ///< tangential, 0 of one that does not touch [N/m]
  /// Of its spring in two tangential directions, and about the normal, there
  /// over r_e [N].
  Vector3 spring = Vector3::Zero();
};

/// All shells of a contact: a plain value, part of the state.
struct ShellMemory {
  double lowest = 0.0;  ///< level of the lowest one on the grid [-]
  std::array<LoadShell, kShells> shells = {};  ///< from the lowest
};

/// Normal load N ~ d^p of a contact.
struct ShellLoad {
  double force = 0.0;      ///< N, elastic, >= 0 [N]
  double stiffness = 0.0;  ///< k = dN/dd > 0 [N/m]
  double exponent = 1.0;   ///< p >= 1 [-]
  /// R in series: the shells' stiffness is divided by 1 + R k, that by 1/2 at
  /// least [m/N].
  double residual = 0.0;
  double grip = 1.0;  ///< g >= 0, the normal force with damping over N [-]
};

/// In two tangential directions, and about the normal, there times r_e.
struct ShellMotion {
  Vector3 increment = Vector3::Zero();  ///< u since the last commit [m]
  Vector3 velocity = Vector3::Zero();   ///< v [m/s]
};

/// Friction in the directions of the motion.
struct ShellResponse {
  Vector3 force = Vector3::Zero();  ///< [N]
  bool slips = false;               ///< nothing sticks
  double energy = 0.0;              ///< of the springs [J]
  double slip_work = 0.0;           ///< lost by slip and release, >= 0 [J]
  double damper_power = 0.0;        ///< >= 0 [W]
  Matrix3 by_increment = Matrix3::Zero();  ///< [N/m]
  Matrix3 by_velocity = Matrix3::Zero();   ///< [N s/m]
  Vector3 by_load = Vector3::Zero();       ///< d force / dN, g held [-]
  Vector3 by_grip = Vector3::Zero();       ///< d force / dg [N]
  ShellMemory next = {};  ///< what to commit when the step is accepted
};

/// Friction of a contact whose area grows with its load: springs in shells,
/// each of which slips at the friction of its own fraction of the load.
///
/// Equation   levels k_j = k_0 q^j, q = 1.5, up to the highest below k; four
///            below that are kept, and what is lower belongs to the lowest. A
///            shell has the stiffness k_s = kappa (min(k, k_{j+1}) - k_j) /
///            (1 + R k), with 0 for the lowest k_j, about the normal times c,
///            and the load N_j = L_j - L_{j+1}, L_j = N (1 - x^p) -
///            k_j d (1 - x), x = (k_j / k)^(1/(p-1)), d = p N / k, L = N of
///            the lowest. Its spring T_0 min(1, k_s / k_s0) + k_s u is returned
///            to the cone |T| <= mu(v) g N_j; the force is -sum T, and a
///            damper's -c_t v within mu g N. For p < 1.05 there is one shell.
/// Source     Jaeger's principle: [@johnson1985, ch. 7]; return mapping:
///            [@wriggers2006, ch. 5]
/// Limits     a spring that is released with its area loses its energy
class LoadShells {
 public:
  struct Parameters {
    FrictionLimit limit = {};          ///< mu
    double tangential_ratio = 1.0;     ///< kappa > 0 [-]
    double spin_ratio = 0.0;           ///< c >= 0 [-]
    double reference_stiffness = 1.0;  ///< k_0 > 0 [N/m]
  };
  /// @throws InputError for a value outside its range.
  explicit LoadShells(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }

  /// Does not change the memory: memory = response.next commits. All zero at
  /// N = 0.
  /// @param damping c_t >= 0 [N s/m]
  [[nodiscard]] ShellResponse evaluate(const ShellMemory& memory,
                                       const ShellLoad& load,
                                       const ShellMotion& motion,
                                       double damping = 0.0) const;

  /// Of all springs [J].
  [[nodiscard]] double find_energy(const ShellMemory& memory) const;

 private:
  // A shell under a load, with its derivatives by N.
  struct Part {
    double stiffness = 0.0;
    double stiffness_by_load = 0.0;
    double load = 0.0;
    double load_by_load = 0.0;
  };
  using Parts = std::array<Part, kShells>;
  [[nodiscard]] double find_stiffness(double level) const;
  [[nodiscard]] ShellMemory move(const ShellMemory& memory,
                                 const ShellLoad& load) const;
  [[nodiscard]] Parts find_parts(double lowest, const ShellLoad& load) const;
  [[nodiscard]] double find_energy(const LoadShell& shell) const;
  void add_shell(const LoadShell& before, const Part& part,
                 const ShellMotion& motion, double limit_by_load,
                 ShellResponse& out, LoadShell& next) const;

  Parameters parameters_;
};

/// c_t by its damping ratio [-] with `mass` on k_t [N s/m].
[[nodiscard]] double find_spring_damping(double stiffness, double mass,
                                         double damping_ratio = 0.1);

}  // namespace limber::contact
