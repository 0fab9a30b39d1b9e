// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/beam_element.hpp"

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::fem {
namespace {

using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Row12 = Eigen::Matrix<double, 3, 12>;

/// Bending in one plane: deflection and rotation of both ends.
struct BendingPlane {
  std::array<int, 4> places;  ///< v_a, theta_a, v_b, theta_b
  double sign;                ///< of the rotation that lifts the far end
  double stiffness;           ///< E I
  double phi;                 ///< 12 E I / (k G A L^2)
};

/// Rotates the section to its principal axes.
BeamSection take_principal(const BeamSection& section, Matrix3& axes) {
  if (section.I_yz == 0.0) return section;
  const double angle =
      0.5 * std::atan2(2.0 * section.I_yz, section.I_z - section.I_y);
  const Vector3 y = axes.col(1);
  const Vector3 z = axes.col(2);
  axes.col(1) = std::cos(angle) * y + std::sin(angle) * z;
  axes.col(2) = std::cos(angle) * z - std::sin(angle) * y;
  const double mean = 0.5 * (section.I_y + section.I_z);
  const double radius =
      std::hypot(0.5 * (section.I_z - section.I_y), section.I_yz);
  BeamSection principal = section;
  principal.I_z = mean + radius;
  principal.I_y = mean - radius;
  principal.I_yz = 0.0;
  return principal;
}

Matrix12 make_stiffness(double L, double axial, double torsion,
                        const std::array<BendingPlane, 2>& planes) {
  Matrix12 K = Matrix12::Zero();
  const auto add_spring = [&](int i, double k) {
    K(i, i) += k;
    K(i + 6, i + 6) += k;
    K(i, i + 6) -= k;
    K(i + 6, i) -= k;
  };
  add_spring(0, axial / L);
  add_spring(3, torsion / L);
  for (const BendingPlane& plane : planes) {
    const double p = plane.phi;
    Eigen::Matrix4d k;
    k << 12.0, 6.0 * L, -12.0, 6.0 * L,                           //
        6.0 * L, (4.0 + p) * L * L, -6.0 * L, (2.0 - p) * L * L,  //
        -12.0, -6.0 * L, 12.0, -6.0 * L,                          //
        6.0 * L, (2.0 - p) * L * L, -6.0 * L, (4.0 + p) * L * L;
    k *= plane.stiffness / ((1.0 + p) * L * L * L);
    const Eigen::Vector4d sign(1.0, plane.sign, 1.0, plane.sign);
    K(plane.places, plane.places) += sign.asDiagonal() * k * sign.asDiagonal();
  }
  return K;
}

/// Displacement and rotation of the axis at s L.
struct AxisField {
  Row12 u = Row12::Zero();
  Row12 theta = Row12::Zero();
};

AxisField interpolate(double s, double L,
                      const std::array<BendingPlane, 2>& planes) {
  AxisField field;
  field.u(0, 0) = field.theta(0, 3) = 1.0 - s;
  field.u(0, 6) = field.theta(0, 9) = s;
  const double s2 = s * s;
  const double s3 = s2 * s;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const BendingPlane& plane = planes[i];
    const double p = plane.phi;
    const double f = 1.0 / (1.0 + p);
    const Eigen::RowVector4d v =
        f * Eigen::RowVector4d(1.0 - 3.0 * s2 + 2.0 * s3 + p * (1.0 - s),
                               L * (s - 2.0 * s2 + s3 + 0.5 * p * (s - s2)),
                               3.0 * s2 - 2.0 * s3 + p * s,
                               L * (s3 - s2 + 0.5 * p * (s2 - s)));
    const Eigen::RowVector4d r =
        f * Eigen::RowVector4d(6.0 / L * (s2 - s),
                               1.0 - 4.0 * s + 3.0 * s2 + p * (1.0 - s),
                               6.0 / L * (s - s2), 3.0 * s2 - 2.0 * s + p * s);
    const Eigen::RowVector4d sign(1.0, plane.sign, 1.0, plane.sign);
    const int component = i == 0 ? 1 : 2;
    field.u(component, plane.places) = v.cwiseProduct(sign);
    field.theta(3 - component, plane.places) =
        plane.sign * r.cwiseProduct(sign);
  }
  return field;
}

/// Points and weights of Gauss on [0, 1], four.
constexpr std::array<std::array<double, 2>, 4> kAlongBeam = {
    {{0.06943184420297371, 0.17392742256872692},
     {0.33000947820757187, 0.32607257743127307},
     {0.66999052179242813, 0.32607257743127307},
     {0.93056815579702629, 0.17392742256872692}}};

}  // namespace

