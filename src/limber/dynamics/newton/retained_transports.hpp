// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/common/types.hpp"
#include "limber/dynamics/newton/block_lu.hpp"
#include "limber/dynamics/newton/retained_bodies.hpp"

namespace limber::dynamics {

/// Makes the rigid increments of retained bodies relative to those of their
/// parents: x = y + T x_parent, T the rigid transport. Links between a retained
/// body and its parent then have no entries in the parent's rigid increments,
/// exactly, so that its inertia is not added to their stiffness.
///
/// Equation   A := U' A U, U = 1 + T in (retained body, parent) of each pair,
/// the
///            descendants before their ancestors; U' with T at the acting
///            wrenches' configuration
///            T = [1, -skew(p - p_parent) R_parent; 0, R' R_parent]
///            for translations in the world and rotations in the body
class RetainedTransports {
 public:
  RetainedTransports() = default;
  /// @param first_rows of each retained body: the row of its rigid motion
  /// @param edges of the matrix without transports; those that these add are
  /// appended
  RetainedTransports(const LinkGraph& graph,
                     const std::vector<RetainedBody>& retained,
                     const std::vector<int>& first_rows, int row_count,
                     std::vector<std::pair<int, int>>& edges);

  /// Sets T. @param find_acting, find_moving the pose of a body in the world
  /// where wrenches act and where their laws are evaluated
  template <typename FindActing, typename FindMoving>
  void update(const FindActing& find_acting, const FindMoving& find_moving) {
    for (Transport& t : transports_) {
      t.acting = transport(find_acting(t.body), find_acting(t.parent_body));
      t.moving = transport(find_moving(t.body), find_moving(t.parent_body));
    }
  }
  /// A := U' A U, links' rows without their stiffness.
  void transform(BlockLu& lu) const;
  /// b := U' b.
  void transform_right(std::vector<Vector6>& b) const;
  /// x := U x.
  void restore(std::vector<Vector6>& x) const;

  /// T for poses in the world.
  [[nodiscard]] static Matrix6 transport(const Pose& body, const Pose& parent);

 private:
  struct Transport {
    int body = 0;
    int parent_body = 0;
    int row = 0;                    // of its rigid motion
    int parent_row = 0;             // likewise
    std::vector<int> neighbours{};  // rows with entries in `row` to transport
    Matrix6 acting = Matrix6::Zero();
    Matrix6 moving = Matrix6::Zero();
  };

  std::vector<Transport> transports_;  // descendants first
  // Links, and rows of rigid motions that leave them unchanged.
  std::vector<std::pair<int, int>> unaffected_;
};

}  // namespace limber::dynamics
