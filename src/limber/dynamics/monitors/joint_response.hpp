// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/monitors/contact_record.hpp"
#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// Whether a joint of two rigid bodies is stiff enough for the shortest impact
/// on one of them.
///
/// Equation   fraction = f T_c, f = sqrt(k / mu) / (2 pi) of the joint's
///            constrained translations, mu the reduced mass of its bodies
/// Source     a hinged rigid bar strikes a plane near its end; error of its
///            rebound against that of an ideal hinge, at fraction: 54 % at
///            0.24, 9.5 % at 0.75, 5.5 % at 1.2, 0.8 % at 2.4, 0.2 % at 4.7
struct JointResponse {
  static constexpr double kEnough = 2.0;  ///< fraction [-]

  std::string pair;        ///< name
  std::string joint;       ///< name
  double duration = 0.0;   ///< T_c, expected, of the shortest impact [s]
  double frequency = 0.0;  ///< f [Hz]

  [[nodiscard]] double fraction() const { return frequency * duration; }
  [[nodiscard]] bool is_enough() const { return fraction() >= kEnough; }
};

/// One for each pair of bodies that touched and each joint that is connected to
/// one of them, where neither of the joint's bodies has modes.
[[nodiscard]] std::vector<JointResponse> find_joint_responses(
    const SystemModel& model, const std::vector<ContactRecord>& records);

/// One sentence with its numbers.
[[nodiscard]] std::string describe(const JointResponse& response);

}  // namespace limber::dynamics
