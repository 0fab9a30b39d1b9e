// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/shape_pair.hpp"

#include <algorithm>

#include "limber/common/errors.hpp"

namespace limber::contact {

ShapePair::ShapePair(const Shape& A, const Shape& B) : A_(A), B_(B) {
  check_shape(A_);
  check_shape(B_);
}

std::size_t ShapePair::most_points() const { return 1; }

void ShapePair::find(const joints::PairBodies& /*bodies*/, double /*reach*/,
                     std::span<Meeting> out) const {
  LIMBER_EXPECT(out.size() == most_points());
  std::fill(out.begin(), out.end(), Meeting{});
}

double ShapePair::find_clearance(const joints::PairBodies& /*bodies*/) const {
  return 0.0;
}

}  // namespace limber::contact
