// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/bodies/modal_forces.hpp"

#include "limber/dynamics/system/body_model.hpp"
#include "limber/flexbody/model/mode_products.hpp"

namespace limber::dynamics {

void add_modal_force(const BodyModel& body, const joints::PairPlace& place,
                     const Vector3& force_B, BodyTerms& terms,
                     ProductTerms& products) {
  for (int k = 0; k < body.modes; ++k) {
    terms.modal_force[k] += place.Phi_B.col(k).dot(force_B);
  }
  for (Eigen::Index pair = 0; pair < products.force.size(); ++pair) {
    products.force[pair] += place.Phi_B.col(body.modes + pair).dot(force_B);
  }
}

void add_modal_residual(const BodyModel& body, const joints::PairPlace& place,
                        const double* eta, const Vector3& force_B,
                        double* residual) {
  for (int k = 0; k < body.modes; ++k) {
    residual[k] -= place.Phi_B.col(k).dot(force_B);
  }
  flexbody::for_each_product(
      paired_of(body), [&](Eigen::Index pair, int i, int j, bool is_square) {
        const double f = place.Phi_B.col(body.modes + pair).dot(force_B);
        residual[i] -= f * eta[j];
        if (!is_square) residual[j] -= f * eta[i];
      });
}

void add_product_forces(const BodyModel& body, const SystemState& state,
                        const ProductTerms& products, BodyTerms& terms) {
  if (products.force.size() == 0) return;
  flexbody::add_product_forces(paired_of(body), products.force.data(),
                               state.eta.data() + body.offset,
                               terms.modal_force.data());
}

void add_geometric_stiffness(const SystemModel& model, std::size_t body,
                             const SystemTerms& terms,
                             Eigen::Ref<MatrixX> stiffness) {
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    const Attachment& attachment = model.attachments[i];
    if (!attachment.second || attachment.body != static_cast<int>(body)) {
      continue;
    }
    const Vector6& wrench = terms.attachments[i].wrench_B;
    flexbody::add_contraction(*attachment.second, wrench.head<3>(),
                              wrench.tail<3>(), -1.0, stiffness);
  }
  if (terms.products[body].force.size() == 0) return;
  flexbody::add_product_stiffness(paired_of(model.bodies[body]),
                                  terms.products[body].force.data(), -1.0,
                                  stiffness);
}

}  // namespace limber::dynamics
