// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "limber/contact/potential/depth_field.hpp"
#include "limber/contact/potential/ruled_surface.hpp"

namespace limber::contact {

/// A convex body in its own frame, prepared for integrals over its surface and
/// over those of others within it. Immutable; copies share their data.
class RuledBody {
 public:
  /// @throws ContractError for a solid of more than SolidField::kMostFaces.
  explicit RuledBody(const BodyKind& body);

  [[nodiscard]] const DepthField& field() const { return data_->field; }
  /// Its surface, with the faces that do not press; nothing of a capsule or
  /// ball. That of a half space is as large as `soft`.
  /// @param X its pose in the frame of `soft`
  /// @param use (surface in the frame of `soft`, rows across the way in which
  /// the depth below it changes most)
  template <typename Use>
  void visit_surfaces(const Pose& X, const RuledBody& soft,
                      const Use& use) const {
    for (const RuledSurface& surface : data_->surfaces) {
      RuledSurface placed = place(surface, X, soft);
      if (!soft.is_reached(placed)) continue;
      soft.turn_rows(placed);
      use(placed);
    }
  }
  /// Whether its depth may count: not where some faces do not press.
  [[nodiscard]] bool is_soft() const { return data_->is_soft; }
  /// Where two of its faces are equally near, of a soft body.
  [[nodiscard]] const std::vector<RuledSurface>& sheets() const {
    return data_->sheets;
  }
  /// Whether the plane of a flat, and a ball about a surface, meet the body.
  [[nodiscard]] bool is_reached(const RuledSurface& surface) const;

 private:
  struct Data {
    explicit Data(const BodyKind& body) : field(body) {}

    DepthField field;
    double radius = 0.0;  // of a ball about its origin, 0 of a half space [m]
    bool is_soft = true;
    std::vector<RuledSurface> surfaces;
    std::vector<RuledSurface> sheets;
    std::vector<std::unique_ptr<std::vector<Eigen::Vector2d>>> outlines;
  };

  [[nodiscard]] RuledSurface place(const RuledSurface& surface, const Pose& X,
                                   const RuledBody& soft) const;
  // Of a surface of another, across the way in which the depth changes most.
  void turn_rows(RuledSurface& surface) const;

  std::shared_ptr<const Data> data_;
};

}  // namespace limber::contact
