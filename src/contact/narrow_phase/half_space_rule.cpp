// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "limber/common/overloaded.hpp"
#include "limber/contact/narrow_phase/pair_rules.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {
namespace {

using SkinPointer = std::shared_ptr<const Skin>;

// Largest number of touching nodes of a skin without pads.
constexpr std::size_t kMostNodes = 64;

// Points of a shape, with a ball about each.
struct Features {
  static constexpr std::size_t kMost = 8;
  std::array<Vector3, kMost> centres = {};  // the shape's frame [m]
  std::size_t count = 0;
  double radius = 0.0;     // of the balls [m]
  double curvature = 0.0;  // [1/m]

  void add(const Vector3& centre) { centres[count++] = centre; }
};

Features list_features(const Sphere& sphere, const Vector3& /*normal*/) {
  Features features{.radius = sphere.radius, .curvature = 1.0 / sphere.radius};
  features.add(Vector3::Zero());
  return features;
}

Features list_features(const Capsule& capsule, const Vector3& /*normal*/) {
  Features features{.radius = capsule.radius,
                    .curvature = 1.0 / capsule.radius};
  features.add({0.0, 0.0, capsule.half_length});
  features.add({0.0, 0.0, -capsule.half_length});
  return features;
}

// The lowest point of each rim and two more a third of a turn away. A lying
// cylinder touches with the lowest ones only, a standing one with all, whose
// net force and moment do not depend on their position on the rim.
Features list_features(const Cylinder& cylinder, const Vector3& normal) {
  const double slope = std::hypot(normal.x(), normal.y());
  const double x = slope > 0.0 ? -normal.x() / slope : 1.0;
  const double y = slope > 0.0 ? -normal.y() / slope : 0.0;
  Features features;
  for (const double end : {1.0, -1.0}) {
    for (const double turn : {0.0, 1.0 / 3.0, 2.0 / 3.0}) {
      const double cosine = std::cos(2.0 * std::numbers::pi * turn);
      const double sine = std::sin(2.0 * std::numbers::pi * turn);
      features.add({cylinder.radius * (cosine * x - sine * y),
                    cylinder.radius * (sine * x + cosine * y),
                    end * cylinder.half_length});
    }
  }
  return features;
}

Features list_features(const Box& box, const Vector3& /*normal*/) {
  Features features;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) {
        features.add(box.half_size.cwiseProduct(Vector3(x, y, z)));
      }
    }
  }
  return features;
}

// ShapePair has refused these.
Features list_features(const HalfSpace& /*shape*/, const Vector3& /*normal*/) {
  return {};
}

// The shape's balls against the plane of A.
void meet_features(const PlacedShape& A, const PlacedShape& B,
                   const Features& features, std::span<Meeting> out) {
  const Vector3 normal_W = A.X_WS.R.col(2);
  const Vector3 down_S = -features.radius * (B.X_WS.R.transpose() * normal_W);
  for (std::size_t i = 0; i < features.count; ++i) {
    const Vector3 lowest_S = features.centres[i] + down_S;
    const Vector3 lowest_W = B.X_WS * lowest_S;
    const double depth = -normal_W.dot(lowest_W - A.X_WS.p);
    const Vector3 on_plane_W = lowest_W + depth * normal_W;
    out[i] = {.depth = depth,
              .normal_W = normal_W,
              .p_W = 0.5 * (lowest_W + on_plane_W),
              .on_A = A.make_place(A.X_WS.inverse() * on_plane_W),
              .on_B = B.make_place(lowest_S),
              .curvature = features.curvature};
  }
}

Skin::Plane find_plane(const PlacedShape& A, const PlacedShape& B) {
  const Vector3 normal_W = A.X_WS.R.col(2);
  return {B.X_WB.R.transpose() * normal_W, normal_W.dot(A.X_WS.p - B.X_WB.p)};
}

void meet_pads(const PlacedShape& A, const PlacedShape& B, const Skin& skin,
               std::span<Meeting> out) {
  const Vector3 normal_W = A.X_WS.R.col(2);
  const ModalView eta = find_modal_coordinates(skin, B.body);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Skin::PadHit hit = skin.find_pad(i, eta);
    const Vector3 x_W = B.X_WB * hit.x;
    const double depth = -normal_W.dot(x_W - A.X_WS.p);
    const Vector3 on_plane_W = x_W + depth * normal_W;
    out[i] = {.depth = depth,
              .normal_W = normal_W,
              .p_W = 0.5 * (x_W + on_plane_W),
              .on_A = A.make_place(A.X_WS.inverse() * on_plane_W),
              .on_B = hit.place};
  }
}

