// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/convex_solid.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber::contact {
namespace {

using Face = ConvexSolid::Face;

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

/// Gives the same number to points that nearly coincide.
class Merged {
 public:
  explicit Merged(double same) : same_(same) {}

  int find(const Vector3& x) {
    const auto from = by_x_.lower_bound(x.x() - same_);
    for (auto at = from; at != by_x_.end() && at->first <= x.x() + same_;
         ++at) {
      if ((points[index(at->second)] - x).norm() <= same_) return at->second;
    }
    points.push_back(x);
    by_x_.emplace(x.x(), static_cast<int>(points.size()) - 1);
    return static_cast<int>(points.size()) - 1;
  }

  std::vector<Vector3> points;

 private:
  double same_;
  std::multimap<double, int> by_x_;
};

void find_neighbours(std::vector<Face>& faces) {
  std::map<std::pair<int, int>, int> owners;
  const auto visit = [](const Face& face, const auto& use) {
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      use(face.corners[i], face.corners[(i + 1) % face.corners.size()]);
    }
  };
  for (std::size_t f = 0; f < faces.size(); ++f) {
    visit(faces[f], [&](int a, int b) {
      owners[{a, b}] = static_cast<int>(f);
    });
  }
  for (Face& face : faces) {
    visit(face, [&](int a, int b) {
      const auto other = owners.find({b, a});
      if (other != owners.end()) face.neighbours.push_back(other->second);
    });
  }
}

std::vector<int> list_loop(const Facet& facet, Merged& merged) {
  std::vector<int> loop;
  for (const Vector3& x : facet.corners) {
    const int corner = merged.find(x);
    if (loop.empty() || loop.back() != corner) loop.push_back(corner);
  }
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  return loop;
}

}  // namespace

bool is_solid(const ShapeKind& shape) {
  return std::holds_alternative<Box>(shape) ||
         std::holds_alternative<HalfSpace>(shape);
}

ConvexSolid::ConvexSolid(Data data) {
  if (!data.corners.empty()) {
    find_neighbours(data.faces);
    data.by_axis.resize(3, std::ssize(data.corners));
    Vector3 low = data.corners.front();
    Vector3 high = low;
    Eigen::Index i = 0;
    for (const Vector3& x : data.corners) {
      data.by_axis.col(i++) = x;
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    data.ball.centre = 0.5 * (low + high);
    for (const Vector3& x : data.corners) {
      data.ball.radius =
          std::max(data.ball.radius, (x - data.ball.centre).norm());
    }
  }
  data_ = std::make_shared<const Data>(std::move(data));
}

ConvexSolid::ConvexSolid(const ShapeKind& shape)
    : ConvexSolid([&shape] {
        LIMBER_EXPECT(is_solid(shape));
        Data data;
        const auto* box = std::get_if<Box>(&shape);
        if (box == nullptr) {
          data.faces.push_back({{Vector3::UnitZ(), 0.0}});
          return data;
        }
        for (int i = 0; i < 8; ++i) {
          const Vector3 signs((i & 1) != 0 ? 1.0 : -1.0,
                              (i & 2) != 0 ? 1.0 : -1.0,
                              (i & 4) != 0 ? 1.0 : -1.0);
          data.corners.emplace_back(box->half_size.cwiseProduct(signs));
        }
        for (int axis = 0; axis < 3; ++axis) {
          for (const bool is_far : {false, true}) {
            const Vector3 n = (is_far ? 1.0 : -1.0) * Vector3::Unit(axis);
            data.faces.push_back(
                {{n, box->half_size[axis]}, true, list_corners(axis, is_far)});
          }
        }
        return data;
      }()) {}

std::optional<ConvexSolid> ConvexSolid::make_bounded(
    std::span<const Face> faces, const Ball& within) {
  LIMBER_EXPECT(faces.size() <= kMostFaces);
  constexpr double kSame = 1e-9;  // of the size [-]
  const Vector3 reach = Vector3::Constant(1.1 * within.radius);
  Polytope region;
  make_box(Matrix3::Identity(), within.centre - reach, within.centre + reach,
           -1, region);
  std::array<Polytope, 2> scratch;
  Cutter cutter(region, scratch);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (!cutter.cut(faces[i].plane, static_cast<int>(i))) return {};
  }
  Merged merged(kSame * within.radius);
  Data data;
  for (const Facet& facet : cutter.part().facets()) {
    if (facet.tag < 0) return {};
    Face face = faces[index(facet.tag)];
    face.corners = list_loop(facet, merged);
    if (face.corners.size() >= 3) data.faces.push_back(std::move(face));
  }
  if (data.faces.size() < 4) return {};
  data.corners = std::move(merged.points);
  return ConvexSolid(std::move(data));
}

ConvexSolid ConvexSolid::make_slab(const Matrix3X& corners,
                                   const std::vector<std::size_t>& rim,
                                   double depth) {
  LIMBER_EXPECT(corners.cols() >= 3 && depth > 0.0);
  const auto count = static_cast<int>(corners.cols());
  Data slab;
  std::vector<int> top;
  std::vector<int> bottom;
  for (int i = 0; i < count; ++i) {
    const Vector3 corner = corners.col(i);
    slab.corners.push_back(corner);
    slab.corners.emplace_back(corner - depth * Vector3::UnitZ());
    top.push_back(2 * i);
    bottom.insert(bottom.begin(), 2 * i + 1);
  }
  slab.faces = {{{Vector3::UnitZ(), 0.0}, true, top},
                {{-Vector3::UnitZ(), depth}, false, bottom}};
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    const Vector3 corner = corners.col(i);
    const Vector3 n = (Vector3(corners.col(next)) - corner)
                          .cross(Vector3::UnitZ())
                          .normalized();
    const bool presses = std::find(rim.begin(), rim.end(),
                                   static_cast<std::size_t>(i)) != rim.end();
    slab.faces.push_back({{n, n.dot(corner)},
                          presses,
                          {2 * i, 2 * i + 1, 2 * next + 1, 2 * next}});
  }
  return ConvexSolid(std::move(slab));
}

double ConvexSolid::find_volume() const {
  double volume = 0.0;
  for (const Face& face : faces()) {
    const auto at = [&](std::size_t k) -> Vector3 {
      return corners()[index(face.corners[k])] - ball().centre;
    };
    for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
      volume += at(0).dot(at(k).cross(at(k + 1))) / 6.0;
    }
  }
  return volume;
}

double ConvexSolid::find_low(const Vector3& n) const {
  const auto& x = data_->by_axis;
  return (n.x() * x.row(0) + n.y() * x.row(1) + n.z() * x.row(2)).minCoeff();
}

double ConvexSolid::find_high(const Vector3& n) const { return -find_low(-n); }

}  // namespace limber::contact
