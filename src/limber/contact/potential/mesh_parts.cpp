// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/mesh_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "limber/common/index.hpp"

namespace limber::contact {
namespace {

constexpr double kFlat = 1e-6;      // of the size [-]
constexpr double kParallel = 1e-3;  // of the cosine [-]
constexpr std::size_t kMostCutPlanes = 600;
constexpr double kVolume = 1e-4;

/// A convex piece of the surface, in one of its planes.
struct Fragment {
  int plane = -1;
  std::vector<Vector3> corners;

  // Twice the area, along the normal.
  [[nodiscard]] Vector3 find_area() const {
    Vector3 area = Vector3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      area += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
    }
    return area;
  }
};

/// The surface within planes that cut it.
struct CutSurface {
  std::vector<Fragment> fragments;
  std::vector<Plane> cuts;
};

struct HeightRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

// Of the corners' heights above a plane.
HeightRange find_range(const Fragment& fragment, const Plane& plane) {
  HeightRange range;
  for (const Vector3& x : fragment.corners) {
    range.low = std::min(range.low, -plane.find_depth(x));
    range.high = std::max(range.high, -plane.find_depth(x));
  }
  return range;
}

class Splitter {
 public:
  Splitter(const Matrix3X& x_B, const std::vector<std::array<int, 6>>& faces) {
    const Vector3 extent = x_B.rowwise().maxCoeff() - x_B.rowwise().minCoeff();
    same_ = kFlat * extent.maxCoeff();
    bounds_ = {0.5 * (x_B.rowwise().maxCoeff() + x_B.rowwise().minCoeff()),
               0.5 * extent.norm()};
    const Vector3 from = x_B.col(0);
    for (const auto& face : faces) {
      Fragment& triangle = whole_.fragments.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.corners.emplace_back(x_B.col(face[k]));
      }
      volume_ += triangle.find_area().dot(triangle.corners[0] - from) / 6.0;
    }
  }

  std::vector<ConvexSolid> run() {
    if (!find_planes()) return {};
    part_counts_.assign(planes_.size(), 0);
    std::vector<CutSurface> open{std::move(whole_)};
    std::vector<ConvexSolid> parts;
    double volume = 0.0;
    while (!open.empty()) {
      const CutSurface cell = std::move(open.back());
      open.pop_back();
      const std::vector<int> violated = find_violated(cell);
      if (violated.empty()) {
        const auto part = make_part(cell);
        if (!part) continue;
        for (const int i : list_planes(cell)) {
          if (++part_counts_[index(i)] > kMostSideBySide) return {};
        }
        volume += part->find_volume();
        parts.push_back(*part);
      } else if (planes_.size() > kMostCutPlanes) {
        return {};
      } else {
        split(cell, planes_[index(choose_cut(cell, violated))], open);
      }
      if (parts.size() + open.size() > kMostSolids) return {};
    }
    if (!(std::abs(volume - volume_) <= kVolume * volume_)) return {};
    return parts;
  }

