// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/convex_solid.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

// A face of a box: normal along `axis` at one side of it.
std::vector<int> list_corners(int axis, bool is_far) {
  const int next = (axis + 1) % 3;
  const int last = (axis + 2) % 3;
  const int own = is_far ? 1 << axis : 0;
  std::vector<int> loop{own, own | 1 << next, own | 1 << next | 1 << last,
                        own | 1 << last};
  if (!is_far) std::swap(loop[1], loop[3]);
  return loop;
}

}  // namespace

bool is_solid(const ShapeKind& shape) {
  return std::holds_alternative<Box>(shape) ||
         std::holds_alternative<HalfSpace>(shape);
}

ConvexSolid::ConvexSolid(const ShapeKind& shape) {
  LIMBER_EXPECT(is_solid(shape));
  const auto* box = std::get_if<Box>(&shape);
  if (box == nullptr) {
    faces_.push_back({{Vector3::UnitZ(), 0.0}, {}});
    return;
  }
  for (int i = 0; i < 8; ++i) {
    const Vector3 signs((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0,
                        (i & 4) != 0 ? 1.0 : -1.0);
    corners_.emplace_back(box->half_size.cwiseProduct(signs));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool is_far : {false, true}) {
      const Vector3 n = (is_far ? 1.0 : -1.0) * Vector3::Unit(axis);
      faces_.push_back({{n, box->half_size[axis]}, {}});
      loops_.push_back(list_corners(axis, is_far));
    }
  }
  // Also to the opposite face, where the box is flat.
  add_bisectors();
}

void ConvexSolid::add_bisectors() {
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    for (std::size_t j = 0; j < faces_.size(); ++j) {
      if (j == i || !faces_[i].presses || !faces_[j].presses) continue;
      const Plane& own = faces_[i].plane;
      const Plane& other = faces_[j].plane;
      faces_[i].nearest.push_back(
          {static_cast<int>(j), {other.n - own.n, other.h - own.h}});
    }
  }
}

ConvexSolid ConvexSolid::make_slab(const Matrix3X& corners,
                                   const std::vector<std::size_t>& rim,
                                   double depth) {
  LIMBER_EXPECT(corners.cols() >= 3 && depth > 0.0);
  const auto count = static_cast<int>(corners.cols());
  ConvexSolid slab;
  std::vector<int> top;
  std::vector<int> bottom;
  for (int i = 0; i < count; ++i) {
    const Vector3 corner = corners.col(i);
    slab.corners_.push_back(corner);
    slab.corners_.emplace_back(corner - depth * Vector3::UnitZ());
    top.push_back(2 * i);
    bottom.insert(bottom.begin(), 2 * i + 1);
  }
  slab.faces_ = {{{Vector3::UnitZ(), 0.0}, {}, true},
                 {{-Vector3::UnitZ(), depth}, {}, false}};
  slab.loops_ = {top, bottom};
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    const Vector3 corner = corners.col(i);
    const Vector3 n = (Vector3(corners.col(next)) - corner)
                          .cross(Vector3::UnitZ())
                          .normalized();
    const bool presses = std::find(rim.begin(), rim.end(),
                                   static_cast<std::size_t>(i)) != rim.end();
    slab.faces_.push_back({{n, n.dot(corner)}, {}, presses});
    slab.loops_.push_back({2 * i, 2 * i + 1, 2 * next + 1, 2 * next});
  }
  slab.add_bisectors();
  return slab;
}

Polytope ConvexSolid::place(const Pose& X_WS, int side) const {
  LIMBER_EXPECT(is_bounded());
  Polytope placed;
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    Facet facet(tag_of(static_cast<int>(i), side));
    for (const int corner : loops_[i]) {
      facet.add(X_WS * corners_[static_cast<std::size_t>(corner)]);
    }
    placed.add(facet);
  }
  return placed;
}

}  // namespace limber::contact
