// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/recover_structure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/common/material/anisotropy.hpp"
#include "limber/fem/linalg/linear_fit.hpp"
#include "limber/fem/solid/stress_recovery.hpp"
#include "limber/fem/structural/place_element.hpp"
#include "limber/fem/structural/shell_axes.hpp"

namespace limber::fem {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Matrix2X = Eigen::Matrix<double, 2, Eigen::Dynamic>;

/// From components (xx, yy, zz, xy, yz, xz) in axes to those of the model.
Matrix6 rotate_components(const Matrix3& axes) {
  constexpr std::array<std::array<int, 2>, 6> kPlaces = {
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  Matrix6 rotation;
  for (int k = 0; k < 6; ++k) {
    const auto [a, b] = kPlaces[index(k)];
    Matrix3 unit = Matrix3::Zero();
    unit(a, b) = unit(b, a) = 1.0;
    const Matrix3 rotated = axes * unit * axes.transpose();
    for (int i = 0; i < 6; ++i)
      rotation(i, k) = rotated(kPlaces[index(i)][0], kPlaces[index(i)][1]);
  }
  return rotation;
}

bool is_isotropic(const Laminate& laminate) {
  constexpr double kRoundoff = 1e-9;
  return std::ranges::all_of(laminate.points, [](const LaminatePoint& point) {
    return std::ranges::all_of(
        std::array{&point.membrane, &point.bending}, [](const Matrix3* Q) {
          const double size = kRoundoff * Q->norm();
          return std::abs((*Q)(0, 0) - (*Q)(1, 1)) <= size &&
                 std::abs((*Q)(0, 0) - (*Q)(0, 1) - 2.0 * (*Q)(2, 2)) <= size;
        });
  });
}

/// Strains of a shell's element: of a quadrilateral at its nodes, of a triangle
/// in its middle.
struct SampledShell {
  std::vector<MatrixX> strains;  ///< 8 x m each, as StructuralElement
  std::vector<Matrix3> axes;     ///< beside strains
  Vector3 middle;
  std::vector<int> groups;  ///< of its corners
};

/// Corners around a node that have one stress.
struct CornerGroup {
  int face = -1;  ///< index into DrawnStructure::faces
  std::vector<std::size_t> shells;
  std::vector<std::size_t> corners;  ///< of each shell
  Vector3 fibre;                     ///< axis 1 of the first
  bool has_triangles = false;
};

/// A sample's part of the strains at a node.
struct Contribution {
  std::size_t shell = 0;
  std::size_t sample = 0;
  double weight = 0.0;
};

/// Of strains in a shell's axes to those that R turns them to. @param R axes in
/// the others
Matrix8 rotate_strains(const Matrix3& R) {
  Matrix8 T = Matrix8::Zero();
  T.topLeftCorner<3, 3>() = T.block<3, 3>(3, 3) =
      rotate_strain(R.topLeftCorner<2, 2>());
  T.bottomRightCorner<2, 2>() = R.topLeftCorner<2, 2>();
  return T;
}

/// Stress at a point of a beam's section by its section forces.
Matrix6 calc_beam_stress(const BeamSection& section, const SectionPoint& at) {
  Matrix6 stress = Matrix6::Zero();
  stress(0, 0) = 1.0 / section.area;
  stress(0, 4) = at.z / section.I_y;
  stress(0, 5) = -at.y / section.I_z;
  for (const auto& [force, shear] :
       {std::pair{1, at.shear_y}, {2, at.shear_z}, {3, at.torsion}}) {
    stress(3, force) = shear[0];
    stress(5, force) = shear[1];
  }
  return stress;
}

/// What a recovery keeps of its model.
struct RecoveredModel {
  Structure structure;
  StructureSolids solids;
  std::vector<int> solid_nodes;
  std::vector<int> places;
  NodeMap map;
  DrawnStructure drawn;
};

class StressRecovery {
 public:
  StressRecovery(const RecoveredModel& model, const MatrixX& motions)
      : model_(model),
        structure_(model.structure),
        motions_(model.map * motions) {}

  SectionStress recover() {
    for (std::size_t b = 0; b < structure_.beams.size(); ++b) recover_beam(b);
    sample_shells();
    for (const CornerGroup& group : groups_) recover_group(group);
    if (!model_.solids.mesh.blocks.empty()) recover_solids();
    result_.stress = stack(stress_);
    result_.forces = stack(forces_);
    list_constants();
    return std::move(result_);
  }

 private:
  /// A times the motions of an element's nodes.
  [[nodiscard]] MatrixX find_motions(const MatrixX& A,
                                     const std::vector<int>& nodes) const {
    MatrixX moved = MatrixX::Zero(A.rows(), motions_.cols());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      moved += A.middleCols<6>(6 * static_cast<Eigen::Index>(i)) *
               motions_.middleRows<6>(Eigen::Index{6} * nodes[i]);
    return moved;
  }

  [[nodiscard]] MatrixX stack(const std::vector<MatrixX>& blocks) const {
    MatrixX all(6 * std::ssize(blocks), motions_.cols());
    for (std::size_t i = 0; i < blocks.size(); ++i)
      all.middleRows<6>(6 * static_cast<Eigen::Index>(i)) = blocks[i];
    return all;
  }

  // ---- beams
  void recover_beam(std::size_t b) {
    const StructureBeam& beam = structure_.beams[b];
    const BeamSection& section =
        structure_.beam_properties[index(beam.property)].section;
    const std::vector<int> nodes(beam.nodes.begin(), beam.nodes.end());
    const MatrixX both =
        find_motions(make_element(structure_, beam).section_forces, nodes);
    const Matrix3 axes = find_axes(structure_, beam);
    const Matrix6 rotation = rotate_components(axes);
    if (section.points.empty()) ++result_.bare_beams;
    for (std::size_t end = 0; end < 2; ++end) {
      const int node = model_.places[index(nodes[end])];
      forces_.emplace_back(
          both.middleRows<6>(static_cast<Eigen::Index>(6 * end)));
      result_.ends.push_back({node, beam.tag});
      const std::vector<int>& corners = model_.drawn.outlines[b][end];
      std::array<int, 2> numbers = {0, 0};  // on the outline, inside of it
      for (std::size_t k = 0; k < section.points.size(); ++k) {
        const SectionPoint& at = section.points[k];
        stress_.emplace_back(rotation * calc_beam_stress(section, at) *
                             forces_.back());
        result_.points.push_back(
            {node, k < corners.size() ? corners[k] : node,
             static_cast<int>(structure_.laminates.size()) + beam.property,
             at.is_inner ? SectionFace::inner : SectionFace::outline,
             ++numbers[at.is_inner ? 1 : 0], axes, Vector6::Zero()});
      }
    }
  }

  // ---- shells
  /// Of an element, rotated to a normal.
  static Matrix3 rotate_axes(const Matrix3& axes, const Vector3& normal) {
    return Eigen::Quaterniond::FromTwoVectors(Vector3(axes.col(2)), normal)
               .toRotationMatrix() *
           axes;
  }

  [[nodiscard]] Vector3 normal_of(const CornerGroup& group) const {
    return model_.drawn.faces[index(group.face)].sum.normalized();
  }

  [[nodiscard]] bool is_same_section(const CornerGroup& group,
                                     const StructureShell& second,
                                     const Vector3& fibre) const {
    const StructureShell& first = structure_.shells[group.shells[0]];
    return first.laminate == second.laminate && first.offset == second.offset &&
           (is_isotropic(structure_.laminates[index(first.laminate)]) ||
            group.fibre.dot(fibre) > kSameDirection);
  }

  void sample_shells() {
    std::vector<std::vector<int>> of_face(model_.drawn.faces.size());
    for (std::size_t s = 0; s < structure_.shells.size(); ++s) {
      const StructureShell& shell = structure_.shells[s];
      const StructuralElement element = make_element(structure_, shell);
      SampledShell& sampled = shells_.emplace_back();
      sampled.middle = structure_.x(Eigen::all, shell.nodes).rowwise().mean();
      if (shell.nodes.size() == 3) {
        const MatrixX mean =
            (element.strains[0] + element.strains[1] + element.strains[2]) /
            3.0;
        sampled.strains = {find_motions(mean, shell.nodes)};
        sampled.axes = {element.axes[0]};
      } else {
        for (const MatrixX& strains : element.strains)
          sampled.strains.push_back(find_motions(strains, shell.nodes));
        sampled.axes = element.axes;
      }
      for (std::size_t i = 0; i < shell.nodes.size(); ++i) {
        const int face = model_.drawn.corners[s][i];
        const Vector3 normal = model_.drawn.faces[index(face)].sum.normalized();
        const Vector3 fibre = rotate_axes(element.axes[i], normal).col(0);
        std::vector<int>& known = of_face[index(face)];
        const auto found = std::ranges::find_if(known, [&](int g) {
          return is_same_section(groups_[index(g)], shell, fibre);
        });
        const int g =
            found == known.end() ? static_cast<int>(groups_.size()) : *found;
        if (g == static_cast<int>(groups_.size())) {
          known.push_back(g);
          groups_.push_back({face, {}, {}, fibre, false});
        }
        CornerGroup& group = groups_[index(g)];
        group.shells.push_back(s);
        group.corners.push_back(i);
        group.has_triangles |= shell.nodes.size() == 3;
        sampled.groups.push_back(g);
      }
    }
  }

  /// Of nodes without triangles the mean of the elements' own; else by patches:
  /// around the node, of one at an edge around its neighbours inside.
  [[nodiscard]] std::vector<Contribution> list_contributions(
      const CornerGroup& group) const {
    std::vector<Contribution> contributions;
    if (!group.has_triangles) {
      const double weight = 1.0 / static_cast<double>(group.shells.size());
      for (std::size_t k = 0; k < group.shells.size(); ++k)
        contributions.push_back({group.shells[k], group.corners[k], weight});
      return contributions;
    }
    if (is_inside(group)) {
      add_fit(group, group.shells, 1.0, contributions);
      return contributions;
    }
    std::set<int> neighbours;
    std::set<std::size_t> around;
    for (const std::size_t s : group.shells)
      for (const int g : shells_[s].groups) {
        const CornerGroup& other = groups_[index(g)];
        around.insert(other.shells.begin(), other.shells.end());
        if (is_inside(other)) neighbours.insert(g);
      }
    for (const int g : neighbours)
      add_fit(group, groups_[index(g)].shells,
              1.0 / static_cast<double>(neighbours.size()), contributions);
    if (neighbours.empty())
      add_fit(group, {around.begin(), around.end()}, 1.0, contributions);
    return contributions;
  }

  /// The value at a group's node of the polynomial through the middles of a
  /// patch of shells, times a factor.
  void add_fit(const CornerGroup& group, const std::vector<std::size_t>& patch,
               double factor, std::vector<Contribution>& contributions) const {
    const Vector3 normal = normal_of(group);
    const Vector3 node =
        structure_.x.col(model_.drawn.faces[index(group.face)].node);
    Eigen::Matrix<double, 2, 3> plane;
    plane.row(0) = normal.unitOrthogonal();
    plane.row(1) = normal.cross(Vector3(plane.row(0)));
    Matrix2X places(2, std::ssize(patch));
    for (std::size_t i = 0; i < patch.size(); ++i)
      places.col(static_cast<Eigen::Index>(i)) =
          plane * (shells_[patch[i]].middle - node);
    const VectorX weights = find_linear_fit(places);
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const std::size_t samples = shells_[patch[i]].strains.size();
      for (std::size_t k = 0; k < samples; ++k)
        contributions.push_back(
            {patch[i], k,
             factor * weights[static_cast<Eigen::Index>(i)] /
                 static_cast<double>(samples)});
    }
  }

  /// Whether the shells of a group close around its node.
  [[nodiscard]] bool is_inside(const CornerGroup& group) const {
    std::map<int, int> spokes;
    for (std::size_t k = 0; k < group.shells.size(); ++k) {
      const std::vector<int>& polygon = shells_[group.shells[k]].groups;
      const std::size_t n = polygon.size();
      ++spokes[polygon[(group.corners[k] + 1) % n]];
      ++spokes[polygon[(group.corners[k] + n - 1) % n]];
    }
    return std::ranges::all_of(
        spokes, [](const auto& spoke) { return spoke.second == 2; });
  }

  /// Mean axis 1 of its shells, axis 2 and normal.
  [[nodiscard]] Matrix3 find_axes_of(const CornerGroup& group) const {
    const Vector3 normal = normal_of(group);
    Vector3 sum = Vector3::Zero();
    for (std::size_t k = 0; k < group.shells.size(); ++k) {
      const std::vector<Matrix3>& axes = shells_[group.shells[k]].axes;
      sum +=
          rotate_axes(axes[std::min(group.corners[k], axes.size() - 1)], normal)
              .col(0);
    }
    Matrix3 axes;
    axes.col(0) = sum.norm() > 0.1 ? sum.normalized() : group.fibre;
    axes.col(1) = normal.cross(Vector3(axes.col(0)));
    axes.col(2) = normal;
    return axes;
  }

  void recover_group(const CornerGroup& group) {
    const FaceNode& face = model_.drawn.faces[index(group.face)];
    const StructureShell& shell = structure_.shells[group.shells[0]];
    const Matrix3 own = find_axes_of(group);
    MatrixX strains = MatrixX::Zero(8, motions_.cols());
    for (const auto& [s, sample, weight] : list_contributions(group))
      strains +=
          weight *
          rotate_strains(own.transpose() *
                         rotate_axes(shells_[s].axes[sample], own.col(2))) *
          shells_[s].strains[sample];
    const Laminate laminate = find_laminate(structure_, shell);
    const int node = model_.places[index(face.node)];
    const Matrix6 rotation = rotate_components(own);
    for (const LaminatePoint& point : laminate.points) {
      stress_.emplace_back(rotation * calc_stress(strains, point, laminate.S));
      Matrix3 axes = own;
      axes.leftCols<2>() = Eigen::AngleAxisd(point.angle, Vector3(own.col(2)))
                               .toRotationMatrix() *
                           own.leftCols<2>();
      const int drawn = point.face == SectionFace::bottom ? face.drawn[0]
                        : point.face == SectionFace::top  ? face.drawn[1]
                                                          : node;
      result_.points.push_back({node, drawn, shell.laminate, point.face,
                                point.ply, axes, point.strengths});
    }
  }

  /// Components in the axes of the strains, 6 x m.
  static MatrixX calc_stress(const MatrixX& strains, const LaminatePoint& point,
                             const Matrix2& S) {
    const MatrixX in_plane = point.membrane * strains.topRows<3>() +
                             point.bending * strains.middleRows<3>(3);
    const MatrixX shear =
        point.shear.asDiagonal() * S * strains.bottomRows<2>();
    MatrixX stress = MatrixX::Zero(6, strains.cols());
    stress.row(0) = in_plane.row(0);
    stress.row(1) = in_plane.row(1);
    stress.row(3) = in_plane.row(2);
    stress.row(4) = shear.row(1);
    stress.row(5) = shear.row(0);
    return stress;
  }

  // ---- solids
  /// In SI units, from there in those of the deck.
  void recover_solids() {
    const StructureSolids& solids = model_.solids;
    const double unit = solids.unit;
    const std::vector<int>& nodes = model_.solid_nodes;
    MatrixX Phi(3 * std::ssize(nodes), motions_.cols());
    for (std::size_t n = 0; n < nodes.size(); ++n)
      Phi.middleRows<3>(3 * static_cast<Eigen::Index>(n)) =
          unit * motions_.middleRows<3>(Eigen::Index{6} * nodes[n]);
    const NodalStress nodal =
        recover_stress(solids.mesh, solids.materials, Phi);
    const auto& boundary = solids.mesh.boundary_nodes;
    const auto first = static_cast<int>(structure_.laminates.size() +
                                        structure_.beam_properties.size());
    for (std::size_t i = 0; i < nodal.nodes.size(); ++i) {
      stress_.emplace_back(unit * unit *
                           nodal.stress.col(static_cast<Eigen::Index>(i))
                               .reshaped(6, Phi.cols()));
      const int node = model_.places[index(nodes[index(nodal.nodes[i])])];
      result_.points.push_back(
          {node, node, first + nodal.materials[i], SectionFace::solid, 0,
           find_axes(nodal.constants[index(nodal.materials[i])],
                     solids.mesh.x.col(nodal.nodes[i])),
           Vector6::Zero(),
           std::ranges::binary_search(boundary, nodal.nodes[i])});
    }
    solid_constants_ = nodal.constants;
  }

  void list_constants() {
    const auto& laminates = structure_.laminates;
    const auto& beams = structure_.beam_properties;
    result_.constants.resize(2, std::ssize(laminates) + std::ssize(beams) +
                                    std::ssize(solid_constants_));
    Eigen::Index i = 0;
    for (const Laminate& laminate : laminates) {
      const Matrix3& A = laminate.A;
      result_.constants.col(i++) << (A(0, 0) - A(0, 1) * A(0, 1) / A(1, 1)) /
                                        (laminate.top - laminate.bottom),
          A(0, 1) / A(1, 1);
    }
    for (const BeamProperty& beam : beams) {
      const BeamMaterial& m = beam.material;
      result_.constants.col(i++) << m.youngs_modulus, m.poissons_ratio();
    }
    const double area = model_.solids.unit * model_.solids.unit;
    for (const ElasticMaterial& m : solid_constants_)
      result_.constants.col(i++) << area * m.youngs_modulus, m.poisson_ratio;
  }

  const RecoveredModel& model_;
  const Structure& structure_;
  MatrixX motions_;  // of all nodes, six rows each
  std::vector<SampledShell> shells_;
  std::vector<CornerGroup> groups_;
  std::vector<ElasticMaterial> solid_constants_;
  SectionStress result_;
  std::vector<MatrixX> stress_;  // of each point
  std::vector<MatrixX> forces_;  // of each end
};

}  // namespace

RecoverSections make_recovery(const Structure& structure,
                              const StructureSolids& solids,
                              std::vector<int> solid_nodes,
                              std::vector<int> places, const NodeMap& map,
                              DrawnStructure drawn) {
  const auto model = std::make_shared<const RecoveredModel>(
      RecoveredModel{structure, solids, std::move(solid_nodes),
                     std::move(places), map, std::move(drawn)});
  return [model](const MatrixX& moved) {
    return StressRecovery(*model, moved).recover();
  };
}

}  // namespace limber::fem
