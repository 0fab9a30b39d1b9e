// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/collision_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/scene/contacts/self_crossing.hpp"

namespace limber::scene {
namespace {

constexpr double kSame = 1e-6;  // of the size [-]

std::string describe(const Vector3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x(), x.y(), x.z());
}

/// Gives the same number to points that nearly coincide.
class Corners {
 public:
  Corners(const Vector3& low, double same) : low_(low), same_(same) {}

  int find(const Vector3& x) {
    const Cell at = find_cell(x);
    for (int i = 0; i < 27; ++i) {
      const Cell near{at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1,
                      at[2] + i / 9 - 1};
      const auto [first, last] = cells_.equal_range(hash(near));
      for (auto found = first; found != last; ++found) {
        const bool is_same =
            (points_[index(found->second)] - x).norm() <= same_;
        if (is_same) return found->second;
      }
    }
    points_.push_back(x);
    const int number = static_cast<int>(points_.size()) - 1;
    cells_.emplace(hash(at), number);
    return number;
  }

  [[nodiscard]] const std::vector<Vector3>& points() const { return points_; }

 private:
  using Cell = std::array<std::int64_t, 3>;

  [[nodiscard]] Cell find_cell(const Vector3& x) const {
    const Vector3 at = (x - low_) / (2.0 * same_);
    return {static_cast<std::int64_t>(std::floor(at.x())),
            static_cast<std::int64_t>(std::floor(at.y())),
            static_cast<std::int64_t>(std::floor(at.z()))};
  }
  static std::uint64_t hash(const Cell& cell) {
    const auto part = [&cell](std::size_t i) {
      return static_cast<std::uint64_t>(cell[i]);
    };
    return part(0) * 73856093U ^ part(1) * 19349663U ^ part(2) * 83492791U;
  }

  Vector3 low_;
  double same_;
  std::vector<Vector3> points_;
  std::unordered_multimap<std::uint64_t, int> cells_;
};

class Joiner {
 public:
  Joiner(const std::vector<Triangle>& triangles, const std::string& name)
      : name_(name) {
    Vector3 low = triangles.front()[0];
    Vector3 high = low;
    for (const Triangle& triangle : triangles) {
      for (const Vector3& x : triangle) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
      }
    }
    box_ = high - low;
    const double size = box_.maxCoeff();
    const double same = kSame * size;
    if (!(same > 0.0) || !std::isfinite(box_.norm())) {
      refuse("has a size that double precision cannot represent");
    }
    Corners corners(low, same);
    for (const Triangle& triangle : triangles) {
      faces_.push_back({corners.find(triangle[0]), corners.find(triangle[1]),
                        corners.find(triangle[2])});
    }
    points_ = corners.points();
  }

  flexbody::ContactSurface run() {
    check_areas();
    check_edges();
    check_volume();
    if (const auto where = find_self_crossing(points_, faces_)) {
      refuse("crosses itself at " + describe(*where) +
             "; make it one closed surface");
    }
    return make_surface();
  }

 private:
  using Edge = std::pair<int, int>;

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("mesh '{}' {}", name_, why));
  }

  [[nodiscard]] const Vector3& at(int corner) const {
    return points_[index(corner)];
  }

  [[nodiscard]] std::string describe_edge(const Edge& edge) const {
    return "the edge from " + describe(at(edge.first)) + " to " +
           describe(at(edge.second));
  }

  void check_areas() const {
    constexpr double kLeast = 1e-12;  // of the longest edge's square
    for (const auto& [a, b, c] : faces_) {
      const Vector3 ab = at(b) - at(a);
      const Vector3 ac = at(c) - at(a);
      const double longest = std::max(
          {ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
      if (ab.cross(ac).norm() > kLeast * longest) continue;
      refuse("has a triangle without area at " + describe(at(a)) +
             "; remove it, and join its neighbours");
    }
  }

  // Each edge once in each direction.
  void check_edges() const {
    std::map<Edge, int> counts;
    for (const auto& face : faces_) {
      for (std::size_t i = 0; i < 3; ++i) {
        ++counts[{face[i], face[(i + 1) % 3]}];
      }
    }
    for (const auto& [edge, count] : counts) {
      const auto back = counts.find({edge.second, edge.first});
      const int others = back == counts.end() ? 0 : back->second;
      if (count == 1 && others == 1) continue;
      if (count + others == 1) {
        refuse("is open: " + describe_edge(edge) +
               " belongs to only one triangle; close it");
      }
      if (count + others == 2) {
        refuse("has triangles of opposite senses on both sides of " +
               describe_edge(edge) + "; flip one");
      }
      refuse(fmt::format("joins {} triangles in {}; expected two",
                         count + others, describe_edge(edge)));
    }
  }

  void check_volume() const {
    double volume = 0.0;
    for (const auto& [a, b, c] : faces_) {
      const Vector3& from = at(faces_.front()[0]);
      volume += (at(a) - from).cross(at(b) - from).dot(at(c) - from) / 6.0;
    }
    if (volume > 0.0) return;
    refuse(fmt::format(
        "is inside out (volume {:.3g} m^3): corners of triangles must follow "
        "each other counter-clockwise as seen from outside",
        volume));
  }

  [[nodiscard]] flexbody::ContactSurface make_surface() const {
    flexbody::ContactSurface surface;
    surface.name = name_;
    const auto n = static_cast<Eigen::Index>(points_.size());
    surface.tags.assign(points_.size(), 0);
    surface.x_B.resize(3, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      surface.x_B.col(i) = points_[static_cast<std::size_t>(i)];
    }
    surface.Phi_B.resize(3 * n, 0);
    surface.residual = VectorX::Zero(n);
    VectorX lengths = VectorX::Zero(n);
    VectorX counts = VectorX::Zero(n);
    for (const auto& [a, b, c] : faces_) {
      surface.faces.push_back({a, b, c, -1, -1, -1});
      for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
        lengths[edge.first] += (at(edge.second) - at(edge.first)).norm();
        counts[edge.first] += 1.0;
      }
    }
    surface.patch_radius =
        lengths.cwiseQuotient(counts).cwiseMin(0.5 * box_.minCoeff());
    return surface;
  }

  const std::string& name_;
  Vector3 box_;
  std::vector<Vector3> points_;
  std::vector<std::array<int, 3>> faces_;
};

}  // namespace

flexbody::ContactSurface join_triangles(const std::vector<Triangle>& triangles,
                                        const std::string& name) {
  LIMBER_EXPECT(!triangles.empty());
  return Joiner(triangles, name).run();
}

flexbody::ContactSurface read_collision_mesh(const MeshGeometry& mesh,
                                             const Pose& X_BS) {
  flexbody::ContactSurface surface =
      join_triangles(read_triangles(mesh), mesh.file.string());
  for (Eigen::Index i = 0; i < surface.x_B.cols(); ++i) {
    surface.x_B.col(i) = X_BS * Vector3(surface.x_B.col(i));
  }
  return surface;
}

}  // namespace limber::scene
