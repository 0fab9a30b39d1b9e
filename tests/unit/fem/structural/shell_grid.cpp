// SPDX-License-Identifier: BSD-3-Clause
#include "unit/fem/structural/shell_grid.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/rotation.hpp"

namespace limber::fem::structural_test {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLDLT<Sparse>;

std::vector<int> find_free(const MatrixModel& model, const IsHeld& is_held) {
  std::vector<int> rows;
  for (std::size_t i = 0; i < model.rows.size(); ++i)
    if (!is_held(model.x.col(model.rows[i].node), model.rows[i].component))
      rows.push_back(static_cast<int>(i));
  return rows;
}

Sparse restrict_rows(const Sparse& A, const std::vector<int>& rows) {
  std::vector<int> places(static_cast<std::size_t>(A.cols()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i)
    places[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Sparse::InnerIterator it(A, j); it; ++it) {
      const int row = places[static_cast<std::size_t>(it.row())];
      const int column = places[static_cast<std::size_t>(j)];
      if (row >= 0 && column >= 0)
        entries.emplace_back(row, column, it.value());
    }
  Sparse R(std::ssize(rows), std::ssize(rows));
  R.setFromTriplets(entries.begin(), entries.end());
  return R;
}

}  // namespace

double Grid::fraction(int i, int j) const {
  return (i % columns == 0 ? 0.5 : 1.0) * (j % rows == 0 ? 0.5 : 1.0) /
         (columns * rows);
}

Grid make_grid(int columns, int rows, const Laminate& laminate, Corners corners,
               const std::function<Vector3(double u, double v)>& place) {
  Grid grid{{}, columns, rows};
  Structure& structure = grid.structure;
  structure.source = "grid";
  structure.laminates = {laminate};
  structure.x.resize(3, (columns + 1) * (rows + 1));
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      structure.x.col(grid.node(i, j)) = place(static_cast<double>(i) / columns,
                                               static_cast<double>(j) / rows);
      structure.tags.push_back(static_cast<std::size_t>(grid.node(i, j)) + 1);
    }
  const auto add = [&](std::vector<int> nodes) {
    StructureShell shell;
    shell.nodes = std::move(nodes);
    structure.shells.push_back(std::move(shell));
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = grid.node(i, j);
      const int b = grid.node(i + 1, j);
      const int c = grid.node(i + 1, j + 1);
      const int d = grid.node(i, j + 1);
      if (corners == Corners::four) {
        add({a, b, c, d});
      } else if (corners == Corners::three || (i + j) % 2 == 0) {
        add({a, b, c});
        add({a, c, d});
      } else {
        add({a, b, d});
        add({b, c, d});
      }
    }
  return grid;
}

Laminate make_plate(double E, double nu, double thickness, double density) {
  return make_laminate({{make_isotropic(E, nu, density), thickness, 0.0}},
                       -0.5 * thickness);
}

Matrix6X solve_static(const Structure& structure, const Matrix6X& forces,
                      const IsHeld& is_held) {
  const AssembledStructure assembled = assemble_structure(structure);
  const std::vector<int> rows = find_free(assembled.model, is_held);
  const Factor factor(restrict_rows(assembled.model.stiffness.entries, rows));
  const VectorX all = forces.reshaped();
  const VectorX free = all(rows);
  const VectorX solved = factor.solve(free);
  VectorX moved = VectorX::Zero(all.size());
  moved(rows) = solved;
  return moved.reshaped(6, forces.cols());
}

SectionStress recover(const Structure& structure, const Matrix6X& u) {
  return assemble_structure(structure).model.recover_sections(
      VectorX(u.reshaped()));
}

Vector6 find_stress(const Structure& structure, const Matrix6X& u, int node,
                    SectionFace face, int ply) {
  const SectionStress stress = recover(structure, u);
  for (std::size_t p = 0; p < stress.points.size(); ++p) {
    const StressPoint& point = stress.points[p];
    if (point.node == node && point.face == face && point.ply == ply)
      return stress.stress.col(0).segment<6>(6 * static_cast<Eigen::Index>(p));
  }
  return Vector6::Constant(std::nan(""));
}

VectorX find_frequencies(const Structure& structure, int count,
                         const IsHeld& is_held, double shift) {
  const AssembledStructure assembled = assemble_structure(structure);
  const std::vector<int> rows = find_free(assembled.model, is_held);
  const Sparse M = restrict_rows(assembled.model.mass.entries, rows);
  const Sparse K =
      restrict_rows(assembled.model.stiffness.entries, rows) + shift * M;
  const Factor factor(K);
  // Subspace iteration (Bathe, Finite Element Procedures, 11.6).
  constexpr int kIterations = 30;
  MatrixX V = MatrixX::Random(K.cols(), 2 * count + 4);
  dense::Eigenpairs pairs;
  for (int i = 0; i < kIterations; ++i) {
    const MatrixX W = factor.solve(MatrixX(M * V));
    // M x = K x / lambda: M may be singular.
    pairs = dense::find_eigenpairs(MatrixX(W.transpose() * (M * W)),
                                   MatrixX(W.transpose() * (K * W)));
    V = W * pairs.vectors;
  }
  const VectorX lambda =
      pairs.values.tail(count).reverse().cwiseInverse().array() - shift;
  return lambda.cwiseMax(0.0).cwiseSqrt() / (2.0 * M_PI);
}

MatrixX make_rigid(const Matrix3X& x) {
  MatrixX X = MatrixX::Zero(6 * x.cols(), 6);
  for (Eigen::Index n = 0; n < x.cols(); ++n) {
    X.block<6, 6>(6 * n, 0).setIdentity();
    X.block<3, 3>(6 * n, 3) = -skew(Vector3(x.col(n)));
  }
  return X;
}

}  // namespace limber::fem::structural_test
