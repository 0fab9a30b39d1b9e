// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/assemble_structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/structural/draw_structure.hpp"
#include "limber/fem/structural/node_motions.hpp"
#include "limber/fem/structural/place_element.hpp"
#include "limber/fem/structural/recover_structure.hpp"

namespace limber::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// An element and the nodes of its unknowns.
struct PlacedElement {
  StructuralElement element;
  std::vector<int> nodes;
};

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
    throw InputError(fmt::format(
        "{}: it has moments of inertia and no mass. Expected a mass, too.",
        body.place));
  const Matrix3 S =
      0.5 * body.inertia.trace() * Matrix3::Identity() - body.inertia;
  const auto eigen = dense::find_eigenpairs(S);
  if (eigen.values.minCoeff() < -kRoundoff * body.inertia.trace())
    throw InputError(fmt::format(
        "{}: its moments of inertia are those of no body: the largest is more "
        "than the sum of the others. Expected I11, I21, I22, I31, I32, I33 "
        "about its centre of mass.",
        body.place));
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
  StructureAssembler(const Structure& structure, const StructureSolids& solids)
      : structure_(structure), solids_(solids), motions_(structure) {}

  AssembledStructure assemble() {
    list_elements();
    find_solid_nodes();
    find_used();
    number_rows();
    map_nodes();
    MatrixModel& model = result_.model;
    model.source = structure_.source;
    model.is_structure = true;
    model.found = structure_.found;
    model.notices = structure_.notices;
    note_hinges();
    note_first_order();
    sum_matrices();
    check_connected_nodes();
    take_sets();
    DrawnStructure drawn = draw_structure(
        {structure_, solids_, motions_, places_, solid_nodes_, map_}, model);
    model.recover_sections = make_recovery(structure_, solids_, solid_nodes_,
                                           places_, map_, std::move(drawn));
    return std::move(result_);
  }

 private:
  void list_elements() {
    for (const StructureBeam& beam : structure_.beams)
      elements_.push_back({make_element(structure_, beam),
                           {beam.nodes.begin(), beam.nodes.end()}});
    for (const StructureShell& shell : structure_.shells) {
      elements_.push_back({make_element(structure_, shell), shell.nodes});
      elements_.back().element.strains.clear();
    }
    for (const StructureMass& mass : structure_.masses)
      elements_.push_back({make_mass(mass), {mass.node}});
    for (PlacedElement& placed : elements_)
      for (MassPoint& point : placed.element.points) {
        point.mass *= structure_.mass_factor;
        result_.mass += point.mass;
      }
  }

  void find_solid_nodes() {
    std::unordered_map<std::size_t, int> node_of;
    for (std::size_t n = 0; n < structure_.tags.size(); ++n)
      node_of[structure_.tags[n]] = static_cast<int>(n);
    for (const std::size_t tag : solids_.mesh.tags)
      solid_nodes_.push_back(node_of.at(tag));
  }

  /// Nodes of elements, those that lead them, and those that move with them.
  void find_used() {
    used_.assign(structure_.tags.size(), 0);
    rotates_.assign(structure_.tags.size(), 0);
    std::vector<char> is_stiff(structure_.tags.size(), 0);
    const auto use = [&](int node, bool stiffens) {
      used_[index(node)] = 1;
      for (const auto& [root, contribution] :
           motions_.find_contributions(node)) {
        used_[index(root)] = 1;
        if (stiffens) is_stiff[index(root)] = 1;
        if (motions_.is_hub(root)) rotates_[index(root)] = 1;
      }
    };
    for (const PlacedElement& placed : elements_)
      for (const int node : placed.nodes) {
        const bool is_mass = placed.element.K.size() == 36;
        use(node, !is_mass);
        if (!is_mass && !motions_.is_led(node)) rotates_[index(node)] = 1;
      }
    for (const int node : solid_nodes_) use(node, true);
    const auto is_held = [&](int node) {
      const auto contributions = motions_.find_contributions(node);
      return std::ranges::all_of(contributions, [&](const auto& contribution) {
        return is_stiff[index(contribution.first)] != 0;
      });
    };
    for (int n = 0; n < static_cast<int>(used_.size()); ++n)
      if (motions_.is_led(n) && is_held(n)) use(n, false);
    for (const StructureMass& mass : structure_.masses) {
      if (!is_held(mass.node))
        throw InputError(fmt::format(
            "{}: no beam, shell or solid holds node {}, which has a mass. "
            "Expected an element or a rigid element on it.",
            mass.place, structure_.tags[index(mass.node)]));
      const bool rotates =
          !mass.offset.isZero(0.0) || !mass.inertia.isZero(0.0);
      if (rotates && !motions_.is_led(mass.node) && !rotates_[index(mass.node)])
        throw InputError(fmt::format(
            "{}: a mass with an offset or moments of inertia is at node {}, "
            "which is of solids alone and has no rotation. Expected its mass "
            "alone, or a rigid element.",
            mass.place, structure_.tags[index(mass.node)]));
    }
  }

  void number_rows() {
    MatrixModel& model = result_.model;
    places_.assign(structure_.tags.size(), -1);
    row_of_.assign(structure_.tags.size(), -1);
    std::vector<int> kept;
    std::size_t leading = 0;
    for (int n = 0; n < static_cast<int>(used_.size()); ++n) {
      if (!used_[index(n)]) continue;
      places_[index(n)] = static_cast<int>(kept.size());
      kept.push_back(n);
      model.tags.push_back(structure_.tags[index(n)]);
      if (motions_.is_led(n)) continue;
      ++leading;
      row_of_[index(n)] = static_cast<int>(model.rows.size());
      for (int c = 0; c < (rotates_[index(n)] ? 6 : 3); ++c)
        model.rows.push_back({places_[index(n)], c});
    }
    model.x = structure_.x(Eigen::all, kept);
    if (leading == 1 && kept.size() > 1)
      throw InputError(fmt::format(
          "{}: its rigid elements lead all nodes from one, so that nothing can "
          "deform. Expected an elastic part; a rigid body is a link with an "
          "<inertial>.",
          structure_.source));
  }

  /// Six unknowns of each node by the rows.
  void map_nodes() {
    Triplets triplets;
    for (int n = 0; n < static_cast<int>(used_.size()); ++n) {
      if (!used_[index(n)]) continue;
      for (const auto& [root, S] : motions_.find_contributions(n))
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j < (rotates_[index(root)] ? 6 : 3); ++j)
            if (S(i, j) != 0.0)
              triplets.emplace_back(6 * n + i, row_of_[index(root)] + j,
                                    S(i, j));
    }
    map_.resize(6 * std::ssize(used_), std::ssize(result_.model.rows));
    map_.setFromTriplets(triplets.begin(), triplets.end());
  }

  /// An edge of shells or an end of beams on a solid is a hinge, as it is in
  /// the programs that decks are of.
  void note_hinges() {
    std::vector<int> hinges;
    for (const int node : solid_nodes_)
      if (rotates_[index(node)] && !motions_.is_hub(node))
        hinges.push_back(node);
    if (hinges.empty()) return;
    result_.model.notices.push_back(fmt::format(
        "{}: beams and shells share {} nodes with solids, the first is {}. "
        "Solids hold displacements there and no rotation; a rigid element "
        "holds both.",
        structure_.source, hinges.size(),
        structure_.tags[index(hinges.front())]));
  }

  void note_first_order() {
    std::size_t count = 0;
    for (const ElementBlock& block : solids_.mesh.blocks)
      if (block.element->order == 1) count += block.size();
    if (count > 0)
      result_.model.notices.push_back(fmt::format(
          "{}: {} solids are of first order, which are too stiff in bending. "
          "Elements of second order have nodes on their edges, too.",
          structure_.source, count));
  }

  /// A, of six unknowns of each node, by the rows. @param T map_ by columns
  static Sparse reduce(const Triplets& triplets, const Sparse& T) {
    Sparse A(T.rows(), T.rows());
    A.setFromTriplets(triplets.begin(), triplets.end());
    return T.transpose() * Sparse(A * T);
  }

  static void add(const MatrixX& A, const std::vector<int>& nodes,
                  Triplets& triplets) {
    const auto place = [&](Eigen::Index i) {
      return 6 * nodes[static_cast<std::size_t>(i / 6)] +
             static_cast<int>(i % 6);
    };
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      for (Eigen::Index i = 0; i < A.rows(); ++i)
        if (A(i, j) != 0.0) triplets.emplace_back(place(i), place(j), A(i, j));
  }

  void sum_matrices() {
    StructuralMatrices solid;
    if (!solids_.mesh.blocks.empty()) {
      solid = assemble_elements(solids_.mesh, solids_.materials);
      result_.mass += solids_.unit * solid.M_s.sum();
    }
    MatrixModel& model = result_.model;
    const Sparse T = map_;
    const Sparse K = reduce(list_stiffness(solid), T);
    model.stiffness = {structure_.source, 0.5 * (K + Sparse(K.transpose())),
                       17};
    constexpr std::array<std::array<int, 2>, 6> kPlaces = {
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
    for (std::size_t i = 0; i < kPlaces.size(); ++i)
      model.moments[i] =
          reduce(list_moment(solid, kPlaces[i][0], kPlaces[i][1]), T);
    const Sparse M = model.moments[0] + model.moments[1] + model.moments[2];
    model.mass = {structure_.source, 0.5 * (M + Sparse(M.transpose())), 17};
  }

  [[nodiscard]] Triplets list_stiffness(const StructuralMatrices& solid) const {
    Triplets triplets;
    for (const auto& [element, nodes] : elements_)
      add(element.K, nodes, triplets);
    const auto place = [&](Eigen::Index i) {
      return 6 * solid_nodes_[static_cast<std::size_t>(i / 3)] +
             static_cast<int>(i % 3);
    };
    for (Eigen::Index j = 0; j < solid.K.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(solid.K, j); it; ++it) {
        const double value = solids_.unit * it.value();
        triplets.emplace_back(place(it.row()), place(j), value);
        if (it.row() != j)
          triplets.emplace_back(place(j), place(it.row()), value);
      }
    return triplets;
  }

  /// int u_a u_b dm of the unknowns, sides a and b.
  [[nodiscard]] Triplets list_moment(const StructuralMatrices& solid, int a,
                                     int b) const {
    Triplets triplets;
    for (const auto& [element, nodes] : elements_) {
      MatrixX sum = MatrixX::Zero(element.K.rows(), element.K.cols());
      for (const MassPoint& point : element.points)
        sum += point.mass * point.N.row(a).transpose() * point.N.row(b);
      add(sum, nodes, triplets);
    }
    for (Eigen::Index j = 0; j < solid.M_s.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(solid.M_s, j); it; ++it)
        triplets.emplace_back(
            6 * solid_nodes_[static_cast<std::size_t>(it.row())] + a,
            6 * solid_nodes_[static_cast<std::size_t>(j)] + b,
            solids_.unit * it.value());
    return triplets;
  }

  /// @throws InputError if the nodes fall apart, by the stiffness
  void check_connected_nodes() const {
    const MatrixModel& model = result_.model;
    const Sparse& K = model.stiffness.entries;
    std::vector<std::vector<int>> beside(model.tags.size());
    for (Eigen::Index j = 0; j < K.outerSize(); ++j)
      for (Sparse::InnerIterator it(K, j); it; ++it) {
        const int a = model.rows[static_cast<std::size_t>(j)].node;
        const int b = model.rows[static_cast<std::size_t>(it.row())].node;
        if (beside[index(a)].empty() || beside[index(a)].back() != b)
          beside[index(a)].push_back(b);
      }
    std::vector<char> is_reached(model.tags.size(), 0);
    std::vector<int> firsts;
    for (const MatrixRow& row : model.rows) {
      if (is_reached[index(row.node)]) continue;
      is_reached[index(row.node)] = 1;
      firsts.push_back(row.node);
      for (std::vector<int> open = {row.node}; !open.empty();) {
        const int at = open.back();
        open.pop_back();
        for (const int other : beside[index(at)])
          if (!std::exchange(is_reached[index(other)], 1))
            open.push_back(other);
      }
    }
    if (firsts.size() < 2) return;
    throw InputError(fmt::format(
        "{}: its elements are in {} parts that nothing joins, one with node "
        "{}, another with node {}. Expected one body: nodes that both have, or "
        "rigid elements between them.",
        structure_.source, firsts.size(), model.tags[index(firsts[0])],
        model.tags[index(firsts[1])]));
  }

  void add_set(const std::string& name, const std::vector<int>& nodes) {
    if (nodes.empty()) return;
    auto& sets = result_.model.sets;
    auto at = std::ranges::find(sets, name, &MatrixNodeSet::name);
    if (at == sets.end()) at = sets.insert(at, {name, {}});
    std::set<int> all(at->nodes.begin(), at->nodes.end());
    all.insert(nodes.begin(), nodes.end());
    at->nodes.assign(all.begin(), all.end());
  }

  void take_sets() {
    for (const MatrixNodeSet& set : structure_.sets) {
      std::vector<int> kept;
      for (const int node : set.nodes)
        if (places_[index(node)] >= 0) kept.push_back(places_[index(node)]);
      add_set(set.name, kept);
    }
    for (const PhysicalGroup& group : solids_.mesh.groups) {
      std::vector<int> kept;
      for (const int node : group.nodes)
        kept.push_back(places_[index(solid_nodes_[index(node)])]);
      add_set(group.name, kept);
    }
  }

  const Structure& structure_;
  const StructureSolids& solids_;
  NodeMotions motions_;
  AssembledStructure result_;
  std::vector<PlacedElement> elements_;
  std::vector<int> solid_nodes_;  // of the mesh, in the structure
  std::vector<char> used_;
  std::vector<char> rotates_;  // of nodes with rows: six of them
  std::vector<int> places_;    // of nodes in the model; -1: left out
  std::vector<int> row_of_;
  NodeMap map_;
};

}  // namespace

AssembledStructure assemble_structure(const Structure& structure,
                                      const StructureSolids& solids) {
  return StructureAssembler(structure, solids).assemble();
}

}  // namespace limber::fem
