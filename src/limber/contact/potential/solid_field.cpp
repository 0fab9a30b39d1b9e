// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/solid_field.hpp"

#include <algorithm>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber::contact {
namespace {

constexpr double kNever = std::numeric_limits<double>::max();

/// The distance to a face along a line.
struct FaceAlong {
  int face = 0;
  double depth = 0.0;  // at v = 0
  double slope = 0.0;
};

class FacesAlong {
 public:
  FacesAlong(std::span<const Plane> planes, const StraightLine& line) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      all_.add() = {static_cast<int>(i), planes[i].find_depth(line.origin),
                    -planes[i].n.dot(line.way)};
    }
  }

  [[nodiscard]] std::span<const FaceAlong> all() const { return all_.all(); }
  [[nodiscard]] const FaceAlong& operator[](int face) const {
    return all()[index(face)];
  }

  // The nearest at v, of several the one that is nearest behind v.
  [[nodiscard]] FaceAlong find_nearest(double v) const {
    FaceAlong best{0, kNever, 0.0};
    for (const FaceAlong& face : all()) {
      const double ahead =
          (face.depth + face.slope * v) - (best.depth + best.slope * v);
      if (ahead < 0.0 || (ahead == 0.0 && face.slope < best.slope)) best = face;
    }
    return best;
  }

  // The first face of less slope that becomes the nearest one, and where.
  [[nodiscard]] LinePiece find_next(const FaceAlong& now) const {
    LinePiece next{-1, kNever};
    double slope = 0.0;
    for (const FaceAlong& face : all()) {
      if (!(face.slope < now.slope)) continue;
      const double v = (face.depth - now.depth) / (now.slope - face.slope);
      if (v < next.last || (v == next.last && face.slope < slope)) {
        next = {face.face, v};
        slope = face.slope;
      }
    }
    return next;
  }

 private:
  StackArray<FaceAlong, SolidField::kMostFaces> all_;
};

}  // namespace

SolidField::SolidField(const ConvexSolid& solid) : solid_(solid) {
  LIMBER_EXPECT(solid.faces().size() <= kMostFaces);
  for (const ConvexSolid::Face& face : solid.faces()) {
    planes_.push_back(face.plane);
  }
}

double SolidField::find_t(const Vector3& x) const {
  double least = kNever;
  for (const Plane& plane : planes_) {
    least = std::min(least, plane.find_depth(x));
  }
  return least;
}

Depth SolidField::find_depth(const Vector3& x, int face) const {
  const Plane& plane = planes_[index(face)];
  const double t = plane.find_depth(x);
  return {t, -plane.n, -(t * t * t * t) * plane.n};
}

double SolidField::find_deepest(const StraightLine& line) const {
  const FacesAlong faces(planes_, line);
  FaceAlong now = faces.find_nearest(line.span.first);
  double v = line.span.first;
  while (now.slope > 0.0) {
    const LinePiece next = faces.find_next(now);
    v = std::max(v, next.last);
    if (v >= line.span.last) return line.span.last;
    now = faces[next.face];
  }
  return v;
}

Span SolidField::cut(const StraightLine& line) const {
  Span part = line.span;
  for (const Plane& plane : planes_) {
    const double depth = plane.find_depth(line.origin);
    const double slope = -plane.n.dot(line.way);
    if (slope > 0.0) {
      part.first = std::max(part.first, -depth / slope);
    } else if (slope < 0.0) {
      part.last = std::min(part.last, -depth / slope);
    } else if (!(depth > 0.0)) {
      return {};
    }
  }
  return part;
}

void SolidField::divide(const StraightLine& line, const Span& part,
                        LinePieces& out) const {
  const FacesAlong faces(planes_, line);
  FaceAlong now = faces.find_nearest(part.first);
  while (true) {
    const LinePiece next = faces.find_next(now);
    if (next.face < 0 || next.last >= part.last) break;
    if (next.last > part.first) out.add() = {now.face, next.last};
    now = faces[next.face];
  }
  out.add() = {now.face, part.last};
}

}  // namespace limber::contact
