// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <random>

#include "limber/contact/shapes/mesh_surface.hpp"
#include "limber/flexbody/model/contact_surface.hpp"

namespace limber::contact::test {

/// A motion of space as a mode: displacement of x [kg^-1/2].
using Field = std::function<Vector3(const Vector3&)>;

/// Surfaces without modes.
/// @param quadratic with middle nodes, halfway or on the curved surface
flexbody::ContactSurface make_box_surface(const Vector3& half_size, int cells,
                                          bool quadratic);
flexbody::ContactSurface make_ball_surface(double radius, int subdivisions,
                                           bool quadratic);
/// |x|, |y| <= half_side, z = height(x, y), seen from above; has a border.
flexbody::ContactSurface make_sheet_surface(
    double half_side, int cells, bool quadratic,
    const std::function<double(double, double)>& height);

/// Gives it modes.
void set_modes(flexbody::ContactSurface& surface,
               const std::vector<Field>& fields);
/// Bending, twist, stretch and a wave.
std::vector<Field> make_fields();

ModalView view(const VectorX& eta);
Vector3 draw_point(std::mt19937& random, double half_side);
Matrix3 draw_rotation(std::mt19937& random);

/// In closed form. @param h half sizes of the box, about the origin
MeshSurface::NearestPoint find_nearest_of_box(const Vector3& h,
                                              const Vector3& p);

}  // namespace limber::contact::test
