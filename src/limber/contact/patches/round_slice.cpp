// SPDX-License-Identifier: BSD-3-Clause
// The round body that a slice of a surface is.
#include <algorithm>
#include <cmath>
#include <map>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/contact/patches/round_fit.hpp"
#include "limber/contact/patches/surface_slice.hpp"

namespace limber::contact {
namespace {

constexpr double kRound = 1e-3;  // of nodes from a round side, of the radius
constexpr double kAlong = 1e-3;  // of axes and normals [rad]
constexpr double kFlat = 1e-4;   // of the normals' second moments
constexpr double kOpen = 0.05;   // of the area that is not around the axis

/// A smooth piece of a slice's surface.
struct Piece {
  std::vector<SurfaceFacet> facets;
  double size = 0.0;                 ///< [m^2]
  Vector3 area = Vector3::Zero();    ///< with its direction [m^2]
  Vector3 centre = Vector3::Zero();  ///< [m]
  dense::Eigenpairs3 normals;        ///< second moments, of the unit normals

  [[nodiscard]] bool is_flat() const { return normals.values[1] < kFlat; }
  /// Seen from outside.
  [[nodiscard]] bool is_hollow() const {
    double flux = 0.0;
    for (const SurfaceFacet& f : facets) flux += f.area.dot(f.middle - centre);
    return flux < 0.0;
  }
  /// Whether it surrounds an axis.
  [[nodiscard]] bool is_around(const Vector3& axis) const {
    return (area - axis.dot(area) * axis).norm() < kOpen * size;
  }
};

std::vector<Piece> find_pieces(const SurfaceSlice& slice) {
  std::map<int, Piece> pieces;
  for (const SurfaceFacet& f : slice.facets)
    pieces[f.patch].facets.push_back(f);
  std::vector<Piece> all;
  for (auto& [patch, piece] : pieces) {
    Matrix3 moments = Matrix3::Zero();
    for (const SurfaceFacet& f : piece.facets) {
      const double size = f.area.norm();
      piece.size += size;
      piece.area += f.area;
      piece.centre += size * f.middle;
      if (size > 0.0) moments += f.area * f.area.transpose() / size;
    }
    piece.centre /= piece.size;
    piece.normals = dense::find_eigenpairs(Matrix3(moments / piece.size));
    all.push_back(std::move(piece));
  }
  return all;
}

// Rotation with its z axis along a direction.
Matrix3 find_upright(const Vector3& axis) {
  Matrix3 R;
  R.col(2) = axis;
  R.col(0) = axis.unitOrthogonal();
  R.col(1) = axis.cross(Vector3(R.col(0)));
  return R;
}

/// Along an axis.
struct Ends {
  double low = 0.0;   ///< [m]
  double high = 0.0;  ///< [m]
  bool is_low_cut = false;
  bool is_high_cut = false;
};

// Nothing if a plane is not across the axis.
std::optional<Ends> find_ends(const SurfaceSlice& slice, const RoundFit& fit,
                              const std::vector<Vector3>& points) {
  Ends ends{RoundFit::kEndless, -RoundFit::kEndless, false, false};
  for (const Vector3& x : points) {
    ends.low = std::min(ends.low, fit.find_height(x));
    ends.high = std::max(ends.high, fit.find_height(x));
  }
  for (Eigen::Index k = 0; k < slice.heights.size(); ++k) {
    const Vector3 n = slice.normals.col(k);
    const double cosine = n.dot(fit.axis);
    // By the second moments of a mesh, which need not be symmetric.
    if (std::abs(cosine) < std::cos(20.0 * kAlong)) return {};
    const double z = (slice.heights[k] - n.dot(fit.centre)) / cosine;
    (cosine > 0.0 ? ends.high : ends.low) = z;
    (cosine > 0.0 ? ends.is_high_cut : ends.is_low_cut) = true;
  }
  if (!(ends.low < ends.high)) return {};
  return ends;
}

// Of the slice's points between its planes.
template <typename Depth>
double find_round_error(const SurfaceSlice& slice, const Depth& find_distance) {
  double error = 0.0;
  for (const Vector3& x : slice.list_points(slice.facets)) {
    if (((slice.normals.transpose() * x - slice.heights).array() > 0.0).any()) {
      continue;
    }
    error = std::max(error, std::abs(find_distance(x)));
  }
  return error;
}

// Whether flat pieces are across the axis, at an end that is not cut.
bool is_end(const Piece& piece, const RoundFit& fit, const Ends& ends) {
  const double along = piece.area.normalized().dot(fit.axis);
  if (std::abs(along) < std::cos(10.0 * kAlong)) return false;
  const double z = fit.find_height(piece.centre);
  return std::abs(z - (along > 0.0 ? ends.high : ends.low)) <
         10.0 * kRound * fit.radius;
}

std::optional<SliceBody> find_cylinder(const SurfaceSlice& slice,
                                       const std::vector<Piece>& pieces,
                                       const Piece& side) {
  const std::vector<Vector3> points = slice.list_points(side.facets);
  const auto fit = fit_rod(points, side.normals.vectors.col(0), false, false);
  if (!fit || fit->error > kRound * fit->radius) return {};
  if (!side.is_around(fit->axis)) return {};
  const auto ends = find_ends(slice, *fit, points);
  if (!ends) return {};
  const bool is_all = std::ranges::all_of(pieces, [&](const Piece& piece) {
    if (&piece == &side) return true;
    return piece.is_flat() ? is_end(piece, *fit, *ends) : piece.is_hollow();
  });
  if (!is_all) return {};
  const double half = 0.5 * (ends->high - ends->low);
  const double middle = 0.5 * (ends->high + ends->low);
  const auto find_distance = [&](const Vector3& x) {
    const double z = fit->find_height(x);
    double out = fit->find_distance(x);
    if (!ends->is_low_cut) out = std::max(out, ends->low - z);
    if (!ends->is_high_cut) out = std::max(out, z - ends->high);
    return out;
  };
  return SliceBody{
      {Cylinder{fit->radius, half},
       {find_upright(fit->axis), fit->centre + middle * fit->axis}},
      find_round_error(slice, find_distance)};
}

std::optional<SliceBody> find_whole_ball(const SurfaceSlice& slice,
                                         const std::vector<Piece>& pieces) {
  if (pieces.size() != 1 || slice.heights.size() > 0) return {};
  const auto fit = fit_ball(slice.list_points(slice.facets));
  if (!fit || fit->error > kRound * fit->radius) return {};
  if (pieces.front().area.norm() > kOpen * pieces.front().size) return {};
  return SliceBody{{Sphere{fit->radius}, {Matrix3::Identity(), fit->centre}},
                   fit->error};
}

// One that is cut continues as far as its plane, with a round end behind it.
std::optional<SliceBody> find_capsule(const SurfaceSlice& slice,
                                      const std::vector<Piece>& pieces) {
  if (pieces.size() != 1) return {};
  const std::vector<Vector3> points = slice.list_points(slice.facets);
  const Vector3 axis = pieces.front().normals.vectors.col(0);
  RoundFit cut{.centre = pieces.front().centre, .axis = axis};
  const auto begin = find_ends(slice, cut, points);
  if (!begin) return {};
  const auto fit =
      fit_rod(points, axis, !begin->is_low_cut, !begin->is_high_cut);
  if (!fit || fit->error > kRound * fit->radius) return {};
  if (!pieces.front().is_around(fit->axis)) return {};
  const auto ends = find_ends(slice, *fit, points);
  if (!ends) return {};
  const double low = ends->is_low_cut ? ends->low : fit->low;
  const double high = ends->is_high_cut ? ends->high : fit->high;
  if (!(low < high)) return {};
  const double middle = 0.5 * (low + high);
  return SliceBody{
      {Capsule{fit->radius, 0.5 * (high - low)},
       {find_upright(fit->axis), fit->centre + middle * fit->axis}},
      fit->error};
}

}  // namespace

std::optional<SliceBody> find_round_body(const SurfaceSlice& slice) {
  if (slice.facets.empty()) return {};
  const std::vector<Piece> pieces = find_pieces(slice);
  const Piece* side = nullptr;
  for (const Piece& piece : pieces) {
    if (piece.is_flat() || piece.is_hollow()) continue;
    if (side == nullptr || piece.size > side->size) side = &piece;
  }
  if (side == nullptr) return {};
  if (auto ball = find_whole_ball(slice, pieces)) return ball;
  if (auto cylinder = find_cylinder(slice, pieces, *side)) return cylinder;
  return find_capsule(slice, pieces);
}

}  // namespace limber::contact
