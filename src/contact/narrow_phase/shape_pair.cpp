// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/shape_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/contact/narrow_phase/pair_rules.hpp"
#include "limber/contact/shapes/shape_skin.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {
namespace {

template <class Kind>
bool is_a(const Shape& shape) {
  return std::holds_alternative<Kind>(shape.kind);
}

bool is_convex(const Shape& shape) {
  return is_a<Box>(shape) || is_a<Cylinder>(shape) || is_a<Capsule>(shape);
}

bool is_skin(const Shape& shape) {
  return is_a<std::shared_ptr<const Skin>>(shape);
}

bool meets_spheres(const Shape& shape) {
  return !is_a<Box>(shape) && !is_a<Cylinder>(shape);
}

double find_deepest(std::span<const Meeting> meetings) {
  double deepest = -kInfinity;
  for (const Meeting& meeting : meetings) {
    deepest = std::max(deepest, meeting.depth);
  }
  return deepest;
}

bool has_skin(const Shape& shape) { return is_skin(shape) || is_convex(shape); }

}  // namespace

ShapePair::ShapePair(const Shape& A, const Shape& B, bool with_pads)
    : A_(A), B_(B) {
  check_shape(A_);
  check_shape(B_);
  if ((is_a<Sphere>(A_) && meets_spheres(B_)) ||
      (is_a<Sphere>(B_) && meets_spheres(A_))) {
    rule_ = Rule::kSphere;
    is_swapped_ = !is_a<Sphere>(A_);
  } else if ((is_a<HalfSpace>(A_) && is_skin(B_)) ||
             (is_a<HalfSpace>(B_) && is_skin(A_))) {
    rule_ = Rule::kHalfSpace;
    is_swapped_ = is_a<HalfSpace>(B_);
    const Skin& skin =
        *std::get<std::shared_ptr<const Skin>>((is_swapped_ ? A_ : B_).kind);
    most_points_ = count_half_space_features(skin);
    is_loose_ = has_loose_features_on_plane(skin);
    pad_count_ = skin.pad_count();
    has_pads_on_A_ = is_swapped_;
  } else if ((is_skin(A_) && has_skin(B_)) || (is_skin(B_) && has_skin(A_))) {
    rule_ = Rule::kSkins;
    skin_A_ = make_skin(A_);
    skin_B_ = make_skin(B_);
    unordered_count_ = kSkinFeatures;
    if (with_pads && (is_flat_pair(A_, B_) || is_flat_pair(B_, A_))) {
      rule_ = Rule::kFlat;
      is_swapped_ = !is_flat_pair(A_, B_);
      has_pads_on_A_ = !is_swapped_;
      pad_count_ = find_flat(is_swapped_ ? B_ : A_)->pad_count();
    }
    most_points_ = pad_count_ + unordered_count_;
  } else {
    throw InputError(
        fmt::format("contact: a {} and a {} do not touch at points",
                    name_kind(A_), name_kind(B_)));
  }
}

void ShapePair::find(const joints::PairBodies& bodies, double reach,
                     std::span<Meeting> out) const {
  LIMBER_EXPECT(out.size() == most_points_);
  const PlacedShape A(A_, bodies.A);
  const PlacedShape B(B_, bodies.B);
  const PlacedShape& first = is_swapped_ ? B : A;
  const PlacedShape& second = is_swapped_ ? A : B;
  switch (rule_) {
    case Rule::kSphere:
      out[0] = meet_sphere(first, second, reach);
      break;
    case Rule::kHalfSpace:
      meet_half_space(first, second, reach, out);
      break;
    case Rule::kFlat:
      meet_flat(first, second, bodies, reach, out);
      break;
    case Rule::kSkins:
      meet_skins(PlacedShape(skin_A_, bodies.A), PlacedShape(skin_B_, bodies.B),
                 reach, out);
      break;
  }
  if (!is_swapped_) return;
  for (Meeting& meeting : out) {
    meeting.normal_W = -meeting.normal_W;
    std::swap(meeting.on_A, meeting.on_B);
  }
}

void ShapePair::meet_flat(const PlacedShape& padded, const PlacedShape& face,
                          const joints::PairBodies& bodies, double reach,
                          std::span<Meeting> out) const {
  const std::span<Meeting> pads = out.first(pad_count_);
  // Pads that do not touch yet also represent places that do.
  meet_pads_on_face(padded, face, kInfinity, pads);
  const std::span<Meeting> others = out.subspan(pad_count_);
  const PlacedShape skin_A(skin_A_, bodies.A);
  const PlacedShape skin_B(skin_B_, bodies.B);
  if (is_swapped_) {
    meet_skins(skin_B, skin_A, reach, others);
  } else {
    meet_skins(skin_A, skin_B, reach, others);
  }
  take_what_pads_miss(padded.shape, pads, others);
}

double ShapePair::find_flat_clearance(const PlacedShape& padded,
                                      const PlacedShape& face,
                                      const joints::PairBodies& bodies) const {
  const double distance = find_skins_clearance(PlacedShape(skin_A_, bodies.A),
                                               PlacedShape(skin_B_, bodies.B));
  std::array<Meeting, kMostPads + kSkinFeatures> all;
  const auto pads = std::span(all).first(pad_count_);
  if (distance > 0.0) {
    meet_pads_on_face(padded, face, distance, pads);
    return std::min(distance, -find_deepest(pads));
  }
  // If pads represent the place at which the surfaces touch.
  const auto features = std::span(all).first(most_points_);
  meet_flat(padded, face, bodies, kInfinity, features);
  return -find_deepest(features);
}

Meeting ShapePair::find_enclosed(const joints::PairBodies& bodies) const {
  if (unordered_count_ == 0) return {};
  return find_enclosed_corner(PlacedShape(skin_A_, bodies.A),
                              PlacedShape(skin_B_, bodies.B));
}

double ShapePair::find_clearance(const joints::PairBodies& bodies) const {
  const PlacedShape A(A_, bodies.A);
  const PlacedShape B(B_, bodies.B);
  const PlacedShape& first = is_swapped_ ? B : A;
  const PlacedShape& second = is_swapped_ ? A : B;
  double distance = 0.0;
  switch (rule_) {
    case Rule::kSphere:
      distance = find_sphere_clearance(first, second);
      break;
    case Rule::kHalfSpace:
      distance = find_half_space_clearance(first, second);
      break;
    case Rule::kFlat:
      distance = find_flat_clearance(first, second, bodies);
      break;
    case Rule::kSkins:
      distance = find_skins_clearance(PlacedShape(skin_A_, bodies.A),
                                      PlacedShape(skin_B_, bodies.B));
      break;
  }
  return distance > 0.0 ? distance : 0.0;
}

}  // namespace limber::contact
