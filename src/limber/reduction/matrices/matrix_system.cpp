// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/matrix_system.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

bool is_known(const fem::MatrixRow& row) {
  return row.node >= 0 && row.component >= 0;
}

void check_sizes(const fem::MatrixModel& model) {
  std::vector<std::string> problems;
  const auto count = static_cast<Eigen::Index>(model.rows.size());
  for (const fem::ModelMatrix* matrix : {&model.stiffness, &model.mass}) {
    const auto& entries = matrix->entries;
    if (entries.rows() != count || entries.cols() != count)
      problems.push_back(fmt::format(
          "{}: {} x {} entries; expected {} x {}, as the table of "
          "degrees of freedom has {} rows",
          matrix->file, entries.rows(), entries.cols(), count, count, count));
  }
  if (count == 0)
    problems.push_back(
        fmt::format("{}: the matrices have no rows", model.source));
  if (!problems.empty()) throw InputError(problems);
}

/// @throws InputError for a direction of a node that has two rows.
void check_rows(const MatrixSystem& system) {
  std::set<std::pair<int, int>> seen;
  for (Eigen::Index i = 0; i < std::ssize(system.rows); ++i) {
    const fem::MatrixRow& row = system.rows[static_cast<std::size_t>(i)];
    if (!is_known(row) || seen.insert({row.node, row.component}).second)
      continue;
    throw InputError(fmt::format("{}: {} has two rows; expected one each",
                                 system.source, system.name_row(i)));
  }
}

fem::SparseMatrix make_lift(const fem::MatrixModel& model) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < model.rows.size(); ++i) {
    const fem::MatrixRow& row = model.rows[i];
    if (is_known(row))
      entries.emplace_back(field_row(row.node, row.component), i, 1.0);
  }
  // By column: of a condensed row its coefficients.
  for (Eigen::Index j = 0; j < model.equations.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(model.equations, j); it;
         ++it) {
      const fem::MatrixRow& row =
          model.condensed[static_cast<std::size_t>(it.row())];
      if (is_known(row))
        entries.emplace_back(field_row(row.node, row.component), j, it.value());
    }
  fem::SparseMatrix lift(6 * static_cast<Eigen::Index>(model.tags.size()),
                         static_cast<Eigen::Index>(model.rows.size()));
  lift.setFromTriplets(entries.begin(), entries.end());
  return lift;
}

/// D of make_matrix_system, of each row.
VectorX make_scales(const std::vector<fem::MatrixRow>& rows, double unit) {
  VectorX scales = VectorX::Ones(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (is_known(rows[i]) && rows[i].component < 3)
      scales[static_cast<Eigen::Index>(i)] = 1.0 / unit;
  return scales;
}

void scale(const VectorX& D, double factor, fem::SparseMatrix& A) {
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (fem::SparseMatrix::InnerIterator it(A, j); it; ++it)
      it.valueRef() *= factor * D[it.row()] * D[j];
}

/// Coefficients of condensed translations [length] per rotation, and so on.
void scale_lift(const VectorX& D, double unit, fem::SparseMatrix& lift) {
  for (Eigen::Index j = 0; j < lift.outerSize(); ++j)
    for (fem::SparseMatrix::InnerIterator it(lift, j); it; ++it)
      it.valueRef() *= D[j] * (it.row() % 6 < 3 ? unit : 1.0);
}

/// Stress and section forces in SI by motions in SI.
fem::RecoverSections scale_sections(const fem::RecoverSections& recover,
                                    const VectorX& D, double unit) {
  if (!recover) return {};
  return [=](const MatrixX& motions) {
    const double per_area = 1.0 / (unit * unit);
    fem::SectionStress stress = recover(D.asDiagonal() * motions);
    stress.stress *= per_area;
    for (Eigen::Index i = 3; i < stress.forces.rows(); i += 6)
      stress.forces.middleRows<3>(i) *= unit;
    stress.constants.row(0) *= per_area;
    for (fem::StressPoint& point : stress.points) {
      point.strengths.head<5>() *= per_area;
      point.strengths[5] /= per_area * per_area;
    }
    return stress;
  };
}

/// Rows without an entry other than zero in either matrix.
std::vector<int> find_null_rows(const MatrixSystem& system) {
  VectorX largest = VectorX::Zero(system.row_count());
  for (const fem::SparseMatrix* A : {&system.K, &system.M})
    for (Eigen::Index j = 0; j < A->outerSize(); ++j)
      for (fem::SparseMatrix::InnerIterator it(*A, j); it; ++it)
        largest[j] = std::max(largest[j], std::abs(it.value()));
  std::vector<int> null;
  for (int i = 0; i < largest.size(); ++i)
    if (largest[i] == 0.0) null.push_back(i);
  return null;
}

void find_components(MatrixSystem& system) {
  const auto nodes = system.tags.size();
  std::vector<std::array<char, 6>> has(nodes);
  std::vector<char> is_null(static_cast<std::size_t>(system.row_count()), 0);
  for (const int row : system.null) is_null[static_cast<std::size_t>(row)] = 1;
  for (Eigen::Index j = 0; j < system.lift.outerSize(); ++j)
    for (fem::SparseMatrix::InnerIterator it(system.lift, j); it; ++it)
      if (!is_null[static_cast<std::size_t>(j)])
        has[static_cast<std::size_t>(it.row() / 6)]
           [static_cast<std::size_t>(it.row() % 6)] = 1;
  for (std::size_t n = 0; n < nodes; ++n) {
    system.is_moving.push_back(has[n][0] && has[n][1] && has[n][2] ? 1 : 0);
    system.can_rotate.push_back({has[n][3], has[n][4], has[n][5]});
  }
}

void note_rows(const std::vector<int>& rows, const std::string& what,
               MatrixSystem& system) {
  if (rows.empty()) return;
  system.notices.push_back(fmt::format(
      "{}: {} of {} rows {}, the first of {}", system.source, rows.size(),
      system.row_count(), what, system.name_row(rows.front())));
}

}  // namespace

