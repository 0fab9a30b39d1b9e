// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/part_patches.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace limber::contact {

using joints::PairBodies;

PartPatches::PartPatches(std::vector<PatchPart> parts_A,
                         std::vector<PatchPart> parts_B, double modulus)
    : parts_A_(std::move(parts_A)),
      parts_B_(std::move(parts_B)),
      last_patches_(parts_A_.size() * parts_B_.size()) {
  for (const PatchPart& A : parts_A_) {
    for (const PatchPart& B : parts_B_) {
      potentials_.emplace_back(A.body(), B.body(), modulus, A.flexibility(),
                               B.flexibility());
    }
  }
}

bool PartPatches::is_point() const {
  return std::ranges::all_of(potentials_, &SeriesPotential::is_point);
}

void PartPatches::check(int modes_A, int modes_B) const {
  for (const PatchPart& part : parts_A_) part.check(modes_A);
  for (const PatchPart& part : parts_B_) part.check(modes_B);
}

PatchTouches PartPatches::find_patches(const PairBodies& bodies,
                                       bool has_derivatives) const {
  const PatchFrames frames(parts_A_, parts_B_, bodies);
  PatchTouches touches;
  frames.visit_near(0.0, [&](std::size_t i, std::size_t j, double /*gap*/) {
    const std::size_t k = i * parts_B_.size() + j;
    PatchTouch touch{k, frames.A[i], frames.B[j], {}};
    const PairBodies parts{touch.A, touch.B};
    touch.patch = last_patches_.find(k, parts, has_derivatives, [&] {
      return potentials_[k].evaluate(parts, has_derivatives);
    });
    if (touch.patch.touches) touches.add(touch);
  });
  return touches;
}

void PartPatches::set_places(const PairBodies& bodies, const PatchTouch& touch,
                             const Vector3& place_W,
                             joints::PairPoint& out) const {
  parts_A_[touch.index / parts_B_.size()].set_place(bodies.A, place_W,
                                                    out.on_A);
  parts_B_[touch.index % parts_B_.size()].set_place(bodies.B, place_W,
                                                    out.on_B);
}

SolidGap PartPatches::find_gap(std::size_t index,
                               const PatchFrames& frames) const {
  const std::size_t i = index / parts_B_.size();
  const std::size_t j = index % parts_B_.size();
  return contact::find_gap(parts_A_[i], parts_B_[j],
                           {frames.A[i], frames.B[j]});
}

PatchFinder::Nearest PartPatches::make_nearest(
    std::size_t index, const SolidGap& gap, const PatchFrames& frames) const {
  return {index, gap, frames.A[index / parts_B_.size()],
          frames.B[index % parts_B_.size()]};
}

PatchFinder::Nearest PartPatches::find_pair(const PairBodies& bodies,
                                            std::size_t index) const {
  const PatchFrames frames(parts_A_, parts_B_, bodies);
  return make_nearest(index, find_gap(index, frames), frames);
}

// Of the parts whose balls are nearest, then of all that may be nearer.
PatchFinder::Nearest PartPatches::find_nearest(const PairBodies& bodies) const {
  const PatchFrames frames(parts_A_, parts_B_, bodies);
  std::size_t first = 0;
  double least = std::numeric_limits<double>::infinity();
  frames.visit_near(least, [&](std::size_t i, std::size_t j, double distance) {
    if (distance > least) return;
    least = distance;
    first = i * parts_B_.size() + j;
  });
  std::size_t nearest = first;
  SolidGap gap = find_gap(first, frames);
  frames.visit_near(gap.distance,
                    [&](std::size_t i, std::size_t j, double distance) {
                      const std::size_t k = i * parts_B_.size() + j;
                      if (k == first || !(distance < gap.distance)) return;
                      const SolidGap other = find_gap(k, frames);
                      if (!(other.distance < gap.distance)) return;
                      nearest = k;
                      gap = other;
                    });
  return make_nearest(nearest, gap, frames);
}

}  // namespace limber::contact
