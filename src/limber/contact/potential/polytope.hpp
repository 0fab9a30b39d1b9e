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

/// A face of a Polytope; corners counterclockwise, seen from outside.
struct Facet {
  int tag = -1;  ///< of the plane that it lies in
  std::span<const Vector3> corners;
};

class Polytope {
 public:
  static constexpr std::size_t kMostFacets = 2064;
  static constexpr std::size_t kMostCorners = 6 * kMostFacets;

  Polytope() {}  // NOLINT: its arrays stay as they are
  Polytope(const Polytope& other) : Polytope() { *this = other; }
  Polytope& operator=(const Polytope& other);

  /// Each by its value, in a loop.
  class Facets {
   public:
    class Iterator {
     public:
      Iterator(const Polytope& of, std::size_t i) : of_(&of), i_(i) {}
      Facet operator*() const { return of_->facet(i_); }
      Iterator& operator++() {
        ++i_;
        return *this;
      }
      bool operator==(const Iterator& other) const = default;

     private:
      const Polytope* of_;
      std::size_t i_;
    };

    explicit Facets(const Polytope& of) : of_(of) {}
    [[nodiscard]] Iterator begin() const { return {of_, 0}; }
    [[nodiscard]] Iterator end() const { return {of_, of_.facet_count()}; }

   private:
    const Polytope& of_;
  };

  [[nodiscard]] Facets facets() const { return Facets(*this); }
  [[nodiscard]] Facet facet(std::size_t i) const {
    const Range& range = ranges_[i];
    return {range.tag, {corners_.data() + range.first, range.count}};
  }
  [[nodiscard]] std::size_t facet_count() const { return facet_count_; }
  /// Of all facets, each once for every facet that it belongs to.
  [[nodiscard]] std::span<const Vector3> corners() const {
    return {corners_.data(), corner_count_};
  }
  [[nodiscard]] bool is_empty() const { return facet_count_ == 0; }
  void clear() { facet_count_ = corner_count_ = 0; }

  /// Adds a facet without corners, unless the last one has fewer than three:
  /// then it takes its place. @throws NumericalError beyond kMostFacets.
  void begin_facet(int tag);
  /// @throws NumericalError likewise, and beyond kMostCorners.
  void add_facet(const Facet& facet);
  /// To the last facet. @throws NumericalError beyond kMostCorners.
  void add_corner(const Vector3& corner);
  /// Drops the last facet if it has fewer than three corners.
  void end_facets();
  void move(const Vector3& by);

 private:
  struct Range {
    int tag;
    std::size_t first;
    std::size_t count;
  };

  std::size_t facet_count_ = 0;
  std::size_t corner_count_ = 0;
  std::array<Range, kMostFacets> ranges_;
  std::array<Vector3, kMostCorners> corners_;
};

/// The part of `in` inside of a plane, whose facet there gets `tag`; empty
/// where nothing is inside.
/// @param scratch not `in`
/// @return `in` if all of it is inside except for round-off, else `scratch`
[[nodiscard]] const Polytope& clip(const Polytope& in, const Plane& plane,
                                   int tag, Polytope& scratch);

/// Cuts one polytope by planes, in turn from one memory into another.
class Cutter {
 public:
  /// @param from that outlives it @param scratch neither of them `from`
  Cutter(const Polytope& from, std::array<Polytope, 2>& scratch)
      : part_(&from), scratch_(scratch) {}

  /// @return whether anything is left
  bool cut(const Plane& plane, int tag);
  [[nodiscard]] const Polytope& part() const { return *part_; }

 private:
  const Polytope* part_;
  std::array<Polytope, 2>& scratch_;
};

/// A box. @param axes its directions by columns, of a right-handed frame
/// @param low, high along these, of all its points [m] @param tag of all facets
void make_box(const Matrix3& axes, const Vector3& low, const Vector3& high,
              int tag, Polytope& out);

}  // namespace limber::contact
