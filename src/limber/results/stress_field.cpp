// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/stress_field.hpp"

#include <algorithm>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"
#include "limber/flexbody/model/stress_modes.hpp"
#include "limber/results/xdmf_file.hpp"

namespace limber::results {
std::unique_ptr<FullStressField> FullStressField::make(
    const dynamics::SystemModel& model, dynamics::BodyIndex body,
    const std::vector<int>& nodes) {
  const int full = model.bodies[index(body)].full;
  if (full < 0) return nullptr;
  auto stress =
      flexbody::make_full_stress(*model.full_bodies[index(full)].mesh, nodes);
  if (stress == nullptr) return nullptr;
  return std::unique_ptr<FullStressField>(
      new FullStressField(model, body, std::move(stress)));
}

FullStressField::FullStressField(
    const dynamics::SystemModel& model, dynamics::BodyIndex body,
    std::shared_ptr<const flexbody::FullStress> stress)
    : model_(model),
      full_(index(model.bodies[index(body)].full)),
      stress_(std::move(stress)) {
  const std::vector<int>& nodes = stress_->nodes();
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    if (p > 0 && nodes[p] == nodes[p - 1]) continue;
    first_points_.push_back(static_cast<Eigen::Index>(p));
  }
}

Matrix6X FullStressField::calc_at_home(
    const dynamics::SystemState& state) const {
  Matrix6X at_points(6, std::ssize(stress_->nodes()));
  stress_->calc_stress(dynamics::nodes_of(model_.full_bodies[full_], state.u_H),
                       at_points);
  return at_points(Eigen::all, first_points_);
}

Matrix6X FullStressField::calc_in_world(
    const dynamics::SystemState& state) const {
  return rotate_to_world(calc_at_home(state), state.X_WH[full_].R);
}

Matrix6X FullStressField::calc_in_body(
    const dynamics::SystemState& state) const {
  dynamics::MeanFrame frame;
  dynamics::calc_mean_frame(model_, model_.full_bodies[full_], state, frame);
  return rotate_to_world(calc_at_home(state), frame.R_HB.transpose());
}

bool has_modal_stress(const dynamics::BodyModel& body) {
  return body.full < 0 && body.reduced && body.reduced->stress &&
         body.modes > 0 &&
         body.reduced->stress->Sigma_B.cols() >= count_coordinates(body);
}

double find_largest_von_mises(const VectorX& stress) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < stress.size(); i += 6) {
    largest = std::max(largest,
                       flexbody::calc_von_mises(Vector6(stress.segment<6>(i))));
  }
  return largest;
}

}  // namespace limber::results
