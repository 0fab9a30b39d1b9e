// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/assemble_structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/structural/draw_structure.hpp"
#include "limber/fem/structural/shell_element.hpp"

namespace limber::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// An element and the nodes of its unknowns.
struct PlacedElement {
  StructuralElement element;
  std::vector<int> nodes;
};

/// What `make` makes. @throws InputError with the place, where `make` has none
StructuralElement make_at(const std::string& place,
                          const std::function<StructuralElement()>& make) {
  try {
    return make();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", place, error.what()));
  }
}

Vector3 find_axis(const StructureShell& shell, const Matrix3X& x) {
  const Vector3 side = x.col(1) - x.col(0);
  Vector3 axis = shell.axis.isZero(0.0) ? side : shell.axis;
  if (shell.angle == 0.0) return axis;
  const Vector3 n = side.cross(Vector3(x.col(x.cols() - 1) - x.col(0)));
  return exp_rotation(shell.angle * n.normalized()) *
         Vector3(axis - n * n.dot(axis) / n.squaredNorm());
}

/// Mass points of a rigid body: three pairs along its principal axes.
StructuralElement make_mass(const StructureMass& body) {
  StructuralElement element;
  element.K = MatrixX::Zero(6, 6);
  const auto add = [&](double mass, const Vector3& d) {
    MatrixX N(3, 6);
    N << Matrix3::Identity(), -skew(d);
    element.points.push_back({mass, std::move(N)});
  };
  if (body.inertia.isZero(0.0)) {
    if (body.mass > 0.0) add(body.mass, body.offset);
    return element;
  }
  constexpr double kRoundoff = 1e-9;
  if (!(body.mass > 0.0))
    throw InputError(
        "it has moments of inertia and no mass. Expected a mass, too.");
  const Matrix3 S =
      0.5 * body.inertia.trace() * Matrix3::Identity() - body.inertia;
  const auto eigen = dense::find_eigenpairs(S);
  if (eigen.values.minCoeff() < -kRoundoff * body.inertia.trace())
    throw InputError(
        "its moments of inertia are those of no body: the largest is more "
        "than the sum of the others. Expected I11, I21, I22, I31, I32, I33 "
        "about its centre of mass.");
  for (int a = 0; a < 3; ++a) {
    const Vector3 d =
        std::sqrt(3.0 * std::max(eigen.values[a], 0.0) / body.mass) *
        eigen.vectors.col(a);
    add(body.mass / 6.0, body.offset + d);
    add(body.mass / 6.0, body.offset - d);
  }
  return element;
}

class StructureAssembler {
 public:
  explicit StructureAssembler(const Structure& structure)
      : structure_(structure) {}

