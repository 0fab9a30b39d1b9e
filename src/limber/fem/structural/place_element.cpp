// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/place_element.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/structural/shell_element.hpp"

namespace limber::fem {
namespace {

BeamShape find_shape(const Structure& structure, const StructureBeam& beam) {
  return {{structure.x.col(beam.nodes[0]), structure.x.col(beam.nodes[1])},
          beam.offsets,
          beam.up};
}

Vector3 find_axis(const StructureShell& shell, const Matrix3X& x) {
  const Vector3 side = x.col(1) - x.col(0);
  Vector3 axis = shell.axis.isZero(0.0) ? side : shell.axis;
  if (shell.angle == 0.0) return axis;
  const Vector3 n = side.cross(Vector3(x.col(x.cols() - 1) - x.col(0)));
  return exp_rotation(shell.angle * n.normalized()) *
         Vector3(axis - n * n.dot(axis) / n.squaredNorm());
}

}  // namespace

StructuralElement make_element(const Structure& structure,
                               const StructureBeam& beam) {
  const BeamProperty& property =
      structure.beam_properties[index(beam.property)];
  try {
    return make_beam(find_shape(structure, beam), property.section,
                     property.material);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", beam.place, error.what()));
  }
}

StructuralElement make_element(const Structure& structure,
                               const StructureShell& shell) {
  const Matrix3X x = structure.x(Eigen::all, shell.nodes);
  const Laminate laminate = find_laminate(structure, shell);
  const ShellShape shape{x, find_axis(shell, x)};
  try {
    return shell.nodes.size() == 3 ? make_triangle_shell(shape, laminate)
                                   : make_quad_shell(shape, laminate);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", shell.place, error.what()));
  }
}

Laminate find_laminate(const Structure& structure,
                       const StructureShell& shell) {
  return shift_laminate(structure.laminates[index(shell.laminate)],
                        shell.offset);
}

Matrix3 find_axes(const Structure& structure, const StructureBeam& beam) {
  return find_beam_axes(find_shape(structure, beam));
}

}  // namespace limber::fem
