// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/shape_skin.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {
namespace {

using Triangle = std::array<int, 3>;

flexbody::ContactSurface make_surface(const std::string& name,
                                      const std::vector<Vector3>& nodes,
                                      double patch, const Pose& X) {
  flexbody::ContactSurface surface;
  surface.name = name;
  const auto n = static_cast<Eigen::Index>(nodes.size());
  surface.tags.assign(nodes.size(), 0);
  surface.x_B.resize(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    surface.x_B.col(i) = X * nodes[static_cast<std::size_t>(i)];
  }
  surface.Phi_B.resize(3 * n, 0);
  surface.residual = VectorX::Zero(n);
  surface.patch_radius = VectorX::Constant(n, patch);
  return surface;
}

flexbody::ContactSurface make_box(const Box& box, const Pose& X) {
  constexpr std::array<Triangle, 12> kFaces = {{{0, 2, 3},
                                                {0, 3, 1},
                                                {4, 5, 7},
                                                {4, 7, 6},
                                                {0, 1, 5},
                                                {0, 5, 4},
                                                {2, 6, 7},
                                                {2, 7, 3},
                                                {0, 4, 6},
                                                {0, 6, 2},
                                                {1, 3, 7},
                                                {1, 7, 5}}};
  std::vector<Vector3> nodes;
  for (int i = 0; i < 8; ++i) {
    const Vector3 corner((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0,
                         (i & 4) != 0 ? 1.0 : -1.0);
    nodes.emplace_back(box.half_size.cwiseProduct(corner));
  }
  auto surface = make_surface("box", nodes, box.half_size.minCoeff(), X);
  for (const auto& [a, b, c] : kFaces) {
    surface.faces.push_back({a, b, c, -1, -1, -1});
  }
  return surface;
}

// Quadratic faces over a grid of places (around, along), whose first and last
// rows are single points.
class CapsuleMaker {
 public:
  explicit CapsuleMaker(const Capsule& capsule) : capsule_(capsule) {}

  flexbody::ContactSurface make(const Pose& X) {
    for (int row = 0; row < kRows; ++row) {
      for (int i = 0; i < kAround; ++i) {
        const int j = i + 1;
        if (row > 0) add({i, row}, {j, row}, {j, row + 1});
        if (row < kRows - 1) add({i, row}, {j, row + 1}, {i, row + 1});
      }
    }
    auto surface = make_surface("capsule", nodes_, capsule_.radius, X);
    surface.faces = faces_;
    return surface;
  }

 private:
  // Rows of corners: a pole, kCap rings of each cap, the straight part between
  // the caps, a pole.
  static constexpr int kAround = 32;
  static constexpr int kCap = 8;
  static constexpr int kRows = 2 * kCap + 1;
  // In steps of half a face.
  struct Place {
    int around;
    int row;
  };

  [[nodiscard]] Vector3 find_point(int half_around, int half_row) const {
    const double turn = std::numbers::pi * half_around / kAround;
    const int equator = 2 * kCap;
    double angle = 0.0;  // from the lower pole
    double z = 0.0;      // of the centre
    if (half_row <= equator) {
      angle = 0.5 * std::numbers::pi * half_row / equator;
      z = -capsule_.half_length;
    } else if (half_row >= equator + 2) {
      angle = 0.5 * std::numbers::pi * (half_row - 2) / equator;
      z = capsule_.half_length;
    } else {
      angle = 0.5 * std::numbers::pi;
    }
    const double across = capsule_.radius * std::sin(angle);
    return {across * std::cos(turn), across * std::sin(turn),
            z - capsule_.radius * std::cos(angle)};
  }

  int find_node(int half_around, int half_row) {
    const bool is_pole = half_row == 0 || half_row == 2 * kRows;
    const int around = is_pole ? 0 : half_around % (2 * kAround);
    const auto [found, is_new] = numbers_.try_emplace(
        {around, half_row}, static_cast<int>(nodes_.size()));
    if (is_new) nodes_.push_back(find_point(around, half_row));
    return found->second;
  }

  // Nodes in the middle of an edge that ends in a pole are on its meridian.
  int find_middle(const Place& a, const Place& b) {
    const auto is_pole = [](const Place& p) {
      return p.row == 0 || p.row == kRows;
    };
    const int around = is_pole(a)   ? 2 * b.around
                       : is_pole(b) ? 2 * a.around
                                    : a.around + b.around;
    return find_node(around, a.row + b.row);
  }

  void add(const Place& a, const Place& b, const Place& c) {
    faces_.push_back({find_node(2 * a.around, 2 * a.row),
                      find_node(2 * b.around, 2 * b.row),
                      find_node(2 * c.around, 2 * c.row), find_middle(a, b),
                      find_middle(b, c), find_middle(c, a)});
  }

  const Capsule& capsule_;
  std::map<std::pair<int, int>, int> numbers_;
  std::vector<Vector3> nodes_;
  std::vector<std::array<int, 6>> faces_;
};

// Quadratic faces around, between flat ends of straight ones about their
// middle.
class CylinderMaker {
 public:
  explicit CylinderMaker(const Cylinder& cylinder) : cylinder_(cylinder) {}

  flexbody::ContactSurface make(const Pose& X) {
    for (int i = 0; i < kAround; ++i) {
      add_side(i);
      for (const int end : {0, 2}) add_end(i, end);
    }
    auto surface =
        make_surface("cylinder", nodes_,
                     std::min(cylinder_.radius, cylinder_.half_length), X);
    surface.faces = faces_;
    return surface;
  }

 private:
  static constexpr int kAround = 48;

  // Half steps around, and up: 0 the lower end, 2 the upper one.
  int find_node(int around, int up) {
    around %= 2 * kAround;
    const double turn = std::numbers::pi * around / kAround;
    return find({around, up}, {cylinder_.radius * std::cos(turn),
                               cylinder_.radius * std::sin(turn),
                               (up - 1) * cylinder_.half_length});
  }
  int find_middle(int end) {
    return find({-1, end}, {0.0, 0.0, (end - 1) * cylinder_.half_length});
  }
  int find(const std::pair<int, int>& key, const Vector3& x) {
    const auto [found, is_new] =
        numbers_.try_emplace(key, static_cast<int>(nodes_.size()));
    if (is_new) nodes_.push_back(x);
    return found->second;
  }

  void add_side(int i) {
    const int a = 2 * i;
    const int b = a + 2;
    faces_.push_back({find_node(a, 0), find_node(b, 0), find_node(b, 2),
                      find_node(a + 1, 0), find_node(b, 1),
                      find_node(a + 1, 1)});
    faces_.push_back({find_node(a, 0), find_node(b, 2), find_node(a, 2),
                      find_node(a + 1, 1), find_node(a + 1, 2),
                      find_node(a, 1)});
  }
  void add_end(int i, int end) {
    const int a = find_node(2 * i, end);
    const int b = find_node(2 * i + 2, end);
    faces_.push_back(
        {find_middle(end), end == 2 ? a : b, end == 2 ? b : a, -1, -1, -1});
  }

  const Cylinder& cylinder_;
  std::map<std::pair<int, int>, int> numbers_;
  std::vector<Vector3> nodes_;
  std::vector<std::array<int, 6>> faces_;
};

flexbody::ContactSurface make_surface_of(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape.kind)) {
    return make_box(*box, shape.X_BS);
  }
  if (const auto* rod = std::get_if<Cylinder>(&shape.kind)) {
    return CylinderMaker(*rod).make(shape.X_BS);
  }
  LIMBER_EXPECT(std::holds_alternative<Capsule>(shape.kind));
  return CapsuleMaker(std::get<Capsule>(shape.kind)).make(shape.X_BS);
}

}  // namespace

Shape make_skin(const Shape& shape) {
  if (std::holds_alternative<std::shared_ptr<const Skin>>(shape.kind)) {
    return shape;
  }
  return {std::make_shared<const Skin>(make_surface_of(shape)), Pose{}};
}

}  // namespace limber::contact
