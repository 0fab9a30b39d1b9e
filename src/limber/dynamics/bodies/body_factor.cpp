// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/bodies/body_factor.hpp"

#include "limber/dynamics/bodies/body.hpp"

namespace limber::dynamics {
namespace {

std::variant<ModalFactor, NodalFactor> make_factor(const SystemModel& model,
                                                   std::size_t body) {
  if (has_dense_block(model, body)) return ModalFactor(model.bodies[body]);
  return NodalFactor();
}

}  // namespace

BodyFactor::BodyFactor(const SystemModel& model, std::size_t body)
    : b_(body), factor_(make_factor(model, body)) {}

}  // namespace limber::dynamics
