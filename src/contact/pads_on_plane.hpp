// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "limber/contact/law/contact_parameters.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/contact/law/pad_law.hpp"
#include "limber/contact/shapes/meeting.hpp"
#include "limber/contact/shapes/shape.hpp"
#include "limber/flexbody/model/contact_surface.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

/// Flat surfaces of flexible bodies against half spaces.
namespace limber::contact {

/// A shape and what it is made of.
struct SurfaceSide {
  const Shape& shape;
  const std::optional<SurfaceMaterial>& material;
};

/// Those of a flat surface that meets a half space; null of all other pairs.
[[nodiscard]] const flexbody::ContactPads* find_pads(const Shape& A,
                                                     const Shape& B);

/// The law of such a pair, or none.
///
/// Equation   C = R + half space of the plane's material + a thousandth of the
///            diagonal of the surface's own as a half space, or of R
/// @throws InputError for parameters that a flat surface does not have.
[[nodiscard]] std::optional<PadLaw> make_pad_law(
    const SurfaceSide& A, const SurfaceSide& B,
    const ContactParameters& parameters);

[[nodiscard]] PadLaw::Vector list_depths(std::span<const Meeting> meetings);

/// The pads that touch, in the order of a response's points.
class CoupledPads {
 public:
  /// @param by_elastic_W as PointResponse's
  void add(std::size_t pad, const Vector3& by_elastic_W,
           const Vector3& normal_W) {
    all_[count_++] = {static_cast<Eigen::Index>(pad), by_elastic_W, normal_W};
  }
  /// Sets how the forces of the points follow each other's depths.
  void couple(const PadLaw::Response& pads, joints::PairResponse& out) const {
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < count_; ++j) {
        if (j == i) continue;
        out.coupling(i, j) =
            all_[i].by_elastic_W * (pads.stiffness(all_[i].pad, all_[j].pad) *
                                    all_[j].normal_W.transpose());
      }
    }
  }

 private:
  struct Point {
    Eigen::Index pad = 0;
    Vector3 by_elastic_W = Vector3::Zero();
    Vector3 normal_W = Vector3::Zero();
  };
  std::array<Point, PadLaw::kMost> all_;
  std::size_t count_ = 0;
};

}  // namespace limber::contact
