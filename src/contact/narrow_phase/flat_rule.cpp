// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "limber/contact/narrow_phase/pair_rules.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {
namespace {

// Cosines of the angles between two faces up to which pads count fully, and
// from which on they do not count [-].
struct TiltRange {
  double all;
  double none;

  [[nodiscard]] double find_share(double cosine) const {
    return std::clamp((cosine - none) / (all - none), 0.0, 1.0);
  }
};
// 30 and 45 degrees: for pads that are all over the other face.
constexpr TiltRange kCoveredTilt{0.5 * std::numbers::sqrt3,
                                 0.5 * std::numbers::sqrt2};
// 0.5 and 1 degree where the other face's rim is over pads: the face of a
// linear body deforms by a hundredth of its width at most, so that at larger
// tilts only corners and edges touch.
constexpr TiltRange kRimTilt{0.99996192, 0.99984770};
// Smallest cover of all pads from which on they begin to count as all over the
// other face [-].
constexpr double kWithin = 0.9;
// Shares up to this are round-off.
constexpr double kNoCover = 1e-9;
// A place between pads counts if it is deeper than the deepest pad, fully from
// this part of its depth on [-].
constexpr double kDeeper = 0.1;
// Distance from the line between two pads' nodes, relative to a pad's radius,
// up to which the pads represent a place; one radius farther they do not [-].
constexpr double kOfPad = 1.0;
// Share from which on a pad represents the places next to it [-].
constexpr double kCovered = 0.1;

double find_radius(const flexbody::ContactPads& pads, Eigen::Index pad) {
  return std::sqrt(pads.area[pad] / std::numbers::pi);
}

// The part of a flat side opposite to a point.
struct OppositeFace {
  Vector3 normal_W = Vector3::UnitZ();  // unit, outward [-]
  Vector3 p_W = Vector3::Zero();        // its point there, or on its rim [m]
  SurfacePlace place;
  // Thickness of the body behind it [m].
  double thickness = std::numeric_limits<double>::infinity();
};

// The face of a box or end of a cylinder that faces against a
// direction.
std::optional<OppositeFace> find_opposite(const PlacedShape& shape,
                                          const Vector3& p_W,
                                          const Vector3& way_W) {
  const Vector3 way = shape.X_WS.R.transpose() * way_W;
  Vector3 p = shape.X_WS.inverse() * p_W;
  int axis = 2;
  double height = 0.0;
  if (const auto* box = std::get_if<Box>(&shape.shape.kind)) {
    way.cwiseAbs().maxCoeff(&axis);
    height = box->half_size[axis];
    p = p.cwiseMax(-box->half_size).cwiseMin(box->half_size);
  } else {
    const auto* rod = std::get_if<Cylinder>(&shape.shape.kind);
    if (rod == nullptr) return std::nullopt;
    height = rod->half_length;
    const double far = std::hypot(p.x(), p.y());
    if (far > rod->radius) p *= rod->radius / far;
  }
  const double side = way[axis] > 0.0 ? -1.0 : 1.0;
  p[axis] = side * height;
  return OppositeFace{side * shape.X_WS.R.col(axis), shape.X_WS * p,
                      shape.make_place(p), 2.0 * height};
}

double sum_area(const Skin& skin) { return skin.surface().pads.area.sum(); }

// Pads that are deeper are behind the other side, not in it.
double find_width(const Skin& skin) { return std::sqrt(sum_area(skin)); }

// A flat surface at the pose of its body.
struct FlatSide {
  FlatSide(const PlacedShape& shape_, const Skin& skin_)
      : shape(shape_),
        skin(skin_),
        eta(find_modal_coordinates(skin_, shape_.body)),
        normal_W(shape_.X_WB.R * skin_.find_mean_normal(eta)) {}

  const PlacedShape& shape;
  const Skin& skin;
  ModalView eta;
  Vector3 normal_W;  // of its mean plane, unit, outward [-]
};

// For a deformed flat surface. @param reach of points beyond its rim [m]
std::optional<OppositeFace> find_opposite(const FlatSide& side,
                                          const Vector3& p_W, double reach) {
  const auto hit = side.skin.find_nearest(
      side.shape.X_WB.inverse() * p_W, side.eta, reach, find_width(side.skin));
  if (!hit || !std::isfinite(hit->nearest.distance)) return std::nullopt;
  return OppositeFace{side.normal_W, side.shape.X_WB * hit->nearest.point,
                      hit->place};
}

// Part of a pad over the other side, from the distance of its node beyond the
// rim.
double find_cover(double beyond, double radius) {
  return std::clamp(1.0 - beyond / radius, 0.0, 1.0);
}

// The pads that are over the other side.
class CoveredPads {
 public:
  CoveredPads(const flexbody::ContactPads& pads,
              std::span<const Meeting> meetings) {
    for (std::size_t i = 0; i < meetings.size(); ++i) {
      const Meeting& meeting = meetings[i];
      if (meeting.depth == Meeting{}.depth) continue;
      const auto pad = static_cast<Eigen::Index>(i);
      all_[count_++] = {pads.x_B.col(pad), find_radius(pads, pad),
                        std::min(meeting.share / kCovered, 1.0)};
      deepest_ = std::max(deepest_, meeting.share * meeting.depth);
    }
  }

