// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "limber/common/types.hpp"

/// Convex polytopes by their facets, cut by planes without allocation.
namespace limber::contact {

/// n . x <= h is inside.
struct Plane {
  Vector3 n = Vector3::Zero();  ///< of any length [-]
  double h = 0.0;               ///< [m]

  /// Below it, times |n| [m].
  [[nodiscard]] double find_depth(const Vector3& x) const {
    return h - n.dot(x);
  }
};

/// A face; corners counterclockwise, seen from outside.
class Facet {
 public:
  static constexpr std::size_t kMost = 24;

  explicit Facet(int tag = -1) : tag_(tag) {}

  /// Of the plane that it lies in.
  [[nodiscard]] int tag() const { return tag_; }
  [[nodiscard]] std::span<const Vector3> corners() const {
    return {corners_.data(), count_};
  }
  /// @throws ContractError beyond kMost.
  void add(const Vector3& corner);

 private:
  int tag_;
  std::size_t count_ = 0;
  std::array<Vector3, kMost> corners_;
};

class Polytope {
 public:
  static constexpr std::size_t kMost = 32;

  [[nodiscard]] std::span<const Facet> facets() const {
    return {facets_.data(), count_};
  }
  [[nodiscard]] bool is_empty() const { return count_ == 0; }
  void clear() { count_ = 0; }
  /// @throws ContractError beyond kMost.
  void add(const Facet& facet);

 private:
  std::size_t count_ = 0;
  std::array<Facet, kMost> facets_;
};

/// The part of `in` inside of a plane, whose facet there gets `tag`; empty
/// where nothing is inside.
/// @param scratch not `in`
/// @return `in` if all of it is inside, else `scratch`
[[nodiscard]] const Polytope& clip(const Polytope& in, const Plane& plane,
                                   int tag, Polytope& scratch);

}  // namespace limber::contact
