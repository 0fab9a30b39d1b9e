// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/feature_slots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/contact/point_numbers.hpp"

namespace limber::contact {
namespace {

constexpr std::size_t kMost = 16;

// A place on both bodies, in their frames.
struct Mark {
  bool is_set = false;
  Vector3 on_A = Vector3::Zero();
  Vector3 on_B = Vector3::Zero();
};

using Marks = std::array<Mark, kMost>;

Mark mark(const Meeting& meeting) {
  return {std::isfinite(meeting.depth), meeting.on_A.x_B, meeting.on_B.x_B};
}

void take(const Marks& slots, double reach, std::span<Meeting> meetings) {
  const std::size_t count = meetings.size();
  std::array<Meeting, kMost> all;
  Marks places;
  std::array<bool, kMost> is_placed{};
  std::array<bool, kMost> is_taken{};
  for (std::size_t i = 0; i < count; ++i) {
    all[i] = meetings[i];
    places[i] = mark(all[i]);
    // A depth that is not finite has no place and keeps its index.
    if (!std::isfinite(all[i].depth) && !std::isnan(all[i].depth)) {
      is_placed[i] = true;
    }
    meetings[i] = {};
  }
  const auto put = [&](std::size_t feature, std::size_t slot) {
    meetings[slot] = all[feature];
    is_placed[feature] = true;
    is_taken[slot] = true;
  };
  while (true) {
    double least = reach;
    std::size_t feature = count;
    std::size_t slot = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (is_placed[i]) continue;
      for (std::size_t j = 0; j < count; ++j) {
        if (is_taken[j] || !slots[j].is_set) continue;
        const double far = std::max((places[i].on_A - slots[j].on_A).norm(),
                                    (places[i].on_B - slots[j].on_B).norm());
        if (!(far < least)) continue;
        least = far;
        feature = i;
        slot = j;
      }
    }
    if (feature == count) break;
    put(feature, slot);
  }
  for (const bool may_be_set : {false, true}) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count && !is_placed[i]; ++j) {
        if (!is_taken[j] && slots[j].is_set == may_be_set) put(i, j);
      }
    }
  }
}

}  // namespace

void take_slots(std::span<const double> memory, double reach,
                std::span<Meeting> meetings) {
  LIMBER_EXPECT(meetings.size() <= kMost);
  LIMBER_EXPECT(memory.size() == kPointNumbers * meetings.size());
  Marks slots;
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    const PointMemory point = load_memory(numbers_of(i, memory));
    slots[i] = {point.is_touching(), point.on_A.x_B, point.on_B.x_B};
  }
  take(slots, reach, meetings);
}

void take_slots(std::span<const Meeting> others, double reach,
                std::span<Meeting> meetings) {
  LIMBER_EXPECT(meetings.size() <= kMost);
  LIMBER_EXPECT(others.size() == meetings.size());
  Marks slots;
  for (std::size_t i = 0; i < meetings.size(); ++i) slots[i] = mark(others[i]);
  take(slots, reach, meetings);
}

}  // namespace limber::contact
