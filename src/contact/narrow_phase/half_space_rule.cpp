// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <memory>

#include "limber/contact/narrow_phase/pair_rules.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {
namespace {

// Largest number of touching nodes of a skin without pads.
constexpr std::size_t kMostNodes = 64;

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
void meet_nodes(const PlacedShape& A, const PlacedShape& B, const Skin& skin,
                double reach, std::span<Meeting> out) {
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

const Skin& skin_of(const PlacedShape& B) {
  return *std::get<std::shared_ptr<const Skin>>(B.shape.kind);
}

}  // namespace

std::size_t count_half_space_features(const Skin& B) {
  return B.pad_count() > 0 ? B.pad_count()
                           : std::min(B.node_count(), kMostNodes);
}

bool has_loose_features_on_plane(const Skin& B) {
  return B.pad_count() == 0 && B.node_count() > kMostNodes;
}

void meet_half_space(const PlacedShape& A, const PlacedShape& B, double reach,
                     std::span<Meeting> out) {
  const Skin& skin = skin_of(B);
  if (skin.pad_count() > 0) {
    meet_pads(A, B, skin, out);
  } else {
    meet_nodes(A, B, skin, reach, out);
  }
}

double find_half_space_clearance(const PlacedShape& A, const PlacedShape& B) {
  const Skin& skin = skin_of(B);
  return skin.pad_count() > 0
             ? find_pad_clearance(A, B, skin)
             : skin.find_lowest_height(find_plane(A, B),
                                       find_modal_coordinates(skin, B.body));
}

}  // namespace limber::contact
