// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "limber/reduction/meshed_body.hpp"
#include "support/temporary_folder.hpp"

/// A bar of hexahedra along x, and its matrices entry by entry.
namespace limber::flexbody::testing {

struct Bar {
  Vector3 corner = Vector3::Zero();  ///< [m]
  Vector3 size{1.0, 0.1, 0.05};      ///< [m]
  int cells = 4;                     ///< along x; 1 x 1 across
  int order = 2;
  Material material{200e9, 0.0, 8000.0};
  bool is_clamped = false;  ///< at x = 0

  [[nodiscard]] double mass() const { return material.density * size.prod(); }
};

inline std::filesystem::path write_bar(const Bar& bar) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name =
      fmt::format("{}.{}.geo", info->test_suite_name(), info->name());
  std::replace(name.begin(), name.end(), '/', '_');
  std::filesystem::path file = limber::test::own_folder() / name;
  const Vector3& a = bar.corner;
  const Vector3& s = bar.size;
  std::ofstream(file) << fmt::format(
      "Point(1) = {{{0:.17g}, {1:.17g}, {2:.17g}}};\n"
      "l[] = Extrude {{0, {3:.17g}, 0}} {{ Point{{1}}; Layers{{1}}; }};\n"
      "s[] = Extrude {{0, 0, {4:.17g}}} {{ Line{{l[1]}}; Layers{{1}}; "
      "Recombine; }};\n"
      "v[] = Extrude {{{5:.17g}, 0, 0}} {{ Surface{{s[1]}}; Layers{{{6}}}; "
      "Recombine; }};\n"
      "Physical Surface(\"root\") = {{s[1]}};\n"
      "Physical Surface(\"tip\") = {{v[0]}};\n"
      "Physical Surface(\"top\") = {{v[4]}};\n"
      "Physical Volume(\"bar\") = {{v[1]}};\n",
      a[0], a[1], a[2], s[1], s[2], s[0], bar.cells);
  return file;
}

inline Recipe make_recipe(const Bar& bar) {
  Recipe recipe;
  recipe.name = "bar";
  recipe.mesh.file = write_bar(bar);
  recipe.mesh.order = bar.order;
  recipe.materials = {{"", bar.material}};
  if (bar.is_clamped) recipe.clamped_groups = {"root"};
  recipe.interfaces = {{"root", GroupNodes{"root"}, Weighting::uniform},
                       {"tip", GroupNodes{"tip"}, Weighting::uniform}};
  return recipe;
}

/// A force spread evenly over the root (0) or tip (1), 3 x N [N].
inline Matrix3X spread(const MeshedBody& body, std::size_t interface,
                       const Vector3& force) {
  Vector6 wrench = Vector6::Zero();
  wrench.head<3>() = force;
  const MatrixX load = body.interfaces[interface].motion.spread(wrench);
  return load.reshaped(3, body.mesh.x.cols());
}

/// A load of all sorts, net force and moment included [N].
inline Matrix3X make_load(const MeshedBody& body) {
  Matrix3X load(3, body.mesh.x.cols());
  for (Eigen::Index i = 0; i < load.size(); ++i)
    load.reshaped()[i] = 1e3 * std::sin(2.3 * static_cast<double>(i) + 1.0);
  return load;
}

/// Stiffness of the free nodes.
inline MatrixX dense_stiffness(const MeshedBody& body) {
  const MatrixX lower = body.support.matrices.K;
  return lower.selfadjointView<Eigen::Lower>();
}

/// A (x) B.
inline MatrixX kron(const MatrixX& A, const Matrix3& B) {
  MatrixX product(3 * A.rows(), 3 * A.cols());
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      product.block<3, 3>(3 * i, 3 * j) = A(i, j) * B;
  return product;
}

/// Rigid motions about the origin, densely: 3N x 6.
inline MatrixX rigid_motions(const Matrix3X& x) {
  MatrixX R(3 * x.cols(), 6);
  for (Eigen::Index n = 0; n < x.cols(); ++n)
    for (int a = 0; a < 3; ++a) {
      R.block<3, 1>(3 * n, a) = Vector3::Unit(a);
      R.block<3, 1>(3 * n, 3 + a) = Vector3::Unit(a).cross(x.col(n));
    }
  return R;
}

}  // namespace limber::flexbody::testing
