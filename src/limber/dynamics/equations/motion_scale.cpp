// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/motion_scale.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/equations/displacement_measure.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

void include(double squared, std::size_t body, MotionScale::Largest& largest) {
  // Written so that NaN counts as the largest.
  if (!(squared <= largest.displacement)) largest = {squared, body};
}

MotionScale::Largest take_root(MotionScale::Largest largest) {
  largest.displacement = std::sqrt(largest.displacement);
  return largest;
}

}  // namespace

double find_reach(const SystemModel& model, BodyIndex b) {
  const BodyModel& body = model.bodies[static_cast<std::size_t>(b)];
  double reach = radius_of_gyration(body);
  if (body.reduced && body.reduced->rows.x_B.cols() > 0) {
    reach = std::max(reach, body.reduced->rows.x_B.colwise().norm().maxCoeff());
  }
  for (const Attachment& attachment : model.attachments) {
    if (attachment.body == b) reach = std::max(reach, attachment.p_BF.norm());
  }
  return reach;
}

MotionScale::MotionScale(const SystemModel& model)
    : first_node_(first_node_row(model)) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    Body scale;
    scale.moves = body.has_rigid_motion();
    scale.offset = body.offset;
    scale.row = body.row;
    scale.reach = find_reach(model, static_cast<BodyIndex>(b));
    if (body.modes > 0) {
      scale.sizes = DisplacementMeasure(body).mode_sizes();
      scale.lambda = body.reduced->lambda.head(body.modes);
    }
    bodies_.push_back(std::move(scale));
    for (const UnknownRange& range : list_unknowns(model, b)) {
      if (range.kind != UnknownKind::nodes) continue;
      nodes_.push_back({b, range.row - first_node_, range.size});
    }
  }
}

MotionScale::Largest MotionScale::measure_change(const VectorX& a,
                                                 const VectorX& b,
                                                 double factor,
                                                 double filter) const {
  Largest largest;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    double squared = 0.0;
    if (body.moves) {
      const Vector6 change = b.segment<6>(body.row) - a.segment<6>(body.row);
      squared += change.head<3>().squaredNorm() +
                 body.reach * body.reach * change.tail<3>().squaredNorm();
    }
    for (Eigen::Index k = 0; k < body.sizes.size(); ++k) {
      const Eigen::Index at = body.row + 6 + k;
      const double moved =
          body.sizes[k] * (b[at] - a[at]) / (1.0 + filter * body.lambda[k]);
      squared += moved * moved;
    }
    include(factor * factor * squared, i, largest);
  }
  for (const Nodes& nodes : nodes_) {
    const Eigen::Index row = first_node_ + nodes.first;
    for (Eigen::Index i = row; i < row + nodes.dofs; i += 3) {
      include(
          factor * factor * (b.segment<3>(i) - a.segment<3>(i)).squaredNorm(),
          nodes.body, largest);
    }
  }
  return take_root(largest);
}

MotionScale::Largest MotionScale::measure_distance(const SystemState& a,
                                                   const SystemState& b) const {
  Largest largest;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    double squared = 0.0;
    if (body.moves) {
      const Quaternion rotation =
          a.bodies[i].quat_WB.conjugate() * b.bodies[i].quat_WB;
      const double angle =
          2.0 * std::atan2(rotation.vec().norm(), std::abs(rotation.w()));
      squared += (b.bodies[i].p_WB - a.bodies[i].p_WB).squaredNorm() +
                 body.reach * body.reach * angle * angle;
    }
    for (Eigen::Index k = 0; k < body.sizes.size(); ++k) {
      const Eigen::Index at = body.offset + k;
      const double moved = body.sizes[k] * (b.eta[at] - a.eta[at]);
      squared += moved * moved;
    }
    include(squared, i, largest);
  }
  for (const Nodes& nodes : nodes_) {
    for (Eigen::Index i = nodes.first; i < nodes.first + nodes.dofs; i += 3) {
      include((b.u_H.segment<3>(i) - a.u_H.segment<3>(i)).squaredNorm(),
              nodes.body, largest);
    }
  }
  return take_root(largest);
}

}  // namespace limber::dynamics
