// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "joints/bushing.hpp"
#include "joints/coupler_memory.hpp"
#include "joints/scalar_motion.hpp"

namespace limber::joints {

/// A bushing that is not there until two frames come near each other, rests in
/// the pose in which it caught them, and stays until it is released for good.
///
/// Equation   closes when |p_FM| falls to `reach`; then the bushing's, with
///            p_FM - p_0 and R_FM R_0^T. Opens at `release_time` or when the
///            force of its spring exceeds `release_force`; what it stores then
///            is lost. A latch that is released before it closes never does.
class Latch {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  struct Parameters {
    double reach = 0.0;  ///< > 0 [m]
    Bushing::Parameters bushing = {};
    double release_force = kNever;  ///< > 0 [N]
    double release_time = kNever;   ///< > -infinity [s]
  };

  /// @throws InputError for a value outside its range.
  explicit Latch(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion,
                                         const CouplerMemory& memory) const;

  /// Rises through zero: when the latch closes (0, while it is open) or gives
  /// way (0, while it is closed); at its release time (1).
  [[nodiscard]] static int switch_count() { return 2; }
  [[nodiscard]] SwitchValue find_switch(int index, const RelativeMotion& motion,
                                        const CouplerMemory& memory,
                                        double t) const;
  /// What it remembers after switch `index` rose.
  void update(int index, const RelativeMotion& motion,
              CouplerMemory& memory) const;

 private:
  Parameters parameters_;
  Bushing bushing_;
};

}  // namespace limber::joints
