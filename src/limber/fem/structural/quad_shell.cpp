// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/fem/structural/shell_axes.hpp"

namespace limber::fem {
namespace {

using Vector4 = Eigen::Vector4d;
using Row = Eigen::Matrix<double, 1, 24>;
using Strain = Eigen::Matrix<double, 3, 24>;
using Square = Eigen::Matrix<double, 24, 24>;
using Enhanced = Eigen::Matrix<double, 3, 4>;

const Vector4 kR(-1.0, 1.0, 1.0, -1.0);
const Vector4 kS(-1.0, -1.0, 1.0, 1.0);

/// Shape functions, surface and axes at (r, s).
struct SurfacePoint {
  Vector4 N;
  Vector4 N_r;
  Vector4 N_s;
  Vector3 g_r;
  Vector3 g_s;
  double area = 0.0;  ///< of dr ds
  Matrix3 axes;
  Matrix2 J;      ///< rows d/dr, d/ds of the position along axes 1, 2
  Matrix2 J_inv;  ///< d/d1 = J_inv(0, 0) d/dr + J_inv(0, 1) d/ds
};

Vector3 calc_normal(const ShellShape& shape, double r, double s) {
  const Vector4 N_r = 0.25 * kR.cwiseProduct(Vector4::Ones() + s * kS);
  const Vector4 N_s = 0.25 * kS.cwiseProduct(Vector4::Ones() + r * kR);
  return Vector3(shape.x * N_r).cross(Vector3(shape.x * N_s));
}

SurfacePoint find_point(const ShellShape& shape, double r, double s) {
  SurfacePoint at;
  const Vector4 a = Vector4::Ones() + r * kR;
  const Vector4 b = Vector4::Ones() + s * kS;
  at.N = 0.25 * a.cwiseProduct(b);
  at.N_r = 0.25 * kR.cwiseProduct(b);
  at.N_s = 0.25 * kS.cwiseProduct(a);
  at.g_r = shape.x * at.N_r;
  at.g_s = shape.x * at.N_s;
  const Vector3 across = at.g_r.cross(at.g_s);
  at.area = across.norm();
  at.axes = make_surface_axes(across / at.area, shape.axis);
  at.J << at.g_r.dot(at.axes.col(0)), at.g_r.dot(at.axes.col(1)),
      at.g_s.dot(at.axes.col(0)), at.g_s.dot(at.axes.col(1));
  at.J_inv = at.J.inverse();
  return at;
}

class QuadMaker {
 public:
  QuadMaker(const ShellShape& shape, const Laminate& laminate)
      : shape_(shape), laminate_(laminate) {
    set_normals();
    middle_ = find_point(shape_, 0.0, 0.0);
    // Shear from the middles of the edges.
    const auto shear = [&](double r, double s, bool is_r) {
      return make_shear(find_point(shape_, r, s), is_r);
    };
    shear_r_ = {shear(0.0, -1.0, true), shear(0.0, 1.0, true)};
    shear_s_ = {shear(-1.0, 0.0, false), shear(1.0, 0.0, false)};
  }

  StructuralElement make() {
    const double g = 1.0 / std::sqrt(3.0);
    StructuralElement element;
    for (const double s : {-1.0, 1.0})
      for (const double r : {s, -s}) {  // in the order of the nodes
        const SurfacePoint at = find_point(shape_, g * r, g * s);
        add_stiffness(at, g * r, g * s);
        add_drilling(at, at.area);
        add_shell_mass(at.N, normals_, at.area, laminate_, element);
      }
    add_drilling(middle_, 4.0 * middle_.area);
    const Eigen::Matrix<double, 4, 24> alpha =
        -K_aa_.inverse() * K_qa_.transpose();
    K_ += K_qa_ * alpha;
    element.K = K_;
    add_strains(alpha, element);
    return element;
  }

 private:
  /// Extrapolated from the points of integration, bilinear.
  void add_strains(const Eigen::Matrix<double, 4, 24>& alpha,
                   StructuralElement& element) {
    for (std::size_t q = 0; q < strains_.size(); ++q)
      strains_[q].topRows<3>() += enhanced_[q] * alpha;
    for (int i = 0; i < 4; ++i) {
      MatrixX at_node = MatrixX::Zero(8, 24);
      for (int q = 0; q < 4; ++q)
        at_node += 0.25 * (1.0 + std::sqrt(3.0) * kR[i] * kR[q]) *
                   (1.0 + std::sqrt(3.0) * kS[i] * kS[q]) *
                   strains_[static_cast<std::size_t>(q)];
      element.strains.push_back(std::move(at_node));
      element.axes.push_back(find_point(shape_, kR[i], kS[i]).axes);
    }
  }

  /// Of the surface at each node.
  void set_normals() {
    constexpr double kLeast = 1e-6;  // of the middle's
    const Vector3 middle = calc_normal(shape_, 0.0, 0.0);
    normals_.resize(3, 4);
    for (int i = 0; i < 4; ++i) {
      const Vector3 n = calc_normal(shape_, kR[i], kS[i]);
      if (!(n.dot(middle) > kLeast * middle.squaredNorm()))
        throw InputError(
            "the quadrilateral is folded, or flat at a corner. Expected four "
            "nodes around a convex area, one after the other.");
      normals_.col(i) = n.normalized();
    }
  }

