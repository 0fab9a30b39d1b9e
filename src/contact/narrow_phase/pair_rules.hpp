// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/contact/narrow_phase/meeting.hpp"
#include "limber/contact/narrow_phase/placed_shape.hpp"

/// The rules of ShapePair, with A the sphere or half space.
namespace limber::contact {

/// Of a sphere with any shape.
///
/// Equation   depth = radius - distance of the centre from B's surface
[[nodiscard]] Meeting meet_sphere(const PlacedShape& A, const PlacedShape& B,
                                  double reach);
/// A lower bound of the distance; < 0 if they overlap [m].
[[nodiscard]] double find_sphere_clearance(const PlacedShape& A,
                                           const PlacedShape& B);

/// Features of two skins: the deepest places of their overlap that are
/// distinct, the deepest first, at most this number (SkinPairSearch).
///
/// Equation   depth = overlap along the common normal of both places
/// Limits     the order of a contact's features changes with the motion
inline constexpr std::size_t kSkinFeatures = 8;
void meet_skins(const PlacedShape& A, const PlacedShape& B, double reach,
                std::span<Meeting> out);
/// The corner of a face of either that is deepest inside the other, at any
/// depth; depth -infinity if there is none. Slow.
[[nodiscard]] Meeting find_enclosed_corner(const PlacedShape& A,
                                           const PlacedShape& B);
/// A lower bound of the distance, the distance itself unless it is large; < 0
/// if they overlap, a bound of the depth [m].
[[nodiscard]] double find_skins_clearance(const PlacedShape& A,
                                          const PlacedShape& B);

/// The shape as a surface with pads; null for all others.
[[nodiscard]] const Skin* find_flat(const Shape& shape);
/// Largest number of pads with which a flat surface touches others than planes.
inline constexpr std::size_t kMostPads = 25;
/// Whether A is a flat surface with so many pads at most, and B a box, a
/// cylinder or such a surface that is not smaller.
[[nodiscard]] bool is_flat_pair(const Shape& A, const Shape& B);
/// Features of A's pads with the face, or the end, of B that faces them.
///
/// Equation   depth = -height of the pad over B's surface along B's normal;
///            share = 1 - what the pad's node is beyond B's rim / the pad's
///            radius, times 1 up to a tilt of 30 degrees and 0 from 45
///            degrees on, linear in its cosine, and times 0 where B's rim is
///            pressed into A: where the plane of B's face goes deeper than B
///            by 2 % of the root of A's area, 1 up to 1 %
/// Limits     the plane of B's face is extended up to that distance beyond the
///            rim. A pad deeper than the thickness of B, or than the root of
///            A's area, is behind B and does not touch.
/// @param out one a pad
void meet_pads_on_face(const PlacedShape& A, const PlacedShape& B, double reach,
                       std::span<Meeting> out);
/// Reduces the shares of A's other places to what the pads do not cover:
/// corners and edges between pads that are deeper than all of them.
///
/// Equation   share (1 - hold) deeper: hold is 1 up to half of a pad's radius
///            from a line between two covered pads, 0 from 1.5 of it on;
///            deeper is 0 at the depth of the deepest pad, 1 where that is a
///            tenth less
/// @param A whose pads they are
void take_what_pads_miss(const Shape& A, std::span<const Meeting> pads,
                         std::span<Meeting> others);

/// Features of a skin B with a half space: its pads, or else its nodes.
///
/// Equation   depth = -height
[[nodiscard]] std::size_t count_half_space_features(const Skin& B);
/// Whether they are only the deepest of a larger number.
[[nodiscard]] bool has_loose_features_on_plane(const Skin& B);
void meet_half_space(const PlacedShape& A, const PlacedShape& B, double reach,
                     std::span<Meeting> out);
/// The distance; < 0 if they overlap [m].
[[nodiscard]] double find_half_space_clearance(const PlacedShape& A,
                                               const PlacedShape& B);

}  // namespace limber::contact
