// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/beam_element.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/fem/structural/shell_grid.hpp"

namespace limber::fem::structural_test {
namespace {

constexpr BeamMaterial kSteel = {2e11, 2e11 / 2.6, 7800.0};

MatrixX sum_mass(const StructuralElement& element) {
  MatrixX M = MatrixX::Zero(element.K.rows(), element.K.cols());
  for (const MassPoint& point : element.points)
    M += point.mass * point.N.transpose() * point.N;
  return M;
}

TEST(BeamSection, OfThinTubeAndSquareAreThoseOfTextbooks) {
  const BeamSection ring = make_tube(0.05, 0.049, 0.3);
  EXPECT_NEAR(ring.area, M_PI * (0.05 * 0.05 - 0.049 * 0.049), 1e-15);
  EXPECT_NEAR(ring.I_y, M_PI / 4.0 * (std::pow(0.05, 4) - std::pow(0.049, 4)),
              1e-18);
  // Cowper: thin ring 2 (1 + nu) / (4 + 3 nu), rectangle 10 (1 + nu) / (12 +
  // 11 nu), circle 6 (1 + nu) / (7 + 6 nu).
  EXPECT_NEAR(ring.shear_y, 2.6 / 4.9, 1e-3);
  EXPECT_NEAR(make_tube(1.0, 0.0, 0.3).shear_z, 7.8 / 8.8, 1e-12);
  EXPECT_NEAR(make_rectangle(1.0, 2.0, 0.3).shear_y, 13.0 / 15.3, 1e-12);
  // Timoshenko and Goodier, Theory of Elasticity, table of k1.
  EXPECT_NEAR(make_rectangle(1.0, 1.0, 0.3).torsion, 0.1406, 5e-5);
  EXPECT_NEAR(make_rectangle(1.0, 2.0, 0.3).torsion, 2.0 * 0.229, 1e-3);
  EXPECT_NEAR(make_rectangle(10.0, 1.0, 0.3).torsion, 10.0 * 0.312, 1e-2);
}

TEST(BeamSection, OfBoxAndIHaveAreaAndMomentsOfTheirParts) {
  const BeamSection box = make_box(0.1, 0.06, 0.003, 0.002, 0.3);
  EXPECT_NEAR(box.area, 2.0 * 0.06 * 0.003 + 2.0 * 0.094 * 0.002, 1e-15);
  // Two webs, and two flanges by Steiner.
  const double flange =
      0.06 * std::pow(0.003, 3) / 12.0 + 0.06 * 0.003 * 0.0485 * 0.0485;
  EXPECT_NEAR(box.I_z, 2.0 * flange + 2.0 * 0.002 * std::pow(0.094, 3) / 12.0,
              1e-18);
  const BeamSection beam = make_i_section(0.1, 0.06, 0.003, 0.002, 0.3);
  EXPECT_NEAR(beam.area, 2.0 * 0.06 * 0.003 + 0.094 * 0.002, 1e-15);
  EXPECT_NEAR(beam.I_z, 2.0 * flange + 0.002 * std::pow(0.094, 3) / 12.0,
              1e-18);
  // Shear along webs alone: somewhat less than all of them.
  EXPECT_LT(box.shear_y * box.area, 2.0 * 0.1 * 0.002);
  EXPECT_GT(box.shear_y * box.area, 0.8 * 2.0 * 0.094 * 0.002);
  EXPECT_LT(beam.shear_y * beam.area, 0.1 * 0.002);
  EXPECT_GT(beam.shear_y * beam.area, 0.8 * 0.094 * 0.002);
}

TEST(BeamElement, HasNoStiffnessAndTheInertiaOfABodyInRigidMotion) {
  BeamSection section = make_box(0.1, 0.06, 0.003, 0.002, 0.3);
  section.I_yz = 2e-7;
  section.extra_mass = 0.7;
  BeamShape shape;
  shape.nodes = {Vector3(0.2, -0.1, 0.4), Vector3(1.3, 1.2, -0.1)};
  shape.offsets = {Vector3(0.1, 0.2, 0.3), Vector3(0.0, 0.1, 0.1)};
  shape.up = {0.0, 0.1, 1.0};
  const StructuralElement element = make_beam(shape, section, kSteel);
  Matrix3X x(3, 2);
  x << shape.nodes[0], shape.nodes[1];
  const MatrixX X = make_rigid(x);
  EXPECT_LT((element.K * X).norm(), 1e-13 * element.K.norm());
  const Vector3 a = shape.nodes[0] + shape.offsets[0];
  const Vector3 b = shape.nodes[1] + shape.offsets[1];
  const double L = (b - a).norm();
  const double line = kSteel.density * section.area + section.extra_mass;
  const MatrixX inertia = X.transpose() * sum_mass(element) * X;
  EXPECT_NEAR(inertia(0, 0), line * L, 1e-12 * line * L);
  // Moments about the origin: those of the line and of the section along it.
  const Vector3 t = (b - a) / L;
  const Vector3 middle = 0.5 * (a + b);
  const double polar = kSteel.density * L * (section.I_y + section.I_z);
  const double about = t.dot(inertia.bottomRightCorner<3, 3>() * t);
  const double arm = (middle - t * t.dot(middle)).squaredNorm();
  EXPECT_NEAR(about, polar + line * L * arm, 1e-12 * about);
}

/// A cantilever of one element under forces and moments at its tip.
TEST(BeamElement, DeflectsAsTimoshenkosBeam) {
  const BeamSection section = make_rectangle(0.1, 0.06, 0.3);
  BeamShape shape;
  const double L = 0.5;
  shape.nodes = {Vector3::Zero(), Vector3(L, 0.0, 0.0)};
  const MatrixX K = make_beam(shape, section, kSteel).K.bottomRightCorner(6, 6);
  const MatrixX C = K.inverse();
  const double E = kSteel.youngs_modulus;
  const double GA = kSteel.shear_modulus * section.area;
  const auto expect = [&](int i, int j, double value) {
    EXPECT_NEAR(C(i, j), value, 1e-10 * std::abs(value)) << i << j;
  };
  expect(0, 0, L / (E * section.area));
  expect(1, 1,
         L * L * L / (3.0 * E * section.I_z) + L / (section.shear_y * GA));
  expect(2, 2,
         L * L * L / (3.0 * E * section.I_y) + L / (section.shear_z * GA));
  expect(5, 1, L * L / (2.0 * E * section.I_z));
  expect(4, 2, -L * L / (2.0 * E * section.I_y));
  expect(5, 5, L / (E * section.I_z));
  expect(3, 3, L / (kSteel.shear_modulus * section.torsion));
}

/// Unsymmetric bending: a section given in turned axes is the same beam.
TEST(BeamElement, OfAnObliqueSectionIsThatOfItsPrincipalAxes) {
  BeamSection principal = make_rectangle(0.1, 0.06, 0.3);
  principal.shear_y = principal.shear_z = 0.0;
  const double angle = 0.4;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  BeamSection oblique = principal;  // in axes turned back by the angle
  oblique.I_z = c * c * principal.I_z + s * s * principal.I_y;
  oblique.I_y = s * s * principal.I_z + c * c * principal.I_y;
  oblique.I_yz = c * s * (principal.I_z - principal.I_y);
  BeamShape turned;
  turned.nodes = {Vector3::Zero(), Vector3(0.7, 0.0, 0.0)};
  BeamShape own = turned;
  own.up = {0.0, c, s};
  const MatrixX A = make_beam(turned, oblique, kSteel).K;
  const MatrixX B = make_beam(own, principal, kSteel).K;
  EXPECT_LT((A - B).norm(), 1e-12 * B.norm());
}

/// Timoshenko's beam on two supports: the lower root of its characteristic
/// equation for sin(n pi x / L), Huang, J. Appl. Mech. 28 (1961) 579-584.
double calc_supported_frequency(int n, double L, const BeamSection& s) {
  const double k = n * M_PI / L;
  const double E = kSteel.youngs_modulus;
  const double shear = s.shear_y * kSteel.shear_modulus;
  const double rho = kSteel.density;
  // rho I / (kappa G) w^4 - (A + I k^2 (1 + E / kappa G)) w^2 + E I k^4 / rho
  const double a = rho * s.I_z / shear;
  const double b = s.area + s.I_z * k * k * (1.0 + E / shear);
  const double c = E * s.I_z * std::pow(k, 4) / rho;
  const double w2 = (b - std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
  return std::sqrt(w2) / (2.0 * M_PI);
}

VectorX find_supported(const BeamSection& section, double L, int count) {
  Structure structure;
  structure.beam_properties = {{section, kSteel}};
  structure.x.resize(3, count + 1);
  for (int i = 0; i <= count; ++i) {
    structure.tags.push_back(static_cast<std::size_t>(i) + 1);
    structure.x.col(i) = Vector3(L * i / count, 0.0, 0.0);
    if (i == 0) continue;
    StructureBeam beam;
    beam.nodes = {i - 1, i};
    beam.up = Vector3::UnitY();
    structure.beams.push_back(beam);
  }
  return find_frequencies(structure, 3, [&](const Vector3& x, int c) {
    const bool is_end = x.x() < 1e-9 || x.x() > L - 1e-9;
    return c == 0 || c == 2 || c == 3 || c == 4 || (c == 1 && is_end);
  });
}

/// Of second order where the elements are shorter than the beam is high, and
/// shear prevails.
TEST(BeamElement, VibratesAsTimoshenkosBeam) {
  const double L = 1.0;
  const BeamSection section = make_rectangle(0.15, 0.1, 0.3);
  const VectorX coarse = find_supported(section, L, 8);
  const VectorX fine = find_supported(section, L, 16);
  for (int n = 1; n <= 3; ++n) {
    const double exact = calc_supported_frequency(n, L, section);
    const double error = std::abs(coarse[n - 1] / exact - 1.0);
    EXPECT_LT(error, 2e-2) << n;
    EXPECT_LT(std::abs(fine[n - 1] / exact - 1.0), error / 3.8) << n;
  }
}

TEST(BeamElement, OfASlenderBeamVibratesWithTheFourthOrderOfItsSize) {
  const double L = 1.0;
  const BeamSection section = make_rectangle(0.002, 0.002, 0.3);
  const VectorX coarse = find_supported(section, L, 8);
  const VectorX fine = find_supported(section, L, 16);
  for (int n = 1; n <= 3; ++n) {
    const double exact = calc_supported_frequency(n, L, section);
    const double error = std::abs(coarse[n - 1] / exact - 1.0);
    EXPECT_LT(error, 4e-3) << n;
    EXPECT_LT(std::abs(fine[n - 1] / exact - 1.0), error / 8.0 + 1e-6) << n;
  }
}

}  // namespace
}  // namespace limber::fem::structural_test
