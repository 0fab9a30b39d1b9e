// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/polytope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/stack_array.hpp"

namespace limber::contact {
namespace {

constexpr std::size_t kMostOfRim = 1024;
using Rim = StackArray<Vector3, kMostOfRim>;

void check_room(std::size_t count, std::size_t most) {
  if (count < most) return;
  throw NumericalError("contact: too many mesh faces in one contact region");
}

// Of depths below a plane.
double find_round_off(const Plane& plane, std::span<const Vector3> corners) {
  double largest = 0.0;
  for (const Vector3& x : corners) largest = std::max(largest, x.squaredNorm());
  return 4.0 * std::numeric_limits<double>::epsilon() *
         (std::sqrt(largest * plane.n.squaredNorm()) + std::abs(plane.h));
}

// From the inside, so that both facets of an edge get the same bits and agree
// on which corners are inside of the next plane.
Vector3 cross(const Vector3& inside, double depth, const Vector3& outside,
              double other_depth) {
  return inside + (outside - inside) * (depth / (depth - other_depth));
}

// The part of a facet inside, whose corner where it leaves goes to `rim`.
void cut(const Facet& facet, std::span<const double> depths, Polytope& out,
         Rim& rim) {
  const std::span<const Vector3> corners = facet.corners;
  const auto is_inside = [](double depth) { return depth >= 0.0; };
  if (std::ranges::all_of(depths, is_inside)) return out.add_facet(facet);
  if (std::ranges::none_of(depths, is_inside)) return;
  out.begin_facet(facet.tag);
  std::size_t last = corners.size() - 1;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double depth = depths[i];
    const double last_depth = depths[last];
    if ((depth >= 0.0) != (last_depth >= 0.0)) {
      const Vector3 crossing =
          depth < 0.0 ? cross(corners[last], last_depth, corners[i], depth)
                      : cross(corners[i], depth, corners[last], last_depth);
      out.add_corner(crossing);
      if (depth < 0.0) {
        check_room(rim.all().size(), kMostOfRim);
        rim.add() = crossing;
      }
    }
    if (depth >= 0.0) out.add_corner(corners[i]);
    last = i;
  }
}

// Grows with the angle of (x, y), from -2 to 2 in one turn.
double find_turn(double x, double y) {
  const double sum = std::abs(x) + std::abs(y);
  if (!(sum > 0.0)) return 0.0;
  if (x >= 0.0) return y / sum;
  return std::copysign(2.0, y) - y / sum;
}

// Adds the same corners in the order of their angles about their middle.
void close(const Rim& rim, const Plane& plane, int tag, Polytope& out) {
  const std::span<const Vector3> corners = rim.all();
  Vector3 middle = Vector3::Zero();
  for (const Vector3& x : corners) middle += x;
  middle /= static_cast<double>(corners.size());
  const Vector3 u = plane.n.unitOrthogonal();
  const Vector3 v = plane.n.normalized().cross(u);
  StackArray<std::pair<double, const Vector3*>, kMostOfRim> sorted;
  for (const Vector3& x : corners) {
    const Vector3 r = x - middle;
    sorted.add() = {find_turn(u.dot(r), v.dot(r)), &x};
  }
  std::ranges::sort(sorted.all(), {}, [](const auto& at) { return at.first; });
  out.begin_facet(tag);
  for (const auto& at : sorted.all()) out.add_corner(*at.second);
}

}  // namespace

Polytope& Polytope::operator=(const Polytope& other) {
  facet_count_ = other.facet_count_;
  corner_count_ = other.corner_count_;
  std::copy_n(other.ranges_.begin(), facet_count_, ranges_.begin());
  std::copy_n(other.corners_.begin(), corner_count_, corners_.begin());
  return *this;
}

void Polytope::begin_facet(int tag) {
  end_facets();
  check_room(facet_count_, kMostFacets);
  ranges_[facet_count_++] = {tag, corner_count_, 0};
}

void Polytope::add_facet(const Facet& facet) {
  begin_facet(facet.tag);
  const std::size_t count = facet.corners.size();
  check_room(corner_count_ + count, kMostCorners + 1);
  std::copy_n(facet.corners.begin(), count, &corners_[corner_count_]);
  corner_count_ += count;
  ranges_[facet_count_ - 1].count = count;
}

void Polytope::add_corner(const Vector3& corner) {
  check_room(corner_count_, kMostCorners);
  corners_[corner_count_++] = corner;
  ++ranges_[facet_count_ - 1].count;
}

void Polytope::end_facets() {
  if (facet_count_ == 0 || ranges_[facet_count_ - 1].count >= 3) return;
  corner_count_ = ranges_[--facet_count_].first;
}

void Polytope::move(const Vector3& by) {
  for (std::size_t i = 0; i < corner_count_; ++i) corners_[i] += by;
}

const Polytope& clip(const Polytope& in, const Plane& plane, int tag,
                     Polytope& scratch) {
  std::array<double, Polytope::kMostCorners> depths;
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  const std::span<const Vector3> corners = in.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    depths[i] = plane.find_depth(corners[i]);
    least = std::min(least, depths[i]);
    most = std::max(most, depths[i]);
  }
  if (least >= 0.0 || least >= -find_round_off(plane, corners)) return in;
  scratch.clear();
  if (!(most > 0.0)) return scratch;
  Rim rim;
  std::size_t first = 0;
  for (const Facet& facet : in.facets()) {
    const std::size_t count = facet.corners.size();
    cut(facet, std::span(depths).subspan(first, count), scratch, rim);
    first += count;
  }
  if (rim.all().size() >= 3) close(rim, plane, tag, scratch);
  scratch.end_facets();
  return scratch;
}

bool Cutter::cut(const Plane& plane, int tag) {
  const std::size_t next = part_ == scratch_.data() ? 1 : 0;
  part_ = &clip(*part_, plane, tag, scratch_[next]);
  return part_->facet_count() >= 4;
}

void make_box(const Matrix3& axes, const Vector3& low, const Vector3& high,
              int tag, Polytope& out) {
  out.clear();
  const auto add = [&](int axis, bool is_far, bool next_far, bool last_far) {
    Vector3 at;
    at[axis] = (is_far ? high : low)[axis];
    at[(axis + 1) % 3] = (next_far ? high : low)[(axis + 1) % 3];
    at[(axis + 2) % 3] = (last_far ? high : low)[(axis + 2) % 3];
    out.add_corner(axes * at);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool is_far : {false, true}) {
      out.begin_facet(tag);
      add(axis, is_far, false, false);
      add(axis, is_far, is_far, !is_far);
      add(axis, is_far, true, true);
      add(axis, is_far, !is_far, is_far);
    }
  }
}

}  // namespace limber::contact