  // The largest share times depth, at least 0 [m].
  [[nodiscard]] double deepest() const { return deepest_; }

  // How far they represent a place: 1 on the line between two of them.
  [[nodiscard]] double find_hold(const Vector3& x_B) const {
    double hold = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = i; j < count_; ++j) {
        const Pad& a = all_[i];
        const Pad& b = all_[j];
        const Vector3 way = b.x_B - a.x_B;
        const double square = way.squaredNorm();
        const double along = square > 0.0 ? way.dot(x_B - a.x_B) / square : 0.0;
        const double t = std::clamp(along, 0.0, 1.0);
        const double far = (x_B - a.x_B - t * way).norm();
        const double near = 1.0 + kOfPad - far / std::min(a.radius, b.radius);
        hold = std::max(
            hold, std::min(a.cover, b.cover) * std::clamp(near, 0.0, 1.0));
      }
    }
    return hold;
  }

 private:
  struct Pad {
    Vector3 x_B;
    double radius = 0.0;  // [m]
    double cover = 0.0;   // 1 from kCovered on [-]
  };
  std::array<Pad, kMostPads> all_;
  std::size_t count_ = 0;
  double deepest_ = 0.0;  // [m]
};

// A pad of A and the opposite point of B. If the pad's node is beyond B's rim,
// the part over B counts, where the rim is on A's plane.
//
// @param other B if it is a flat surface, too
Meeting meet_pad(const FlatSide& A, std::size_t i, const PlacedShape& B,
                 const std::optional<FlatSide>& other, double reach) {
  const Skin::PadHit hit = A.skin.find_pad(i, A.eta);
  const Vector3 p_W = A.shape.X_WB * hit.x;
  const double radius =
      find_radius(A.skin.surface().pads, static_cast<Eigen::Index>(i));
  const auto found = other ? find_opposite(*other, p_W, reach + radius)
                           : find_opposite(B, p_W, A.normal_W);
  if (!found) return {};
  const Vector3 arm = p_W - found->p_W;
  const double height = found->normal_W.dot(arm);
  const double deepest = std::min(found->thickness, find_width(A.skin));
  const double beyond = (arm - height * found->normal_W).norm();
  const double cover = find_cover(beyond, radius);
  if (!(cover > kNoCover) || height > reach || -height > deepest) return {};
  // Mean of the node over B's plane and B's rim over A's.
  const Vector3 normal = (1.0 - cover) * A.normal_W - cover * found->normal_W;
  const double depth = (1.0 - cover) * A.normal_W.dot(arm) - cover * height;
  const Vector3 middle = found->p_W + 0.5 * depth * normal;
  return {.depth = depth,
          .normal_W = normal.normalized(),
          .p_W = middle,
          .on_A = hit.place,
          .on_B = found->place,
          .share = cover};
}

}  // namespace

const Skin* find_flat(const Shape& shape) {
  const auto* skin = std::get_if<std::shared_ptr<const Skin>>(&shape.kind);
  return skin != nullptr && (*skin)->pad_count() > 0 ? skin->get() : nullptr;
}

bool is_flat_pair(const Shape& A, const Shape& B) {
  const Skin* skin = find_flat(A);
  if (skin == nullptr || skin->pad_count() > kMostPads) return false;
  if (const Skin* other = find_flat(B))
    return sum_area(*skin) <= sum_area(*other);
  return std::holds_alternative<Box>(B.kind) ||
         std::holds_alternative<Cylinder>(B.kind);
}

void meet_pads_on_face(const PlacedShape& A, const PlacedShape& B, double reach,
                       std::span<Meeting> out) {
  const Skin& skin = *find_flat(A.shape);
  const FlatSide side(A, skin);
  std::optional<FlatSide> other;
  if (const Skin* flat = find_flat(B.shape)) other.emplace(B, *flat);
  double least_cover = 1.0;  // of all
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = meet_pad(side, i, B, other, reach);
    const bool is_over = out[i].depth > Meeting{}.depth;
    least_cover = std::min(least_cover, is_over ? out[i].share : 0.0);
  }
  const double cosine = -side.normal_W.dot(
      other ? other->normal_W
            : find_opposite(B, B.X_WS.p, side.normal_W)->normal_W);
  const double within =
      std::clamp((least_cover - kWithin) / (1.0 - kWithin), 0.0, 1.0);
  const double share = within * kCoveredTilt.find_share(cosine) +
                       (1.0 - within) * kRimTilt.find_share(cosine);
  for (Meeting& pad : out) {
    pad.share *= share;
    if (!(pad.share > kNoCover)) pad = {};
  }
}

void take_what_pads_miss(const Shape& A, std::span<const Meeting> pads,
                         std::span<Meeting> others) {
  const CoveredPads covered(find_flat(A)->surface().pads, pads);
  for (Meeting& meeting : others) {
    if (meeting.depth == Meeting{}.depth) continue;
    if (meeting.depth > 0.0) {
      const double deeper = (meeting.depth - covered.deepest()) / meeting.depth;
      meeting.share *= std::clamp(deeper / kDeeper, 0.0, 1.0);
    }
    if (meeting.share > kNoCover) {
      meeting.share *= 1.0 - covered.find_hold(meeting.on_A.x_B);
    }
    if (!(meeting.share > kNoCover)) meeting = {};
  }
}

}  // namespace limber::contact
