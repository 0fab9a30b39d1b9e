// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/structural/shell_axes.hpp"

namespace limber::fem {
namespace {

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Strain9 = Eigen::Matrix<double, 3, 9>;  // of u, v, theta_n of each node
using Shear9 = Eigen::Matrix<double, 2, 9>;   // of w, theta_1, theta_2

/// Corners in the plane's axes and what follows from them.
struct Triangle {
  std::array<double, 3> x;
  std::array<double, 3> y;
  double area = 0.0;

  [[nodiscard]] double dx(std::size_t i, std::size_t j) const {
    return x[i - 1] - x[j - 1];  // x_ij, nodes from 1
  }
  [[nodiscard]] double dy(std::size_t i, std::size_t j) const {
    return y[i - 1] - y[j - 1];
  }
};

/// Mean membrane strain by displacements and rotations of the nodes: L^T / A t.
Strain9 make_mean_strain(const Triangle& t) {
  constexpr double kAlpha = 1.5;
  constexpr std::array<std::array<std::size_t, 3>, 3> kOthers = {
      {{1, 2, 3}, {2, 3, 1}, {3, 1, 2}}};
  Strain9 B;
  for (int n = 0; n < 3; ++n) {
    const auto [i, j, k] = kOthers[static_cast<std::size_t>(n)];
    const double y = t.dy(j, k);
    const double x = t.dx(k, j);
    B.col(3 * n) << y, 0.0, x;
    B.col(3 * n + 1) << 0.0, x, y;
    B.col(3 * n + 2) << kAlpha / 6.0 * y * (t.dy(i, k) - t.dy(j, i)),
        kAlpha / 6.0 * x * (t.dx(k, i) - t.dx(i, j)),
        kAlpha / 3.0 * (t.dx(k, i) * t.dy(i, k) - t.dx(i, j) * t.dy(j, i));
  }
  return B / (2.0 * t.area);
}

/// Stiffness of rotations about the normal that differ from the mean rotation.
/// @param A of the laminate
Matrix9 make_higher_membrane(const Triangle& t, const Matrix3& A) {
  const double x12 = t.dx(1, 2), x21 = -x12, y12 = t.dy(1, 2), y21 = -y12;
  const double x23 = t.dx(2, 3), x32 = -x23, y23 = t.dy(2, 3), y32 = -y23;
  const double x31 = t.dx(3, 1), x13 = -x31, y31 = t.dy(3, 1), y13 = -y31;
  const double l21 = x21 * x21 + y21 * y21;
  const double l32 = x32 * x32 + y32 * y32;
  const double l13 = x13 * x13 + y13 * y13;
  Matrix3 T;  // from strains along the sides
  T << y23 * y13 * l21, y31 * y21 * l32, y12 * y32 * l13,  //
      x23 * x13 * l21, x31 * x21 * l32, x12 * x32 * l13,   //
      (y23 * x31 + x32 * y13) * l21, (y31 * x12 + x13 * y21) * l32,
      (y12 * x23 + x21 * y32) * l13;
  T /= 4.0 * t.area * t.area;
  const Matrix3 natural = T.transpose() * A * T;

  // Optimal parameters: b1 to b9 = 1, 2, 1, 0, 1, -1, -1, -1, -2.
  const Vector3 side(1.0 / l21, 1.0 / l32, 1.0 / l13);
  Matrix3 Q1;
  Matrix3 Q2;
  Matrix3 Q3;
  Q1 << 1.0, 2.0, 1.0, 0.0, 1.0, -1.0, -1.0, -1.0, -2.0;
  Q2 << -2.0, -1.0, -1.0, 1.0, 1.0, 2.0, -1.0, 0.0, 1.0;
  Q3 << 1.0, -1.0, 0.0, -1.0, -2.0, -1.0, 2.0, 1.0, 1.0;
  for (Matrix3* Q : {&Q1, &Q2, &Q3})
    *Q = 2.0 / 3.0 * t.area * side.asDiagonal() * *Q;
  const double nu = A(0, 1) / std::sqrt(A(0, 0) * A(1, 1));
  const double b0 = std::max(0.5 * (1.0 - 4.0 * nu * nu), 0.01);
  Matrix3 K = Matrix3::Zero();
  for (const Matrix3& Q : {Matrix3(0.5 * (Q1 + Q2)), Matrix3(0.5 * (Q2 + Q3)),
                           Matrix3(0.5 * (Q3 + Q1))})
    K += 0.75 * b0 * t.area * Q.transpose() * natural * Q;

  Strain9 rotation;  // of each node, less the mean
  rotation << x32, y32, 0.0, x13, y13, 0.0, x21, y21, 0.0,  //
      x32, y32, 0.0, x13, y13, 0.0, x21, y21, 0.0,          //
      x32, y32, 0.0, x13, y13, 0.0, x21, y21, 0.0;
  rotation /= 4.0 * t.area;
  for (int n = 0; n < 3; ++n) rotation(n, 3 * n + 2) += 1.0;
  return rotation.transpose() * K * rotation;
}

/// Bending with transverse shear. Along side k of ends i and j the rotation is
/// quadratic, with D_k in its middle, so that the mean shear strain there is
/// that of the side's bending:
///
///     w_j - w_i + L (b_i + b_j) / 2 + 2/3 L D = -2/3 L phi D,
///     phi = 12 D_ss / (S_ss L^2), b the rotation along the side
///
/// D is that of bending without normal forces.
class DiscretePlate {
 public:
  DiscretePlate(const Triangle& t, const Matrix3& D, const Matrix2& S) {
    slopes_ << t.dy(2, 3), t.dx(3, 2), t.dy(3, 1), t.dx(1, 3), t.dy(1, 2),
        t.dx(2, 1);
    slopes_ /= 2.0 * t.area;
    J_ << t.dx(2, 1), t.dy(2, 1), t.dx(3, 1), t.dy(3, 1);
    for (int k = 0; k < 3; ++k) add_side(k, D, S);
  }