  AssembledStructure assemble() {
    list_elements();
    find_leaders();
    find_used();
    number_rows();
    MatrixModel& model = result_.model;
    model.source = structure_.source;
    model.found = structure_.found;
    model.notices = structure_.notices;
    model.stiffness = {structure_.source, sum_stiffness(), 17};
    constexpr std::array<std::array<int, 2>, 6> kPlaces = {
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
    for (std::size_t i = 0; i < kPlaces.size(); ++i)
      model.moments[i] = sum_moment(kPlaces[i][0], kPlaces[i][1]);
    model.mass = {structure_.source,
                  model.moments[0] + model.moments[1] + model.moments[2], 17};
    take_sets();
    draw_structure(structure_, places_, motions_, model);
    return std::move(result_);
  }

 private:
  void list_elements() {
    for (const StructureBeam& beam : structure_.beams) {
      const BeamProperty& property =
          structure_.beam_properties[index(beam.property)];
      elements_.push_back({make_at(beam.place,
                                   [&] {
                                     return make_beam(
                                         {{structure_.x.col(beam.nodes[0]),
                                           structure_.x.col(beam.nodes[1])},
                                          beam.offsets,
                                          beam.up},
                                         property.section, property.material);
                                   }),
                           {beam.nodes.begin(), beam.nodes.end()}});
    }
    for (const StructureShell& shell : structure_.shells) {
      const Matrix3X x = structure_.x(Eigen::all, shell.nodes);
      const Laminate laminate = shift_laminate(
          structure_.laminates[index(shell.laminate)], shell.offset);
      const ShellShape shape{x, find_axis(shell, x)};
      elements_.push_back(
          {make_at(shell.place,
                   [&] {
                     return shell.nodes.size() == 3
                                ? make_triangle_shell(shape, laminate)
                                : make_quad_shell(shape, laminate);
                   }),
           shell.nodes});
    }
    for (const StructureMass& mass : structure_.masses)
      elements_.push_back(
          {make_at(mass.place, [&] { return make_mass(mass); }), {mass.node}});
    for (PlacedElement& placed : elements_)
      for (MassPoint& point : placed.element.points) {
        point.mass *= structure_.mass_factor;
        result_.mass += point.mass;
      }
  }

  void find_leaders() {
    leaders_.assign(structure_.tags.size(), -1);
    std::vector<const StructureSpider*> spiders(structure_.tags.size());
    for (const StructureSpider& spider : structure_.spiders)
      for (const int node : spider.nodes) {
        if (node == spider.reference) continue;
        if (leaders_[index(node)] >= 0)
          throw InputError(fmt::format(
              "{}: node {} moves with another rigid element already ({}). "
              "Expected it to depend on one node.",
              spider.place, structure_.tags[index(node)],
              spiders[index(node)]->place));
        leaders_[index(node)] = spider.reference;
        spiders[index(node)] = &spider;
      }
    for (std::size_t n = 0; n < leaders_.size(); ++n) {
      std::size_t steps = 0;
      for (int at = leaders_[n]; at >= 0; at = leaders_[index(at)])
        if (++steps > leaders_.size())
          throw InputError(
              fmt::format("{}: node {} moves, by a chain of rigid elements, "
                          "with itself. Expected one node that leads.",
                          spiders[n]->place, structure_.tags[n]));
    }
  }

  [[nodiscard]] int find_root(int node) const {
    while (leaders_[index(node)] >= 0) node = leaders_[index(node)];
    return node;
  }

  /// Nodes of elements, and those that lead them.
  void find_used() {
    used_.assign(structure_.tags.size(), 0);
    std::vector<char> is_stiff(structure_.tags.size(), 0);
    for (const PlacedElement& placed : elements_) {
      for (const int node : placed.nodes) {
        used_[index(node)] = used_[index(find_root(node))] = 1;
        if (placed.element.K.size() > 36) is_stiff[index(find_root(node))] = 1;
      }
    }
    for (const StructureSpider& spider : structure_.spiders)
      for (const int node : spider.nodes)
        if (is_stiff[index(find_root(node))]) used_[index(node)] = 1;
    for (const StructureMass& mass : structure_.masses)
      if (!is_stiff[index(find_root(mass.node))])
        throw InputError(fmt::format(
            "{}: no beam or shell holds node {}, which has a mass. Expected "
            "an element or a rigid element on it.",
            mass.place, structure_.tags[index(mass.node)]));
  }

  void number_rows() {
    MatrixModel& model = result_.model;
    places_.assign(structure_.tags.size(), -1);
    row_of_.assign(structure_.tags.size(), -1);
    std::vector<int> kept;
    for (std::size_t n = 0; n < used_.size(); ++n) {
      if (!used_[n]) continue;
      places_[n] = static_cast<int>(kept.size());
      kept.push_back(static_cast<int>(n));
      model.tags.push_back(structure_.tags[n]);
      if (leaders_[n] >= 0) continue;
      row_of_[n] = static_cast<int>(model.rows.size());
      for (int c = 0; c < 6; ++c) model.rows.push_back({places_[n], c});
    }
    model.x = structure_.x(Eigen::all, kept);
    motions_.resize(structure_.tags.size());
    for (const int n : kept) {
      const int root = find_root(n);
      motions_[index(n)] = {row_of_[index(root)],
                            structure_.x.col(n) - structure_.x.col(root)};
    }
  }

  [[nodiscard]] Sparse make_square(const Triplets& triplets) const {
    const auto n = static_cast<Eigen::Index>(result_.model.rows.size());
    Sparse A(n, n);
    A.setFromTriplets(triplets.begin(), triplets.end());
    return A;
  }

  /// Columns of an element's matrix, by the rows of the nodes that lead.
  [[nodiscard]] MatrixX lead(const MatrixX& A,
                             const std::vector<int>& nodes) const {
    MatrixX led = A;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vector3& d = motions_[index(nodes[i])].arm;
      if (d.isZero(0.0)) continue;
      const auto at = static_cast<Eigen::Index>(6 * i);
      led.middleCols<3>(at + 3) -= A.middleCols<3>(at) * skew(d);
    }
    return led;
  }

  void add(const MatrixX& A, const std::vector<int>& nodes,
           Triplets& triplets) const {
    std::vector<int> rows;
    for (const int node : nodes)
      for (int c = 0; c < 6; ++c) rows.push_back(motions_[index(node)].row + c);
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      for (Eigen::Index i = 0; i < A.rows(); ++i)
        if (A(i, j) != 0.0)
          triplets.emplace_back(rows[static_cast<std::size_t>(i)],
                                rows[static_cast<std::size_t>(j)], A(i, j));
  }

  [[nodiscard]] Sparse sum_stiffness() const {
    Triplets triplets;
    for (const auto& [element, nodes] : elements_) {
      const MatrixX half = lead(element.K, nodes);
      const MatrixX whole = lead(half.transpose(), nodes);
      add(0.5 * (whole + whole.transpose()), nodes, triplets);
    }
    return make_square(triplets);
  }

  /// int u_a u_b dm of the unknowns, sides a and b.
  [[nodiscard]] Sparse sum_moment(int a, int b) const {
    Triplets triplets;
    for (const auto& [element, nodes] : elements_) {
      MatrixX sum = MatrixX::Zero(element.K.rows(), element.K.cols());
      for (const MassPoint& point : element.points) {
        const MatrixX N = lead(point.N, nodes);
        sum += point.mass * N.row(a).transpose() * N.row(b);
      }
      add(sum, nodes, triplets);
    }
    return make_square(triplets);
  }

  void take_sets() {
    for (const MatrixNodeSet& set : structure_.sets) {
      MatrixNodeSet kept{set.name, {}};
      for (const int node : set.nodes)
        if (places_[index(node)] >= 0)
          kept.nodes.push_back(places_[index(node)]);
      if (!kept.nodes.empty()) result_.model.sets.push_back(std::move(kept));
    }
  }

  const Structure& structure_;
  AssembledStructure result_;
  std::vector<PlacedElement> elements_;
  std::vector<int> leaders_;  // by node; -1: it has rows of its own
  std::vector<char> used_;
  std::vector<int> places_;  // of nodes in the model; -1: left out
  std::vector<int> row_of_;
  std::vector<NodeMotion> motions_;
};

}  // namespace

AssembledStructure assemble_structure(const Structure& structure) {
  return StructureAssembler(structure).assemble();
}

}  // namespace limber::fem