// If `out` has too little room, it gets the deepest nodes.
void meet_skin(const PlacedShape& A, const PlacedShape& B, const Skin& skin,
               double reach, std::span<Meeting> out) {
  if (skin.pad_count() > 0) {
    meet_pads(A, B, skin, out);
    return;
  }
  for (Meeting& meeting : out) meeting.depth = Meeting{}.depth;
  const Vector3 normal_W = A.X_WS.R.col(2);
  const bool has_room = out.size() >= skin.node_count();
  const auto is_less = [](const Meeting& a, const Meeting& b) {
    return a.depth < b.depth;
  };
  auto least = out.begin();
  const auto find_slot = [&](const Skin::NodeHit& hit) -> Meeting* {
    if (has_room) return &out[hit.node];
    return -hit.height > least->depth ? &*least : nullptr;
  };
  skin.visit_nodes_below(
      find_plane(A, B), find_modal_coordinates(skin, B.body), reach,
      [&](const Skin::NodeHit& hit) {
        Meeting* const slot = find_slot(hit);
        if (slot == nullptr) return;
        const Vector3 x_W = B.X_WB * hit.x;
        const Vector3 on_plane_W = x_W - hit.height * normal_W;
        *slot = {.depth = -hit.height,
                 .normal_W = normal_W,
                 .p_W = 0.5 * (x_W + on_plane_W),
                 .on_A = A.make_place(A.X_WS.inverse() * on_plane_W),
                 .on_B = hit.place,
                 .curvature = std::max(0.0, hit.curvature)};
        if (!has_room)
          least = std::min_element(out.begin(), out.end(), is_less);
      });
}

double find_pad_clearance(const PlacedShape& A, const PlacedShape& B,
                          const Skin& skin) {
  const Skin::Plane plane = find_plane(A, B);
  const ModalView eta = find_modal_coordinates(skin, B.body);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < skin.pad_count(); ++i) {
    least = std::min(least,
                     plane.normal.dot(skin.find_pad(i, eta).x) - plane.offset);
  }
  return least;
}

Features find_features(const PlacedShape& A, const PlacedShape& B) {
  const Vector3 normal_S = B.X_WS.R.transpose() * A.X_WS.R.col(2);
  return std::visit(Overloaded{[](const SkinPointer&) { return Features{}; },
                               [&normal_S](const auto& shape) {
                                 return list_features(shape, normal_S);
                               }},
                    B.shape.kind);
}

}  // namespace

std::size_t count_half_space_features(const Shape& B) {
  return std::visit(
      Overloaded{[](const SkinPointer& skin) {
                   return skin->pad_count() > 0
                              ? skin->pad_count()
                              : std::min(skin->node_count(), kMostNodes);
                 },
                 [](const auto& shape) {
                   return list_features(shape, Vector3::UnitZ()).count;
                 }},
      B.kind);
}

bool has_loose_features_on_plane(const Shape& B) {
  const auto* skin = std::get_if<SkinPointer>(&B.kind);
  return skin != nullptr && (*skin)->pad_count() == 0 &&
         (*skin)->node_count() > kMostNodes;
}

void meet_half_space(const PlacedShape& A, const PlacedShape& B, double reach,
                     std::span<Meeting> out) {
  if (const auto* skin = std::get_if<SkinPointer>(&B.shape.kind)) {
    meet_skin(A, B, **skin, reach, out);
    return;
  }
  meet_features(A, B, find_features(A, B), out);
}

double find_half_space_clearance(const PlacedShape& A, const PlacedShape& B) {
  if (const auto* skin = std::get_if<SkinPointer>(&B.shape.kind)) {
    if ((*skin)->pad_count() > 0) return find_pad_clearance(A, B, **skin);
    return (*skin)->find_lowest_height(find_plane(A, B),
                                       find_modal_coordinates(**skin, B.body));
  }
  std::array<Meeting, Features::kMost> meetings;
  const Features features = find_features(A, B);
  meet_features(A, B, features, meetings);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < features.count; ++i) {
    least = std::min(least, -meetings[i].depth);
  }
  return least;
}

}  // namespace limber::contact
