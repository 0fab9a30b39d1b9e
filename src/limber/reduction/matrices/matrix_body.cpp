// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/matrix_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/reduction/matrices/matrix_interfaces.hpp"
#include "limber/reduction/modal/selection.hpp"

namespace limber::flexbody {
namespace {

/// What needs elements, which matrices do not have.
void refuse_options(const MatrixSystem& system, const Recipe& recipe) {
  std::vector<std::string> problems;
  const auto refuse = [&](bool is_given, const std::string& text) {
    if (is_given)
      problems.push_back(fmt::format("{}: {}", system.source, text));
  };
  refuse(recipe.manifold,
         "second-order kinematics (level nonlinear) need the elements' "
         "nonlinear strain; matrices, beams and shells here are of small "
         "strain. Use level coupled");
  refuse(!recipe.materials.empty() && system.is_structure &&
             recipe.mesh.sections.empty(),
         "a material is given, and its beams and shells have their own. Give "
         "none");
  refuse(recipe.stress && !system.is_structure,
         "stress needs elements; matrices have none. Recover it in the program "
         "that wrote them, from the displacements");
  refuse(!recipe.contact_groups.empty() && !system.is_structure,
         "contact needs a surface of elements; matrices have none. Use a "
         "<collision> shape on the link, or a mesh");
  refuse(!recipe.nodal_forces.empty(),
         "files of nodal forces have a row for each node of a mesh; load "
         "interfaces of a model by matrices");
  refuse(recipe.initial_displacement.values.size() > 0 ||
             recipe.initial_velocity.values.size() > 0,
         "fields of initial displacement or velocity are of a mesh's nodes; "
         "start a model by matrices from an equilibrium");
  if (!problems.empty()) throw InputError(problems);
}

std::vector<int> find_clamped_rows(const MatrixSystem& system,
                                   const Recipe& recipe) {
  std::set<int> nodes;
  for (const std::string& name : recipe.clamped_groups)
    for (const int node : find_matrix_nodes(system, name)) nodes.insert(node);
  std::vector<int> rows;
  for (int i = 0; i < system.row_count(); ++i)
    if (nodes.contains(system.rows[static_cast<std::size_t>(i)].node))
      rows.push_back(i);
  if (system.is_structure) {
    std::set<int> led = nodes;
    for (const int row : rows)
      led.erase(system.rows[static_cast<std::size_t>(row)].node);
    if (!led.empty())
      throw InputError(fmt::format(
          "{}: the clamped {} is a dependent node of rigid elements or means. "
          "Expected the independent nodes, whose clamping also holds the "
          "dependent ones.",
          system.source, system.name_nodes({led.begin(), led.end()})));
  }
  if (!nodes.empty() && rows.empty())
    throw InputError(fmt::format(
        "{}: the clamped {} has no row in the matrices", system.source,
        system.name_nodes({nodes.begin(), nodes.end()})));
  return rows;
}

/// @throws InputError if rows that are held leave a rigid motion.
void check_clamps(const MatrixPart& part, const std::vector<int>& clamped) {
  constexpr double kFree = 1e-12;  // squared
  std::vector<int> fixed = part.system.held;
  fixed.insert(fixed.end(), clamped.begin(), clamped.end());
  MatrixX X = part.X(fixed, Eigen::all);
  const double length = std::max(part.system.size().maxCoeff(), 1e-300);
  X.rightCols<3>() /= length;
  const Matrix6 held = X.transpose() * X;
  const Vector6 values = dense::find_eigenvalues(held);
  const auto left = (values.array() < kFree * values[5]).count();
  if (left == 0) return;
  throw InputError(fmt::format(
      "{}: the clamped nodes leave {} of six rigid motions free. Clamp more, "
      "such as a node with rotations or three nodes that are not on a line; or "
      "clamp nothing and hold the body by couplers",
      part.system.source, left));
}

/// Columns of the rows.
fem::SparseMatrix take_columns(const fem::SparseMatrix& A,
                               const std::vector<int>& columns) {
  fem::SparseMatrix taken(A.rows(), std::ssize(columns));
  for (Eigen::Index j = 0; j < taken.cols(); ++j) {
    taken.startVec(j);
    for (fem::SparseMatrix::InnerIterator it(
             A, columns[static_cast<std::size_t>(j)]);
         it; ++it)
      taken.insertBack(it.row(), j) = it.value();
  }
  taken.finalize();
  return taken;
}

Support make_matrix_support(const MatrixPart& part,
                            const std::vector<int>& rows, bool is_clamped) {
  Support support;
  support.is_clamped = is_clamped;
  support.matrices = restrict_system(part.system, rows);
  support.lift = take_columns(part.system.lift, rows);
  const MatrixX X = part.X(rows, Eigen::all);
  support.translations = X.leftCols<3>();
  support.R = is_clamped ? MatrixX(X.rows(), 0)
                         : orthonormalise_rigid(support.matrices, X);
  return support;
}

// Causes of ill-conditioning, as sentences for an error.
std::string describe_conditioning(const MatrixSystem& system) {
  if (system.notices.empty())
    return " Parts of very different stiffness meet in the matrices, or their "
           "digits do not suffice.";
  std::string causes;
  for (const std::string& notice : system.notices) causes += " " + notice + ".";
  return causes;
}

}  // namespace

struct MatrixBody::Parts {
  Parts(const Recipe& recipe, std::shared_ptr<const MatrixPart> its_part)
      : part(std::move(its_part)) {
    const MatrixSystem& system = part->system;
    refuse_options(system, recipe);
    check_basis(recipe);
    interfaces = find_interfaces(system, recipe);
    static_cast<void>(
        find_pattern_loads(field_row(static_cast<int>(system.tags.size()), 0),
                           recipe, interfaces));
    for (const std::string& name : recipe.rows.groups)
      static_cast<void>(find_matrix_nodes(system, name));
    const std::vector<int> clamped = find_clamped_rows(system, recipe);
    const bool is_clamped = !clamped.empty() || !system.held.empty();
    if (is_clamped) check_clamps(*part, clamped);
    rows = find_free_rows(system, clamped);
    if (rows.empty())
      throw InputError(fmt::format("{}: every row is clamped; nothing can move",
                                   system.source));
    support = make_matrix_support(*part, rows, is_clamped);
    shift = is_clamped ? 0.0 : part->shift;
  }

  std::shared_ptr<const MatrixPart> part;
  std::vector<Interface> interfaces;
  std::vector<int> rows;
  Support support;
  double shift = 0.0;
};

MatrixBody::MatrixBody(const Recipe& recipe,
                       std::shared_ptr<const MatrixPart> its_part)
    : MatrixBody(Parts(recipe, std::move(its_part))) {}

MatrixBody::MatrixBody(Parts parts)
    : ElasticBody(parts.part->system.source, std::move(parts.interfaces),
                  std::move(parts.support), parts.shift,
                  describe_conditioning(parts.part->system)),
      part(std::move(parts.part)),
      rows(std::move(parts.rows)) {}

}  // namespace limber::flexbody
