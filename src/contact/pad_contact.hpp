// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "limber/contact/law/contact_parameters.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/contact/law/pad_law.hpp"
#include "limber/contact/narrow_phase/meeting.hpp"
#include "limber/contact/narrow_phase/shape_pair.hpp"
#include "limber/flexbody/model/contact_surface.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

/// Flat surfaces of flexible bodies on planes, faces and each other.
namespace limber::contact {

/// A shape and its material.
struct SurfaceSide {
  const Shape& shape;
  const std::optional<SurfaceMaterial>& material;
};

/// Forces of the pads of a flat surface, which are the first features of its
/// pair.
///
/// Equation   C = R + the compliance of a half space of the other side's
///            material + a thousandth of the diagonal D, that of the surface's
///            own half space or of R; + D_i (1 / share_i - 1); + N R' N^T for
///            another flat surface, with N the weights of its pads at the
///            opposite places, by the inverse square of their distance
/// Source     weights: [@shepard1968]
/// Limits     a box, a cylinder or a mesh has the compliance of a half space;
///            the derivative of V neglects the change of N with the places
class PadContact {
 public:
  /// @returns none for a pair without pads.
  /// @throws InputError for parameters that pads do not have.
  [[nodiscard]] static std::optional<PadContact> make(
      const ShapePair& shapes, const SurfaceSide& A, const SurfaceSide& B,
      const ContactParameters& parameters);

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(law_.count());
  }
  /// [m^2]
  [[nodiscard]] double area(std::size_t pad) const {
    return area_[static_cast<Eigen::Index>(pad)];
  }
  [[nodiscard]] const PadLaw& law() const { return law_; }

  /// @param meetings of all features of the pair
  /// @param out filled without allocation
  void evaluate(std::span<const Meeting> meetings, PadLaw::Response& out) const;

 private:
  PadContact(PadLaw law, const flexbody::ContactPads& pads, VectorX own);
  [[nodiscard]] PadLaw::Matrix find_opposite_compliance(
      std::span<const Meeting> pads) const;

  PadLaw law_;
  VectorX area_;           // [m^2]
  VectorX own_;            // D [m/N]
  bool is_on_A_ = false;   // whose pads they are
  Matrix3X opposite_x_B_;  // 3 x k' pads of the other side, or none [m]
  MatrixX opposite_;       // R', k' x k' [m/N]
};

/// The pads that touch, in the order of a response's points.
class CoupledPads {
 public:
  /// @param point index in the response
  /// @param by_elastic_W as in PointResponse
  void add(std::size_t point, std::size_t pad, const Vector3& by_elastic_W,
           const Vector3& normal_W) {
    all_[count_++] = {point, static_cast<Eigen::Index>(pad), by_elastic_W,
                      normal_W};
  }
  /// Sets the coupling of the points' forces through their depths.
  void couple(const PadLaw::Response& pads, joints::PairResponse& out) const {
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < count_; ++j) {
        if (j == i) continue;
        out.coupling(all_[i].point, all_[j].point) =
            all_[i].by_elastic_W * (pads.stiffness(all_[i].pad, all_[j].pad) *
                                    all_[j].normal_W.transpose());
      }
    }
  }

 private:
  struct Point {
    std::size_t point = 0;
    Eigen::Index pad = 0;
    Vector3 by_elastic_W = Vector3::Zero();
    Vector3 normal_W = Vector3::Zero();
  };
  std::array<Point, PadLaw::kMost> all_;
  std::size_t count_ = 0;
};

}  // namespace limber::contact
