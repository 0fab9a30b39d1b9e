// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"
#include "limber/flexbody/model/contact_surface.hpp"

namespace limber::contact {

/// A surface of straight or quadratic triangles that deforms with its body's
/// modes. Immutable; bodies with the same reduction share it.
class Skin {
 public:
  /// @throws InputError, with the surface's name, for sizes that do not fit,
  /// rows out of range, values that are not finite, or faces without area.
  explicit Skin(flexbody::ContactSurface surface);

  [[nodiscard]] const flexbody::ContactSurface& surface() const {
    return surface_;
  }
  [[nodiscard]] int mode_count() const {
    return static_cast<int>(surface_.Phi_B.cols());
  }

 private:
  flexbody::ContactSurface surface_;
};

}  // namespace limber::contact
