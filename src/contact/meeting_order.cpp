// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/meeting_order.hpp"

#include <algorithm>
#include <utility>

#include "limber/contact/point_numbers.hpp"

namespace limber::contact {

bool is_at(const Meeting& meeting, const PointMemory& memory) {
  const auto is_same = [](const SurfacePlace& place,
                          const PlaceMemory& former) {
    return place.face == static_cast<int>(former.face) && place.u == former.u &&
           place.v == former.v;
  };
  return meeting.depth > 0.0 && is_same(meeting.on_A, memory.on_A) &&
         is_same(meeting.on_B, memory.on_B);
}

void follow_memory(std::span<const double> memory, std::span<Meeting> out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const PointMemory former = load_memory(numbers_of(i, memory));
    if (!former.is_touching() || is_at(out[i], former)) continue;
    const auto found = std::find_if(
        out.begin(), out.end(),
        [&former](const Meeting& meeting) { return is_at(meeting, former); });
    if (found != out.end()) std::swap(out[i], *found);
  }
}

void follow(std::span<const Meeting> leader, std::span<Meeting> out) {
  const auto is_same = [](const SurfacePlace& a, const SurfacePlace& b) {
    return a.face == b.face && a.u == b.u && a.v == b.v;
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto found =
        std::find_if(out.begin() + static_cast<std::ptrdiff_t>(i), out.end(),
                     [&](const Meeting& meeting) {
                       return is_same(meeting.on_A, leader[i].on_A) &&
                              is_same(meeting.on_B, leader[i].on_B);
                     });
    if (found != out.end()) {
      std::swap(out[i], *found);
    } else {
      out[i].depth = Meeting{}.depth;
    }
  }
}

}  // namespace limber::contact
