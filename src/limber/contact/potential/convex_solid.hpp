// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/contact/potential/polytope.hpp"
#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

/// A half space or a convex polyhedron in its own frame. Immutable; copies
/// share their data.
class ConvexSolid {
 public:
  struct Face {
    Plane plane;          ///< n unit
    bool presses = true;  ///< else it only bounds the solid, without depth
    std::vector<int> corners = {};     ///< counterclockwise from outside
    std::vector<int> neighbours = {};  ///< faces that share an edge with it
  };
  struct Ball {
    Vector3 centre = Vector3::Zero();
    double radius = 0.0;  ///< [m]
  };

  static constexpr std::size_t kMostFaces = 2000;

  /// @throws ContractError unless is_solid(shape).
  explicit ConvexSolid(const ShapeKind& shape);

  /// All that lies below these faces, of which those that bound nothing are
  /// left out. Corners that differ by less than 1e-9 of its size are one.
  /// @param faces planes, and whether they press
  /// @param within a ball that holds it
  /// @returns nothing where nothing is, or these faces do not close it
  /// @throws ContractError for more than kMostFaces.
  [[nodiscard]] static std::optional<ConvexSolid> make_bounded(
      std::span<const Face> faces, const Ball& within);

  /// What lies up to `depth` below a flat face; that face presses, and those
  /// beside it at the edges of `rim`.
  /// @param corners 3 x k of the face, convex, z = 0, right-hand about z [m]
  /// @param rim edges, by their first corners, < k
  [[nodiscard]] static ConvexSolid make_slab(
      const Matrix3X& corners, const std::vector<std::size_t>& rim,
      double depth);

  [[nodiscard]] const std::vector<Face>& faces() const { return data_->faces; }
  /// None of a half space.
  [[nodiscard]] const std::vector<Vector3>& corners() const {
    return data_->corners;
  }
  [[nodiscard]] bool is_bounded() const { return !corners().empty(); }
  /// About all corners, which a half space has not.
  [[nodiscard]] const Ball& ball() const { return data_->ball; }
  /// The least n . x of its points, and the largest one, bounded [m].
  [[nodiscard]] double find_low(const Vector3& n) const;
  [[nodiscard]] double find_high(const Vector3& n) const;
  /// [m^3]
  [[nodiscard]] double find_volume() const;
  /// Of facets on a face of a pair's first or second solid, 0 or 1.
  [[nodiscard]] static int tag_of(int face, int side) {
    return -2 - 2 * face - side;
  }
  /// The face of such a tag, if it is of that side; else -1.
  [[nodiscard]] static int face_of(int tag, int side) {
    return tag <= -2 && (-2 - tag) % 2 == side ? (-2 - tag) / 2 : -1;
  }

 private:
  struct Data {
    std::vector<Face> faces;
    std::vector<Vector3> corners;
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> by_axis;
    Ball ball;
  };

  explicit ConvexSolid(Data data);

  std::shared_ptr<const Data> data_;
};

/// Whether a shape is a half space or a polyhedron.
[[nodiscard]] bool is_solid(const ShapeKind& shape);

}  // namespace limber::contact
