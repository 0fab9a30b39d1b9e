// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/self_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "limber/common/index.hpp"

namespace limber::scene {
namespace {

using Face = std::array<int, 3>;

struct Box {
  Vector3 low;
  Vector3 high;
};

// Splits faces by their middles, and checks the pairs whose boxes meet.
class CrossingFinder {
 public:
  CrossingFinder(const std::vector<Vector3>& points,
                 const std::vector<Face>& faces)
      : points_(points), faces_(faces), order_(faces.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    for (const Face& face : faces) {
      const Vector3& a = at(face[0]);
      const Vector3& b = at(face[1]);
      const Vector3& c = at(face[2]);
      boxes_.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
    }
    build(0, faces.size());
  }

  std::optional<Vector3> run() {
    look(0, 0);
    return where_;
  }

 private:
  struct Node {
    Box box;
    std::size_t first = 0;
    std::size_t count = 0;
    std::size_t right = 0;  // 0: a leaf; the left one is the next
  };

  [[nodiscard]] const Vector3& at(int corner) const {
    return points_[index(corner)];
  }

  std::size_t build(std::size_t first, std::size_t count) {
    constexpr std::size_t kLeaf = 4;
    const std::size_t me = nodes_.size();
    Box box = boxes_[order_[first]];
    for (std::size_t i = first; i < first + count; ++i) {
      box.low = box.low.cwiseMin(boxes_[order_[i]].low);
      box.high = box.high.cwiseMax(boxes_[order_[i]].high);
    }
    nodes_.push_back({box, first, count, 0});
    if (count <= kLeaf) return me;
    int axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto half = static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(begin, begin + half,
                     begin + static_cast<std::ptrdiff_t>(count),
                     [&](std::size_t a, std::size_t b) {
                       return boxes_[a].low[axis] + boxes_[a].high[axis] <
                              boxes_[b].low[axis] + boxes_[b].high[axis];
                     });
    build(first, count / 2);
    const std::size_t right = build(first + count / 2, count - count / 2);
    nodes_[me].right = right;
    return me;
  }

  static bool overlap(const Box& a, const Box& b) {
    return (a.low.array() <= b.high.array()).all() &&
           (b.low.array() <= a.high.array()).all();
  }

  void look(std::size_t i, std::size_t j) {
    const Node& a = nodes_[i];
    const Node& b = nodes_[j];
    if (where_ || !overlap(a.box, b.box)) return;
    if (a.right == 0 && b.right == 0) {
      look_at_faces(a, b);
    } else if (i == j) {
      look(i + 1, i + 1);
      look(a.right, a.right);
      look(i + 1, a.right);
    } else if (b.right == 0 || (a.right != 0 && a.count >= b.count)) {
      look(i + 1, j);
      look(a.right, j);
    } else {
      look(i, j + 1);
      look(i, b.right);
    }
  }

  void look_at_faces(const Node& a, const Node& b) {
    for (std::size_t i = a.first; i < a.first + a.count; ++i) {
      for (std::size_t j = b.first; j < b.first + b.count; ++j) {
        const std::size_t f = order_[i];
        const std::size_t g = order_[j];
        if (f == g || !overlap(boxes_[f], boxes_[g])) continue;
        if (share_a_corner(faces_[f], faces_[g])) continue;
        if (!where_) where_ = find_crossing(faces_[f], faces_[g]);
        if (!where_) where_ = find_crossing(faces_[g], faces_[f]);
      }
    }
  }

  static bool share_a_corner(const Face& f, const Face& g) {
    return std::any_of(f.begin(), f.end(), [&g](int corner) {
      return std::find(g.begin(), g.end(), corner) != g.end();
    });
  }

  // Crossing of an edge of f with g.
  [[nodiscard]] std::optional<Vector3> find_crossing(const Face& f,
                                                     const Face& g) const {
    const Vector3& a = at(g[0]);
    const Vector3 ab = at(g[1]) - a;
    const Vector3 ac = at(g[2]) - a;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3& from = at(f[i]);
      const Vector3 way = at(f[(i + 1) % 3]) - from;
      const Vector3 h = way.cross(ac);
      const double determinant = ab.dot(h);
      const double size = ab.norm() * ac.norm() * way.norm();
      if (std::abs(determinant) <= 1e-12 * size) continue;
      const Vector3 s = from - a;
      const Vector3 q = s.cross(ab);
      const double u = s.dot(h) / determinant;
      const double v = way.dot(q) / determinant;
      const double t = ac.dot(q) / determinant;
      const bool is_within = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
      if (is_within && t >= 0.0 && t <= 1.0) return Vector3(from + t * way);
    }
    return std::nullopt;
  }

  const std::vector<Vector3>& points_;
  const std::vector<Face>& faces_;
  std::vector<std::size_t> order_;
  std::vector<Box> boxes_;
  std::vector<Node> nodes_;
  std::optional<Vector3> where_;
};

}  // namespace

std::optional<Vector3> find_self_crossing(const std::vector<Vector3>& points,
                                          const std::vector<Face>& faces) {
  return CrossingFinder(points, faces).run();
}

}  // namespace limber::scene
