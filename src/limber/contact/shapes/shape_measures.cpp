// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/shape_measures.hpp"

#include <algorithm>
#include <memory>
#include <type_traits>
#include <variant>
#include <vector>

#include "limber/contact/shapes/mesh_surface.hpp"
#include "limber/contact/shapes/shape_properties.hpp"

namespace limber::contact {
namespace {

using SurfacePointer = std::shared_ptr<const MeshSurface>;

template <typename Array>
std::vector<double> list_values(const Array& array) {
  return {array.data(), array.data() + array.size()};
}

void describe_kind(Manifest& out, const Sphere& sphere) {
  out.add("radius [m]", sphere.radius);
}

// For a capsule, a cylinder or a cone.
template <typename Rod>
void describe_kind(Manifest& out, const Rod& rod) {
  out.add("radius [m]", rod.radius);
  out.add("half length [m]", rod.half_length);
}

void describe_kind(Manifest& out, const Ellipsoid& body) {
  out.add("radii [m]", list_values(body.radii));
}

void describe_kind(Manifest& out, const Box& box) {
  out.add("half size [m]", list_values(box.half_size));
}

void describe_kind(Manifest& /*out*/, const HalfSpace& /*space*/) {}

void describe_kind(Manifest& out, const SurfacePointer& mesh_surface) {
  const flexbody::ContactSurface& surface = mesh_surface->surface();
  std::vector<double> faces;
  for (const auto& face : surface.faces) {
    faces.insert(faces.end(), face.begin(), face.end());
  }
  out.add("name", surface.name);
  out.add("nodes [m]", list_values(surface.x_B));
  out.add("modes", list_values(surface.Phi_B));
  out.add("residual [m/N]", list_values(surface.residual));
  out.add("patch radius [m]", list_values(surface.patch_radius));
  out.add("faces", faces);
}

double find_own_roundness(const Shape& shape) {
  return std::visit(
      [](const auto& kind) {
        using Kind = std::decay_t<decltype(kind)>;
        if constexpr (std::is_same_v<Kind, Box>) {
          return kind.half_size.minCoeff();
        } else if constexpr (std::is_same_v<Kind, Ellipsoid>) {
          return kind.radii.minCoeff();
        } else if constexpr (std::is_same_v<Kind, Cylinder> ||
                             std::is_same_v<Kind, Cone>) {
          return std::min(kind.radius, kind.half_length);
        } else if constexpr (std::is_same_v<Kind, HalfSpace>) {
          return 0.0;  // none
        } else if constexpr (std::is_same_v<Kind, SurfacePointer>) {
          return kind->surface().patch_radius.maxCoeff();
        } else {
          return kind.radius;
        }
      },
      shape.kind);
}

}  // namespace

void describe(Manifest& out, std::string_view name, const Shape& shape) {
  out.within(name, [&] {
    out.add("kind", name_kind(shape));
    std::visit([&](const auto& kind) { describe_kind(out, kind); }, shape.kind);
    out.add("position [m]", list_values(shape.X_BS.p));
    out.add("rotation", list_values(shape.X_BS.R));
  });
}

double find_roundness(const Shape& A, const Shape& B) {
  return std::max(find_own_roundness(A), find_own_roundness(B));
}

double find_size(const Shape& A, const Shape& B) {
  const double size_A = find_own_roundness(A);
  const double size_B = find_own_roundness(B);
  if (size_A == 0.0 || size_B == 0.0) return std::max(size_A, size_B);
  return std::min(size_A, size_B);
}

VectorX find_mode_reach(const Shape& shape) {
  const auto* mesh_surface = std::get_if<SurfacePointer>(&shape.kind);
  if (mesh_surface == nullptr) return VectorX::Zero(0);
  return (*mesh_surface)->find_mode_reach();
}

joints::TouchReach find_reach(const Shape& shape, const VectorX& mode_reach) {
  const VectorX still = VectorX::Zero(mode_reach.size());
  joints::PairBody body;
  body.modes = static_cast<int>(still.size());
  body.eta = body.etadot = still.data();
  return {find_extent(shape, body), mode_reach};
}

double find_own_speed(const Shape& shape, const VectorX& mode_reach,
                      const joints::PairBody& body) {
  const double angular_speed = body.w_WB_B.norm();
  double speed =
      angular_speed > 0.0 ? angular_speed * find_extent(shape, body) : 0.0;
  for (Eigen::Index k = 0; k < mode_reach.size(); ++k) {
    speed += mode_reach[k] * std::abs(body.etadot[k]);
  }
  return speed;
}

}  // namespace limber::contact
