// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "limber/common/errors.hpp"
#include "limber/dynamics/bodies/body_kind.hpp"
#include "limber/dynamics/bodies/modal_body.hpp"
#include "limber/dynamics/bodies/nodal_body.hpp"

/// Dispatch over the kinds of bodies: other code queries a body here and
/// nowhere which kind it is. A new kind is added to visit_body() and
/// BodyFactor.
namespace limber::dynamics {

static_assert(BodyKind<ModalBody>);
static_assert(BodyKind<NodalBody>);

/// Calls `visit` with the view of a model's body.
template <typename Visit>
decltype(auto) visit_body(const SystemModel& model, std::size_t body,
                          Visit&& visit) {
  if (model.bodies[body].full >= 0) {
    return std::forward<Visit>(visit)(NodalBody(model, body));
  }
  return std::forward<Visit>(visit)(ModalBody(model, body));
}

/// Calls `visit` with the views of all bodies, in their order.
template <typename Visit>
void visit_bodies(const SystemModel& model, const Visit& visit) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    visit_body(model, b, visit);
  }
}

/// Those of a body's unknowns that move.
[[nodiscard]] inline UnknownRanges list_unknowns(const SystemModel& model,
                                                 std::size_t body) {
  return visit_body(model, body,
                    [](const auto& own) { return own.list_unknowns(); });
}

/// Whether a body has a block in the dense part of Newton's matrix.
[[nodiscard]] inline bool has_dense_block(const SystemModel& model,
                                          std::size_t body) {
  return visit_body(model, body,
                    [](const auto& own) { return own.has_dense_block(); });
}

}  // namespace limber::dynamics
