// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/ruled_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <variant>

#include "limber/common/index.hpp"
#include "limber/contact/potential/polytope.hpp"

namespace limber::contact {
namespace {

using Kind = RuledSurface::Kind;
using Outlines = std::vector<std::unique_ptr<std::vector<Eigen::Vector2d>>>;

// Directions more upright than this have none in the plane [-].
constexpr double kUpright = 1e-6;
// More than a soft body's extent [-].
constexpr double kBeyond = 1.01;
// Of the flux through a sheet, and of its normal's part in its plane [-].
constexpr double kNothing = 1e-12;

// ---- rows across the way in which the depth below a body changes most
Vector3 choose_way(const Sphere& /*soft*/, const Vector3& /*n*/) {
  return Vector3::Zero();
}
Vector3 choose_way(const Capsule& /*soft*/, const Vector3& /*n*/) {
  return Vector3::UnitZ();
}
Vector3 choose_way(const Cylinder& /*soft*/, const Vector3& /*n*/) {
  return Vector3::UnitZ();
}
Vector3 choose_way(const Cone& /*soft*/, const Vector3& /*n*/) {
  return Vector3::UnitZ();
}
Vector3 choose_way(const Ellipsoid& soft, const Vector3& /*n*/) {
  Eigen::Index longest = 0;
  soft.radii.maxCoeff(&longest);
  return Vector3::Unit(longest);
}
// The edge of the face that is opposite which is most in the plane.
Vector3 choose_way(const SolidField& soft, const Vector3& n) {
  const ConvexSolid& solid = soft.solid();
  const auto opposite = std::ranges::min_element(
      solid.faces(), {}, [&](const auto& face) { return n.dot(face.plane.n); });
  if (!solid.is_bounded()) return n.cross(opposite->plane.n);
  Vector3 way = Vector3::Zero();
  double least = 2.0;
  const std::vector<int>& corners = opposite->corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3& a = solid.corners()[index(corners[i])];
    const Vector3& b =
        solid.corners()[index(corners[(i + 1) % corners.size()])];
    const Vector3 edge = (b - a).normalized();
    const double upright = std::abs(edge.dot(n));
    if (upright < least - kUpright) {
      least = upright;
      way = edge;
    }
  }
  return way;
}

Vector3 find_row_way(const DepthField& soft, const Vector3& n) {
  const Vector3 way = std::visit(
      [&](const auto& kind) { return choose_way(kind, n); }, soft.kind());
  const Vector3 in_plane = way - way.dot(n) * n;
  if (in_plane.norm() < kUpright) return Vector3::Zero();
  return in_plane.normalized();
}

// ---- the radius of a ball about the origin, 0 of a half space
double find_radius(const Sphere& shape) { return shape.radius; }
double find_radius(const Capsule& shape) {
  return shape.half_length + shape.radius;
}
double find_radius(const Cylinder& shape) {
  return std::hypot(shape.half_length, shape.radius);
}
double find_radius(const Cone& shape) {
  return std::hypot(shape.half_length, shape.radius);
}
double find_radius(const Ellipsoid& shape) { return shape.radii.maxCoeff(); }
double find_radius(const SolidField& field) {
  const ConvexSolid& solid = field.solid();
  if (!solid.is_bounded()) return 0.0;
  return solid.ball().centre.norm() + solid.ball().radius;
}

// ---- surfaces
void add_side(const Cylinder& shape, std::vector<RuledSurface>& out) {
  RuledSurface& side = out.emplace_back();
  side.kind = Kind::kSide;
  side.radius = shape.radius;
  side.u = {-std::numbers::pi, std::numbers::pi};
  side.half_v = shape.half_length;
  side.reach = find_radius(shape);
}

void add_ends(const Cylinder& shape, std::vector<RuledSurface>& out) {
  for (const double sign : {-1.0, 1.0}) {
    RuledSurface& disc = out.emplace_back();
    disc.kind = Kind::kDisc;
    disc.e3 = sign * Vector3::UnitZ();
    disc.centre = shape.half_length * disc.e3;
    disc.radius = disc.reach = shape.radius;
    disc.u = {-0.5 * std::numbers::pi, 0.5 * std::numbers::pi};
  }
}

void add_rims(const Cylinder& shape, std::vector<RuledSurface>& out) {
  for (const double sign : {-1.0, 1.0}) {
    RuledSurface& rim = out.emplace_back();
    rim.kind = Kind::kRim;
    rim.e3 = sign * Vector3::UnitZ();
    rim.centre = shape.half_length * rim.e3;
    rim.radius = shape.radius;
    rim.u = {-std::numbers::pi, std::numbers::pi};
    rim.half_v = std::min(shape.radius, shape.half_length);
    rim.reach = std::hypot(rim.radius, rim.half_v);
  }
}

void add_cone(const Cone& shape, std::vector<RuledSurface>& surfaces,
              std::vector<RuledSurface>& sheets) {
  const double slant = std::hypot(shape.radius, 2.0 * shape.half_length);
  RuledSurface& side = surfaces.emplace_back();
  side.kind = Kind::kSide;
  side.radius = 0.5 * shape.radius;
  side.sine = shape.radius / slant;
  side.u = {-std::numbers::pi, std::numbers::pi};
  side.half_v = 0.5 * slant;
  side.reach = find_radius(shape);
  RuledSurface disc;
  disc.kind = Kind::kDisc;
  disc.e3 = -Vector3::UnitZ();
  disc.centre = shape.half_length * disc.e3;
  disc.radius = disc.reach = shape.radius;
  disc.u = {-0.5 * std::numbers::pi, 0.5 * std::numbers::pi};
  surfaces.push_back(disc);
  RuledSurface rim = disc;
  rim.kind = Kind::kRim;
  rim.sine = side.sine;
  rim.u = side.u;
  rim.half_v = 2.0 * shape.half_length * side.sine / (1.0 + side.sine);
  rim.reach = std::hypot(rim.radius, rim.half_v);
  sheets.push_back(rim);
}

RuledSurface add_polygon(std::span<const Vector3> corners,
                         const Vector3& normal, const Vector3& way,
                         Outlines& outlines) {
  outlines.push_back(std::make_unique<std::vector<Eigen::Vector2d>>());
  return make_polygon(corners, normal, way, *outlines.back());
}

void add_faces(const ConvexSolid& solid, std::vector<RuledSurface>& out,
               Outlines& outlines) {
  if (!solid.is_bounded()) {
    RuledSurface& plane = out.emplace_back();
    plane.e3 = solid.faces().front().plane.n;
    return;
  }
  std::vector<Vector3> corners;
  for (const ConvexSolid::Face& face : solid.faces()) {
    corners.clear();
    for (const int i : face.corners) {
      corners.push_back(solid.corners()[index(i)]);
    }
    const Vector3& n = face.plane.n;
    out.push_back(add_polygon(corners, n, n.unitOrthogonal(), outlines));
  }
}

// Where two faces are equally near, with corners as a facet of the part next
// to the first.
void add_sheet(const Plane& own, const Plane& other,
               std::span<const Vector3> corners, std::vector<RuledSurface>& out,
               Outlines& outlines) {
  const Vector3 across = other.n - own.n;
  const double density = across.norm();  // of both cells' t^4
  if (!(density > kNothing)) return;
  const Vector3 normal = across / density;
  const Vector3 rise = own.n.dot(normal) * normal - own.n;
  const Vector3 way =
      rise.norm() > kNothing ? rise.normalized() : normal.unitOrthogonal();
  RuledSurface sheet = add_polygon(corners, normal, way, outlines);
  sheet.density = density;
  sheet.depth = own.find_depth(sheet.centre);
  sheet.slope = -own.n.dot(sheet.e2);
  out.push_back(sheet);
}

// Of a bounded solid, by the parts of it that are nearest to each face.
void add_sheets(const ConvexSolid& solid, std::vector<RuledSurface>& out,
                Outlines& outlines) {
  const auto count = static_cast<int>(solid.faces().size());
  const auto plane = [&](int f) -> const Plane& {
    return solid.faces()[index(f)].plane;
  };
  const Vector3 reach = Vector3::Constant(kBeyond * solid.ball().radius);
  Polytope box;
  make_box(Matrix3::Identity(), solid.ball().centre - reach,
           solid.ball().centre + reach, -1, box);
  std::array<Polytope, 2> scratch;
  Cutter whole(box, scratch);
  for (int f = 0; f < count; ++f) {
    if (!whole.cut(plane(f), -1)) return;
  }
  const Polytope all = whole.part();
  for (int i = 0; i < count; ++i) {
    Cutter part(all, scratch);
    bool is_left = true;
    for (int j = 0; j < count && is_left; ++j) {
      if (j == i) continue;
      is_left = part.cut({plane(j).n - plane(i).n, plane(j).h - plane(i).h}, j);
    }
    if (!is_left) continue;
    for (const Facet& facet : part.part().facets()) {
      if (facet.tag <= i) continue;
      add_sheet(plane(i), plane(facet.tag), facet.corners, out, outlines);
    }
  }
}

}  // namespace