  /// Curvatures at area coordinates N; u_1 = z theta_2, u_2 = -z theta_1.
  [[nodiscard]] Strain9 make_curvature(const Vector3& N) const {
    Strain9 B = Strain9::Zero();
    for (int i = 0; i < 3; ++i) {
      B(0, 3 * i + 2) = slopes_(i, 0);
      B(1, 3 * i + 1) = -slopes_(i, 1);
      B(2, 3 * i + 1) = -slopes_(i, 0);
      B(2, 3 * i + 2) = slopes_(i, 1);
    }
    for (int k = 0; k < 3; ++k) {
      const int j = (k + 1) % 3;
      const Eigen::Vector2d P =
          4.0 * (N[k] * slopes_.row(j) + N[j] * slopes_.row(k)).transpose();
      const Eigen::Vector2d& d = direction_[index(k)];
      B += Vector3(P[0] * d[0], P[1] * d[1], P[1] * d[0] + P[0] * d[1]) *
           middle_[index(k)];
    }
    return B;
  }

  /// Transverse shear there: constant along each side.
  [[nodiscard]] Shear9 make_shear(const Vector3& N) const {
    const Row9& r1 = shear_[0];  // from node 1 to 2
    const Row9 s2 = -shear_[2];  // from node 1 to 3
    const Row9 c = s2 - r1 - shear_[1];
    Shear9 B;
    B.row(0) = r1 + c * N[2];
    B.row(1) = s2 - c * N[1];
    return J_.inverse() * B;
  }

 private:
  using Row9 = Eigen::Matrix<double, 1, 9>;

  void add_side(int k, const Matrix3& D, const Matrix2& S) {
    const int j = (k + 1) % 3;
    // From node k to j.
    const Eigen::Vector2d side =
        k == 0   ? Eigen::Vector2d(J_.row(0).transpose())
        : k == 1 ? Eigen::Vector2d((J_.row(1) - J_.row(0)).transpose())
                 : Eigen::Vector2d(-J_.row(1).transpose());
    const double L = side.norm();
    const Eigen::Vector2d d = side / L;
    const Vector3 along(d[0] * d[0], d[1] * d[1], 2.0 * d[0] * d[1]);
    const double phi =
        12.0 * along.dot(D * along) * d.dot(S.inverse() * d) / (L * L);
    Row9 gap = Row9::Zero();
    gap[3 * k] = -1.0;
    gap[3 * j] = 1.0;
    for (const int end : {k, j}) {
      gap[3 * end + 1] = -0.5 * L * d[1];
      gap[3 * end + 2] = 0.5 * L * d[0];
    }
    const Row9 middle = -1.5 / (L * (1.0 + phi)) * gap;
    direction_[index(k)] = d;
    middle_[index(k)] = middle;
    shear_[index(k)] = -2.0 / 3.0 * L * phi * middle;
  }

