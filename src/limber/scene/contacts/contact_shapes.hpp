// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/law/contact_parameters.hpp"
#include "limber/contact/shapes/shape.hpp"
#include "limber/scene/robot/geometry.hpp"
#include "limber/scene/scenario/contact_spec.hpp"

/// Converts shapes of files to those of contacts.
namespace limber::scene {

/// @param geometry any but MeshGeometry and OtherGeometry
[[nodiscard]] contact::ShapeKind make_shape(const Geometry& geometry);

[[nodiscard]] contact::ContactParameters make_parameters(
    const ContactOptions& options);

}  // namespace limber::scene
