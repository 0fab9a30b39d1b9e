// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/flexbody/model/full_body.hpp"

namespace limber::flexbody {

/// Stress at nodes of a body at level `full`: Cauchy's, by its material law.
/// Threads may share one.
class FullStress {
 public:
  FullStress() = default;
  FullStress(const FullStress&) = delete;
  FullStress& operator=(const FullStress&) = delete;
  virtual ~FullStress() = default;

  /// p: the node of each point, increasing; at a border of materials a point
  /// for each.
  [[nodiscard]] virtual const std::vector<int>& nodes() const = 0;
  /// @param u 3 x N displacements from x_B [m]
  /// @param stress 6 x p: components (xx, yy, zz, xy, yz, xz), axes of u [Pa]
  virtual void calc_stress(FullBodySolver::ConstField u,
                           Eigen::Ref<Matrix6X> stress) const = 0;
};

/// A solver of level `full` that also computes the stress of its body.
class StressedSolver : public FullBodySolver {
 public:
  /// @param nodes sorted indices
  [[nodiscard]] virtual std::shared_ptr<const FullStress> make_stress(
      const std::vector<int>& nodes) const = 0;
};

/// Null if the body's solver does not compute its stress.
[[nodiscard]] std::shared_ptr<const FullStress> make_full_stress(
    const FullBody& body, const std::vector<int>& nodes);

}  // namespace limber::flexbody