 private:
  // Gives each triangle its plane, of the largest triangles first.
  // @return whether there are few enough
  bool find_planes() {
    std::vector<Fragment>& all = whole_.fragments;
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<double> areas;
    for (const Fragment& triangle : all) {
      areas.push_back(triangle.find_area().norm());
    }
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      return areas[a] > areas[b];
    });
    for (const std::size_t seed : order) {
      if (all[seed].plane >= 0) continue;
      if (planes_.size() >= ConvexSolid::kMostFaces) return false;
      planes_.push_back(gather(all[seed]));
    }
    return true;
  }

  Plane gather(const Fragment& seed) {
    const Vector3 n = seed.find_area().normalized();
    const Plane first{n, n.dot(seed.corners[0])};
    Vector3 area = Vector3::Zero();
    std::vector<Fragment*> members;
    for (Fragment& triangle : whole_.fragments) {
      if (triangle.plane >= 0) continue;
      const HeightRange range = find_range(triangle, first);
      if (range.high > same_ || range.low < -same_) continue;
      const Vector3 own = triangle.find_area();
      if (own.dot(n) < (1.0 - kParallel) * own.norm()) continue;
      triangle.plane = static_cast<int>(planes_.size());
      area += own;
      members.push_back(&triangle);
    }
    Plane plane{area.normalized(), 0.0};
    for (const Fragment* triangle : members) {
      for (const Vector3& x : triangle->corners) {
        plane.h += plane.n.dot(x) / 3.0 / static_cast<double>(members.size());
      }
    }
    return plane;
  }

  static std::vector<int> list_planes(const CutSurface& cell) {
    std::vector<int> used;
    for (const Fragment& fragment : cell.fragments) {
      used.push_back(fragment.plane);
    }
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
  }

  // Planes above which the cell continues.
  [[nodiscard]] std::vector<int> find_violated(const CutSurface& cell) const {
    std::vector<int> violated;
    for (const int i : list_planes(cell)) {
      const bool goes_on =
          std::ranges::any_of(cell.fragments, [&](const Fragment& fragment) {
            return find_range(fragment, planes_[index(i)]).high > same_;
          });
      if (goes_on) violated.push_back(i);
    }
    return violated;
  }

  // The parts of a fragment below and above a plane, which share the line in
  // which it crosses them.
  struct Halves {
    Fragment below;
    Fragment above;
    double length = 0.0;  // of that line [m]
  };
  [[nodiscard]] Halves halve(const Fragment& fragment,
                             const Plane& plane) const {
    Halves halves{{fragment.plane, {}}, {fragment.plane, {}}};
    std::vector<Vector3> line;
    const std::vector<Vector3>& corners = fragment.corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vector3& x = corners[k];
      const Vector3& next = corners[(k + 1) % corners.size()];
      const double depth = plane.find_depth(x);
      const double next_depth = plane.find_depth(next);
      const bool is_on = std::abs(depth) <= same_;
      if (is_on) line.push_back(x);
      if (is_on || depth > 0.0) halves.below.corners.push_back(x);
      if (is_on || depth < 0.0) halves.above.corners.push_back(x);
      if (is_on || std::abs(next_depth) <= same_ ||
          (depth > 0.0) == (next_depth > 0.0)) {
        continue;
      }
      line.emplace_back(x + (next - x) * (depth / (depth - next_depth)));
      halves.below.corners.push_back(line.back());
      halves.above.corners.push_back(line.back());
    }
    if (line.size() >= 2) halves.length = (line.back() - line.front()).norm();
    return halves;
  }

  [[nodiscard]] bool crosses(const HeightRange& range) const {
    return range.high > same_ && range.low < -same_;
  }

  // The violated plane that crosses the surface in the shortest line.
  [[nodiscard]] int choose_cut(const CutSurface& cell,
                               const std::vector<int>& violated) const {
    int best = violated.front();
    double shortest = std::numeric_limits<double>::infinity();
    for (const int i : violated) {
      const Plane& plane = planes_[index(i)];
      double length = 0.0;
      for (const Fragment& fragment : cell.fragments) {
        if (!crosses(find_range(fragment, plane))) continue;
        length += halve(fragment, plane).length;
      }
      if (length < shortest * (1.0 - kFlat)) {
        shortest = length;
        best = i;
      }
    }
    return best;
  }

  // A fragment in the plane belongs to the side on which its material is.
  void split(const CutSurface& cell, const Plane& plane,
             std::vector<CutSurface>& out) const {
    CutSurface below{{}, cell.cuts};
    CutSurface above{{}, cell.cuts};
    below.cuts.push_back(plane);
    above.cuts.push_back({-plane.n, -plane.h});
    for (const Fragment& fragment : cell.fragments) {
      const HeightRange range = find_range(fragment, plane);
      if (crosses(range)) {
        Halves halves = halve(fragment, plane);
        below.fragments.push_back(std::move(halves.below));
        above.fragments.push_back(std::move(halves.above));
        continue;
      }
      const bool is_below =
          range.high <= same_ &&
          (range.low < -same_ ||
           planes_[index(fragment.plane)].n.dot(plane.n) > 0.0);
      (is_below ? below : above).fragments.push_back(fragment);
    }
    if (!above.fragments.empty()) out.push_back(std::move(above));
    if (!below.fragments.empty()) out.push_back(std::move(below));
  }

  [[nodiscard]] bool are_same(const Plane& a, const Plane& b) const {
    return a.n.dot(b.n) > 1.0 - kFlat && std::abs(a.h - b.h) <= same_;
  }

  // Nothing if it has no volume.
  [[nodiscard]] std::optional<ConvexSolid> make_part(
      const CutSurface& cell) const {
    std::vector<ConvexSolid::Face> faces;
    for (const int i : list_planes(cell)) {
      faces.push_back({planes_[index(i)], true});
    }
    for (const Plane& cut : cell.cuts) {
      const bool is_known =
          std::ranges::any_of(faces, [&](const ConvexSolid::Face& face) {
            return are_same(face.plane, cut);
          });
      if (!is_known) faces.push_back({cut, false});
    }
    return ConvexSolid::make_bounded(faces, bounds_);
  }

  double same_ = 0.0;    // distance that counts as none [m]
  double volume_ = 0.0;  // [m^3]
  ConvexSolid::Ball bounds_;
  std::vector<Plane> planes_;
  std::vector<std::size_t> part_counts_;  // with a face in each plane
  CutSurface whole_;
};

}  // namespace

std::vector<ConvexSolid> split_mesh(
    const Matrix3X& x_B, const std::vector<std::array<int, 6>>& faces) {
  return Splitter(x_B, faces).run();
}

}  // namespace limber::contact