RuledBody::RuledBody(const BodyKind& body) {
  auto data = std::make_shared<Data>(body);
  data->radius = std::visit([](const auto& kind) { return find_radius(kind); },
                            data->field.kind());
  if (const auto* cylinder = std::get_if<Cylinder>(&body)) {
    add_side(*cylinder, data->surfaces);
    add_ends(*cylinder, data->surfaces);
    add_rims(*cylinder, data->sheets);
  }
  if (const auto* cone = std::get_if<Cone>(&body)) {
    add_cone(*cone, data->surfaces, data->sheets);
  }
  if (const auto* solid = std::get_if<ConvexSolid>(&body)) {
    add_faces(*solid, data->surfaces, data->outlines);
    data->is_soft =
        std::ranges::all_of(solid->faces(), &ConvexSolid::Face::presses);
    if (data->is_soft && solid->is_bounded()) {
      add_sheets(*solid, data->sheets, data->outlines);
    }
  }
  data_ = std::move(data);
}

RuledSurface RuledBody::place(const RuledSurface& surface, const Pose& X,
                              const RuledBody& soft) const {
  RuledSurface placed = surface.place(X);
  if (placed.kind == Kind::kPlane) {
    const double half = kBeyond * soft.data_->radius;
    placed.centre = X.p.dot(placed.e3) * placed.e3;
    placed.u = {-half, half};
    placed.half_v = half;
    placed.reach = std::numbers::sqrt2 * half;
  }
  return placed;
}

void RuledBody::turn_rows(RuledSurface& surface) const {
  if (!surface.is_closed()) {
    surface.turn_rows(find_row_way(field(), surface.e3));
  }
}

bool RuledBody::is_reached(const RuledSurface& surface) const {
  if (field().find_t(surface.centre) + surface.reach < 0.0) return false;
  if (surface.is_closed()) return true;
  const Span extent = field().find_extent(surface.e3);
  const double at = surface.centre.dot(surface.e3);
  return at > extent.first && at < extent.last;
}

}  // namespace limber::contact