Matrix3 find_beam_axes(const BeamShape& shape) {
  constexpr double kParallel = 1e-6;
  const Vector3 axis =
      shape.nodes[1] + shape.offsets[1] - shape.nodes[0] - shape.offsets[0];
  if (!(axis.norm() > 0.0))
    throw InputError("the beam has no length. Expected two different ends.");
  const Vector3 x = axis.normalized();
  const Vector3 y = shape.up - x * x.dot(shape.up);
  if (!(y.norm() > kParallel * shape.up.norm()))
    throw InputError(
        "the direction of its section is zero or along the beam. Expected one "
        "across it.");
  Matrix3 axes;
  axes << x, y.normalized(), x.cross(y.normalized());
  return axes;
}

StructuralElement make_beam(const BeamShape& shape, const BeamSection& given,
                            const BeamMaterial& material) {
  const Matrix3 given_axes = find_beam_axes(shape);
  Matrix3 axes = given_axes;
  const BeamSection section = take_principal(given, axes);
  const double L =
      (shape.nodes[1] + shape.offsets[1] - shape.nodes[0] - shape.offsets[0])
          .norm();
  const double E = material.youngs_modulus;
  const double GA = material.shear_modulus * section.area;
  const auto find_phi = [&](double I, double factor) {
    return factor > 0.0 ? 12.0 * E * I / (factor * GA * L * L) : 0.0;
  };
  const std::array<BendingPlane, 2> planes = {
      {{{1, 5, 7, 11},
        1.0,
        E * section.I_z,
        find_phi(section.I_z, section.shear_y)},
       {{2, 4, 8, 10},
        -1.0,
        E * section.I_y,
        find_phi(section.I_y, section.shear_z)}}};

  // From the nodes' unknowns to those of the ends of the axis, in its axes.
  Matrix12 T = Matrix12::Zero();
  for (int end = 0; end < 2; ++end) {
    const int at = 6 * end;
    T.block<3, 3>(at, at) = T.block<3, 3>(at + 3, at + 3) = axes.transpose();
    T.block<3, 3>(at, at + 3) =
        -axes.transpose() * skew(shape.offsets[static_cast<std::size_t>(end)]);
  }
  const Matrix12 forces =
      make_stiffness(L, E * section.area,
                     material.shear_modulus * section.torsion, planes) *
      T;
  StructuralElement element;
  element.K = T.transpose() * forces;
  const Matrix3 rotation = given_axes.transpose() * axes;
  element.section_forces.resize(12, 12);
  for (int row = 0; row < 12; row += 3)
    element.section_forces.middleRows<3>(row) =
        (row < 6 ? -1.0 : 1.0) * rotation * forces.middleRows<3>(row);

  // Four points at each place have the section's second moments.
  const double solid = material.density * section.area;
  const double line = solid + section.extra_mass;
  if (!(line > 0.0)) return element;
  const double y = std::sqrt(material.density * section.I_z / line);
  const double z = std::sqrt(material.density * section.I_y / line);
  for (const auto& [s, weight] : kAlongBeam) {
    const AxisField field = interpolate(s, L, planes);
    for (const double side : {-1.0, 1.0})
      for (const double other : {-1.0, 1.0}) {
        const Vector3 d(0.0, side * y, other * z);
        const Row12 N = field.u - skew(d) * field.theta;
        element.points.push_back({0.25 * line * L * weight, axes * N * T});
      }
  }
  return element;
}

}  // namespace limber::fem
