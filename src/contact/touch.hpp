// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "limber/common/stack_array.hpp"
#include "limber/contact/law/effective_mass.hpp"
#include "limber/contact/law/pad_law.hpp"
#include "limber/contact/law/point_law.hpp"
#include "limber/contact/meetings.hpp"

namespace limber::contact {

/// A feature that touches.
struct TouchingPoint {
  std::size_t feature = 0;  ///< index
  std::size_t point = 0;    ///< index in the response
  PointMotion motion;
  ElasticPoint elastic;  ///< of a pad without energy, which is all pads'
  PointMemory before;    ///< or that with which it begins
};

/// All features that touch, at one instant or over a step.
struct Touch {
  explicit Touch(std::span<const double> memory_) : memory(memory_) {}

  PadLaw::Response pads;
  StackArray<TouchingPoint, Meetings::kMost> points;
  NormalLoad load;
  std::span<const double> memory;  // of the pair
  TouchMotion motion;              ///< but for the mass

  /// Adds a point that is complete to the sums.
  void sum(const joints::PairBodies& bodies, const Vector3& p_W,
           const TouchingPoint& point) {
    const ElasticPoint& elastic = point.elastic;
    motion.add(elastic.force, point.motion.rate(), elastic.energy);
    load.add(bodies, p_W, elastic.force.force * point.motion.normal_W);
  }
};

}  // namespace limber::contact