  Eigen::Matrix<double, 3, 2> slopes_;  // of the area coordinates
  Matrix2 J_;
  std::array<Eigen::Vector2d, 3> direction_;
  std::array<Row9, 3> middle_;  // D_k
  std::array<Row9, 3> shear_;   // along side k, times its length
};

/// Unknowns of an element: places of u, v, theta_n and of w, theta_1, theta_2.
constexpr std::array<int, 9> kInPlane = {0, 1, 5, 6, 7, 11, 12, 13, 17};
constexpr std::array<int, 9> kOutOfPlane = {2, 3, 4, 8, 9, 10, 14, 15, 16};

/// Points inside of equal weight, exact to degree 2.
const std::array<Vector3, 3> kInside = {Vector3(2.0, 0.5, 0.5) / 3.0,
                                        Vector3(0.5, 2.0, 0.5) / 3.0,
                                        Vector3(0.5, 0.5, 2.0) / 3.0};

const Vector3 kMiddle = Vector3::Constant(1.0 / 3.0);

}  // namespace

StructuralElement make_triangle_shell(const ShellShape& shape,
                                      const Laminate& laminate) {
  constexpr double kLeast = 1e-6;  // of the square of a side
  const Vector3 a = shape.x.col(1) - shape.x.col(0);
  const Vector3 b = shape.x.col(2) - shape.x.col(0);
  const Vector3 across = a.cross(b);
  if (!(across.norm() > kLeast * (a.squaredNorm() + b.squaredNorm())))
    throw InputError(
        "the triangle has no area. Expected three nodes that are not on a "
        "line.");
  const Matrix3 axes = make_surface_axes(across.normalized(), shape.axis);
  Triangle t;
  t.area = 0.5 * across.norm();
  for (int i = 0; i < 3; ++i) {
    const Vector3 x = shape.x.col(i) - shape.x.col(0);
    t.x[static_cast<std::size_t>(i)] = axes.col(0).dot(x);
    t.y[static_cast<std::size_t>(i)] = axes.col(1).dot(x);
  }

  // N = A (e + C k); the varying part of C k stretches nothing.
  const Matrix3 C = laminate.A.inverse() * laminate.B;
  const Matrix3 D = laminate.D - laminate.B * C;
  const Strain9 membrane = make_mean_strain(t);
  const DiscretePlate plate(t, D, laminate.S);
  const Strain9 mean_curvature = plate.make_curvature(kMiddle);
  MatrixX stretch(3, 18);
  stretch(Eigen::all, kInPlane) = membrane;
  stretch(Eigen::all, kOutOfPlane) = C * mean_curvature;
  Matrix9 K_plate = Matrix9::Zero();
  for (const Vector3& N : kInside) {
    const Strain9 bending = plate.make_curvature(N);
    const Shear9 shear = plate.make_shear(N);
    K_plate += t.area / 3.0 *
               (bending.transpose() * D * bending +
                shear.transpose() * laminate.S * shear);
  }
  MatrixX K = t.area * stretch.transpose() * laminate.A * stretch;
  K(kInPlane, kInPlane) += make_higher_membrane(t, laminate.A);
  K(kOutOfPlane, kOutOfPlane) += K_plate;

  MatrixX rotation = MatrixX::Zero(18, 18);
  for (int i = 0; i < 6; ++i)
    rotation.block<3, 3>(3 * i, 3 * i) = axes.transpose();
  StructuralElement element;
  element.K = rotation.transpose() * K * rotation;
  for (int i = 0; i < 3; ++i) {
    const Vector3 N = Vector3::Unit(i);
    MatrixX strains = MatrixX::Zero(8, 18);
    strains.topRows<3>()(Eigen::all, kInPlane) = membrane;
    const Strain9 curvature = plate.make_curvature(N);
    strains.topRows<3>()(Eigen::all, kOutOfPlane) =
        -C * (curvature - mean_curvature);
    strains.middleRows<3>(3)(Eigen::all, kOutOfPlane) = curvature;
    strains.bottomRows<2>()(Eigen::all, kOutOfPlane) = plate.make_shear(N);
    element.strains.emplace_back(strains * rotation);
    element.axes.push_back(axes);
  }
  const Matrix3X normals = axes.col(2).replicate<1, 3>();
  for (const Vector3& N : kInside)
    add_shell_mass(N, normals, t.area / 3.0, laminate, element);
  return element;
}

}  // namespace limber::fem
