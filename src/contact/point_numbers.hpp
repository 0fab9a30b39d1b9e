// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "limber/contact/law/point_law.hpp"
#include "limber/contact/law/point_memory.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// The part of a pair's memory that belongs to one point.
template <typename Number>
[[nodiscard]] std::span<Number> numbers_of(std::size_t i,
                                           std::span<Number> memory) {
  return memory.subspan(i * kPointNumbers, kPointNumbers);
}

/// Adds everything but the energy.
inline void set_response(const PointResponse& response,
                         joints::PairPoint& point, joints::PairResponse& out) {
  point.force_W = response.force_W;
  point.stiffness = response.stiffness;
  point.damping = response.damping;
  out.dissipation += response.dissipation;
  out.rubbed += response.rubbed;
  out.slip_power += response.slip_power;
}

}  // namespace limber::contact
