// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "limber/contact/narrow_phase/pair_rules.hpp"
#include "limber/contact/narrow_phase/skin_pair_search.hpp"

namespace limber::contact {
namespace {

DeformedSkin deform(const PlacedShape& shape) {
  const Skin& skin = *std::get<std::shared_ptr<const Skin>>(shape.shape.kind);
  return {skin, find_modal_coordinates(skin, shape.body)};
}

bool is_finite(const DeformedSkin& skin, const PlacedShape& shape) {
  return std::isfinite(skin.skin.find_ball(skin.eta).radius) &&
         shape.X_WB.p.allFinite() && shape.X_WB.R.allFinite();
}

// Distance of the balls about both.
double find_far(const DeformedSkin& A, const DeformedSkin& B,
                const Pose& X_AB) {
  const Skin::Ball ball_A = A.skin.find_ball(A.eta);
  const Skin::Ball ball_B = B.skin.find_ball(B.eta);
  return (X_AB * ball_B.centre - ball_A.centre).norm() - ball_A.radius -
         ball_B.radius;
}

Meeting make_skin_meeting(const SkinPairSearch::Feature& feature,
                          const DeformedSkin& A, const DeformedSkin& B,
                          const Pose& X_WA) {
  return {.depth = feature.at.depth,
          .normal_W = X_WA.R * feature.at.normal,
          .p_W = X_WA * feature.middle,
          .on_A = A.skin.make_place(feature.face_A, feature.at.on_A),
          .on_B = B.skin.make_place(feature.face_B, feature.at.on_B),
          .curvature = feature.curvature,
          .share = feature.share};
}

}  // namespace

void meet_skins(const PlacedShape& A, const PlacedShape& B, double reach,
                std::span<Meeting> out) {
  std::fill(out.begin(), out.end(), Meeting{});
  const DeformedSkin skin_A = deform(A);
  const DeformedSkin skin_B = deform(B);
  if (!is_finite(skin_A, A) || !is_finite(skin_B, B)) {
    out[0].depth = std::numeric_limits<double>::quiet_NaN();
    out[0].on_A = skin_A.skin.make_place(0, {});
    out[0].on_B = skin_B.skin.make_place(0, {});
    return;
  }
  const Pose X_AB = A.X_WB.inverse() * B.X_WB;
  if (find_far(skin_A, skin_B, X_AB) > reach) return;
  SkinPairSearch search(skin_A, skin_B, X_AB);
  search.run(reach);
  std::array<SkinPairSearch::Feature, kSkinFeatures> features;
  const std::size_t count =
      search.select(std::span(features).first(out.size()));
  for (std::size_t i = 0; i < count; ++i) {
    if (!(-features[i].at.depth <= reach)) continue;
    out[i] = make_skin_meeting(features[i], skin_A, skin_B, A.X_WB);
  }
}

Meeting find_enclosed_corner(const PlacedShape& A, const PlacedShape& B) {
  Meeting deepest;
  if (find_far(deform(A), deform(B), A.X_WB.inverse() * B.X_WB) > 0.0) {
    return deepest;
  }
  const auto look = [&deepest](const PlacedShape& from, const PlacedShape& in) {
    const DeformedSkin inner = deform(from);
    const DeformedSkin outer = deform(in);
    if (!outer.skin.is_closed()) return;
    const Pose X = in.X_WB.inverse() * from.X_WB;
    for (int f = 0; f < static_cast<int>(inner.skin.face_count()); ++f) {
      const FacePatch patch = inner.skin.make_patch(f, inner.eta, X);
      for (const FacePlace& corner : kFaceCorners) {
        const Vector3 p = patch.find_point(corner);
        const auto hit = outer.skin.find_nearest(p, outer.eta, 0.0, 0.0);
        if (!hit || !(-hit->nearest.distance > deepest.depth)) continue;
        deepest.depth = -hit->nearest.distance;
        deepest.p_W = in.X_WB * p;
      }
    }
  };
  look(A, B);
  look(B, A);
  return deepest;
}

double find_skins_clearance(const PlacedShape& A, const PlacedShape& B) {
  const DeformedSkin skin_A = deform(A);
  const DeformedSkin skin_B = deform(B);
  if (!is_finite(skin_A, A) || !is_finite(skin_B, B)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Pose X_AB = A.X_WB.inverse() * B.X_WB;
  const double far = find_far(skin_A, skin_B, X_AB);
  const double near = std::min(skin_A.skin.find_ball(skin_A.eta).radius,
                               skin_B.skin.find_ball(skin_B.eta).radius);
  if (far > near) return far;
  SkinPairSearch search(skin_A, skin_B, X_AB);
  // Close to the distance if that is large compared with the faces.
  const double gap = search.find_box_gap();
  if (gap > std::max(skin_A.skin.mean_edge(), skin_B.skin.mean_edge())) {
    return gap;
  }
  search.run_to_overlap(kInfinity);
  return search.deepest() > -kInfinity ? -search.deepest() : search.least_gap();
}

}  // namespace limber::contact