Vector3 MatrixSystem::size() const {
  Vector3 low = Vector3::Constant(1e300);
  Vector3 high = -low;
  for (std::size_t n = 0; n < tags.size(); ++n) {
    if (!is_moving[n]) continue;
    low = low.cwiseMin(x.col(static_cast<Eigen::Index>(n)));
    high = high.cwiseMax(x.col(static_cast<Eigen::Index>(n)));
  }
  return (high - low).cwiseMax(0.0);
}

std::string MatrixSystem::name_row(Eigen::Index row) const {
  constexpr std::array<const char*, 6> kComponents = {"x",
                                                      "y",
                                                      "z",
                                                      "rotation about x",
                                                      "rotation about y",
                                                      "rotation about z"};
  const fem::MatrixRow& one = rows[static_cast<std::size_t>(row)];
  if (one.node < 0) return fmt::format("row {}", row + 1);
  const std::size_t tag = tags[static_cast<std::size_t>(one.node)];
  if (one.component < 0) return fmt::format("node {} (row {})", tag, row + 1);
  return fmt::format("node {}, {}", tag,
                     kComponents[static_cast<std::size_t>(one.component)]);
}

std::string MatrixSystem::name_nodes(const std::vector<int>& nodes) const {
  constexpr std::size_t kMost = 4;
  std::vector<std::size_t> named;
  for (std::size_t i = 0; i < std::min(kMost, nodes.size()); ++i)
    named.push_back(tags[static_cast<std::size_t>(nodes[i])]);
  std::string text = fmt::format("{} {}", nodes.size() == 1 ? "node" : "nodes",
                                 fmt::join(named, ", "));
  if (nodes.size() > kMost)
    text += fmt::format(" and {} more", nodes.size() - kMost);
  return text;
}

MatrixSystem make_matrix_system(fem::MatrixModel model, double unit) {
  LIMBER_EXPECT(unit > 0.0);
  check_sizes(model);
  MatrixSystem system;
  system.source = model.source;
  system.stiffness_file = model.stiffness.file;
  system.mass_file = model.mass.file;
  system.lift = make_lift(model);
  system.has_recovery = model.has_recovery;
  system.tags = std::move(model.tags);
  system.x = unit * model.x;
  system.rows = std::move(model.rows);
  check_rows(system);
  system.sets = std::move(model.sets);
  system.found = std::move(model.found);
  system.edges = std::move(model.edges);
  system.triangles = std::move(model.triangles);
  system.drawn = model.drawn;
  system.is_structure = model.is_structure;
  system.mesh_surface = std::move(model.mesh_surface);
  system.mesh_surface.mesh.source = system.source;
  system.mesh_surface.mesh.tags = system.tags;
  system.mesh_surface.mesh.x = system.x;
  system.notices = std::move(model.notices);
  system.digits = model.stiffness.digits;
  system.M = std::move(model.mass.entries);
  system.K = std::move(model.stiffness.entries);
  for (int i = 0; i < system.row_count(); ++i)
    if (system.K.coeff(i, i) >= kHeld) system.held.push_back(i);
  system.null = find_null_rows(system);
  const VectorX D = make_scales(system.rows, unit);
  scale(D, unit, system.K);
  scale(D, unit, system.M);
  for (std::size_t i = 0; i < model.moments.size(); ++i) {
    system.moments[i] = std::move(model.moments[i]);
    scale(D, unit, system.moments[i]);
  }
  scale_lift(D, unit, system.lift);
  system.recover_sections = scale_sections(model.recover_sections, D, unit);
  find_components(system);
  note_rows(system.null, "have neither stiffness nor mass and are left out",
            system);
  note_rows(system.held, "have a stiffness of 1e30 or more and are clamped",
            system);
  return system;
}

}  // namespace limber::flexbody