  /// 2 e_rz or 2 e_sz.
  [[nodiscard]] Row make_shear(const SurfacePoint& at, bool is_r) const {
    const Vector3& g = is_r ? at.g_r : at.g_s;
    const Vector4& slope = is_r ? at.N_r : at.N_s;
    const Vector3 n = normals_ * at.N;
    Row row;
    for (int i = 0; i < 4; ++i) {
      row.segment<3>(6 * i) = slope[i] * n.transpose();
      row.segment<3>(6 * i + 3) =
          at.N[i] * Vector3(normals_.col(i)).cross(g).transpose();
    }
    return row;
  }

  /// Strains [rr, ss, 2 rs] of the surface.
  [[nodiscard]] Strain make_membrane(const SurfacePoint& at) const {
    Strain B = Strain::Zero();
    for (int i = 0; i < 4; ++i) {
      B.block<1, 3>(0, 6 * i) = at.N_r[i] * at.g_r.transpose();
      B.block<1, 3>(1, 6 * i) = at.N_s[i] * at.g_s.transpose();
      B.block<1, 3>(2, 6 * i) =
          at.N_s[i] * at.g_r.transpose() + at.N_r[i] * at.g_s.transpose();
    }
    return B;
  }

  /// The same, of the strain's slope along z.
  [[nodiscard]] Strain make_bending(const SurfacePoint& at) const {
    const Vector3 n_r = normals_ * at.N_r;
    const Vector3 n_s = normals_ * at.N_s;
    Strain B = Strain::Zero();
    for (int i = 0; i < 4; ++i) {
      const Vector3 n = normals_.col(i);
      const Vector3 r = n.cross(at.g_r);
      const Vector3 s = n.cross(at.g_s);
      B.block<1, 3>(0, 6 * i) = at.N_r[i] * n_r.transpose();
      B.block<1, 3>(1, 6 * i) = at.N_s[i] * n_s.transpose();
      B.block<1, 3>(2, 6 * i) =
          at.N_s[i] * n_r.transpose() + at.N_r[i] * n_s.transpose();
      B.block<1, 3>(0, 6 * i + 3) = at.N_r[i] * r.transpose();
      B.block<1, 3>(1, 6 * i + 3) = at.N_s[i] * s.transpose();
      B.block<1, 3>(2, 6 * i + 3) =
          at.N_s[i] * r.transpose() + at.N_r[i] * s.transpose();
    }
    return B;
  }

  void add_stiffness(const SurfacePoint& at, double r, double s) {
    const Matrix3 rotation = rotate_strain(at.J_inv);
    const Strain membrane = rotation * make_membrane(at);
    const Strain bending = rotation * make_bending(at);
    const Strain force = laminate_.A * membrane + laminate_.B * bending;
    const Strain moment = laminate_.B * membrane + laminate_.D * bending;
    K_ +=
        at.area * (membrane.transpose() * force + bending.transpose() * moment);

    Eigen::Matrix<double, 2, 24> shear;
    shear.row(0) = 0.5 * ((1.0 - s) * shear_r_[0] + (1.0 + s) * shear_r_[1]);
    shear.row(1) = 0.5 * ((1.0 - r) * shear_s_[0] + (1.0 + r) * shear_s_[1]);
    shear = at.J_inv * shear;
    K_ += at.area * shear.transpose() * laminate_.S * shear;

    Enhanced shapes = Enhanced::Zero();
    shapes(0, 0) = r;
    shapes(1, 1) = s;
    shapes(2, 2) = r;
    shapes(2, 3) = s;
    const Enhanced E =
        middle_.area / at.area * rotate_strain(middle_.J_inv) * shapes;
    K_aa_ += at.area * E.transpose() * laminate_.A * E;
    K_qa_ += at.area * force.transpose() * E;

    strains_.emplace_back(8, 24);
    strains_.back() << membrane, bending, shear;
    enhanced_.push_back(E);
  }

  void add_drilling(const SurfacePoint& at, double area) {
    const Vector4 N_1 = at.J_inv(0, 0) * at.N_r + at.J_inv(0, 1) * at.N_s;
    const Vector4 N_2 = at.J_inv(1, 0) * at.N_r + at.J_inv(1, 1) * at.N_s;
    Row row;
    for (int i = 0; i < 4; ++i) {
      row.segment<3>(6 * i) = 0.5 * (N_2[i] * at.axes.col(0).transpose() -
                                     N_1[i] * at.axes.col(1).transpose());
      row.segment<3>(6 * i + 3) = at.N[i] * at.axes.col(2).transpose();
    }
    K_ += area * kDrilling * laminate_.A(2, 2) * row.transpose() * row;
  }

  ShellShape shape_;
  Laminate laminate_;
  Matrix3X normals_;
  SurfacePoint middle_;
  std::array<Row, 2> shear_r_;
  std::array<Row, 2> shear_s_;
  std::vector<MatrixX> strains_;  // at the points of integration
  std::vector<Enhanced> enhanced_;
  Square K_ = Square::Zero();
  Eigen::Matrix4d K_aa_ = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 24, 4> K_qa_ = Eigen::Matrix<double, 24, 4>::Zero();
};

}  // namespace

StructuralElement make_quad_shell(const ShellShape& shape,
                                  const Laminate& laminate) {
  return QuadMaker(shape, laminate).make();
}

}  // namespace limber::fem
