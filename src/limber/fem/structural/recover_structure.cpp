// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/recover_structure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/fem/structural/place_element.hpp"

namespace limber::fem {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// From components (xx, yy, zz, xy, yz, xz) in axes to those of the model.
Matrix6 turn_components(const Matrix3& axes) {
  constexpr std::array<std::array<int, 2>, 6> kPlaces = {
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  Matrix6 turn;
  for (int k = 0; k < 6; ++k) {
    const auto [a, b] = kPlaces[index(k)];
    Matrix3 unit = Matrix3::Zero();
    unit(a, b) = unit(b, a) = 1.0;
    const Matrix3 turned = axes * unit * axes.transpose();
    for (int i = 0; i < 6; ++i)
      turn(i, k) = turned(kPlaces[index(i)][0], kPlaces[index(i)][1]);
  }
  return turn;
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

/// A node of a shell's element.
struct Corner {
  std::size_t shell = 0;
  Matrix3 axes;     ///< of the element, turned to the mean normal
  MatrixX strains;  ///< 8 x m, as StructuralElement
};

/// Corners around a node whose stress is averaged.
struct CornerGroup {
  int face = -1;  ///< index into DrawnStructure::faces
  std::vector<Corner> corners;
};

/// Stress at a point of a beam's outline by its section forces.
Matrix6 calc_outline(const BeamSection& section,
                     const std::array<double, 2>& point) {
  const auto [y, z] = point;
  Matrix6 stress = Matrix6::Zero();
  stress(0, 0) = 1.0 / section.area;
  stress(0, 4) = z / section.I_y;
  stress(0, 5) = -y / section.I_z;
  const double r = std::hypot(y, z);
  stress(3, 3) = -z / (r * section.torsion_modulus);
  stress(5, 3) = y / (r * section.torsion_modulus);
  return stress;
}

/// What a recovery keeps of its model.
struct RecoveredModel {
  Structure structure;
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
    for (const CornerGroup& group : group_corners()) recover_group(group);
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
    const Matrix6 turn = turn_components(axes);
    const auto outline = list_outline(section);
    const bool has_points = section.torsion_modulus > 0.0;
    if (!has_points) ++result_.bare_beams;
    for (std::size_t end = 0; end < 2; ++end) {
      const int node = model_.places[index(nodes[end])];
      forces_.emplace_back(
          both.middleRows<6>(static_cast<Eigen::Index>(6 * end)));
      result_.ends.push_back({node, beam.tag});
      for (std::size_t k = 0; has_points && k < outline.size(); ++k) {
        stress_.emplace_back(turn * calc_outline(section, outline[k]) *
                             forces_.back());
        result_.points.push_back(
            {node, model_.drawn.outlines[b][end][k],
             static_cast<int>(structure_.laminates.size()) + beam.property,
             SectionFace::outline, static_cast<int>(k) + 1, axes,
             Vector6::Zero()});
      }
    }
  }

  // ---- shells
  [[nodiscard]] bool is_same_section(const Corner& a, const Corner& b) const {
    const StructureShell& first = structure_.shells[a.shell];
    const StructureShell& second = structure_.shells[b.shell];
    return first.laminate == second.laminate && first.offset == second.offset &&
           (is_isotropic(structure_.laminates[index(first.laminate)]) ||
            a.axes.col(0).dot(b.axes.col(0)) > kSameDirection);
  }

  [[nodiscard]] std::vector<CornerGroup> group_corners() const {
    std::vector<CornerGroup> groups;
    std::vector<std::vector<std::size_t>> of_face(model_.drawn.faces.size());
    for (std::size_t s = 0; s < structure_.shells.size(); ++s) {
      const StructureShell& shell = structure_.shells[s];
      const StructuralElement element = make_element(structure_, shell);
      for (std::size_t i = 0; i < shell.nodes.size(); ++i) {
        const int face = model_.drawn.corners[s][i];
        const Vector3 normal = model_.drawn.faces[index(face)].sum.normalized();
        const Matrix3& own = element.axes[i];
        Corner corner{
            s,
            Eigen::Quaterniond::FromTwoVectors(Vector3(own.col(2)), normal)
                    .toRotationMatrix() *
                own,
            find_motions(element.strains[i], shell.nodes)};
        std::vector<std::size_t>& known = of_face[index(face)];
        const auto found = std::ranges::find_if(known, [&](std::size_t g) {
          return is_same_section(groups[g].corners[0], corner);
        });
        const std::size_t g = found == known.end() ? groups.size() : *found;
        if (g == groups.size()) {
          known.push_back(g);
          groups.push_back({face, {}});
        }
        groups[g].corners.push_back(std::move(corner));
      }
    }
    return groups;
  }

  void recover_group(const CornerGroup& group) {
    const FaceNode& face = model_.drawn.faces[index(group.face)];
    const StructureShell& shell = structure_.shells[group.corners[0].shell];
    const Vector3 normal = face.sum.normalized();
    Vector3 axis = Vector3::Zero();
    for (const Corner& corner : group.corners) axis += corner.axes.col(0);
    if (!(axis.norm() > 0.1)) axis = group.corners[0].axes.col(0);
    const Laminate laminate = find_laminate(structure_, shell);
    const int node = model_.places[index(face.node)];
    for (const LaminatePoint& point : laminate.points) {
      MatrixX mean = MatrixX::Zero(6, motions_.cols());
      for (const Corner& corner : group.corners)
        mean += turn_components(corner.axes) *
                calc_stress(corner.strains, point, laminate.S);
      stress_.emplace_back(mean / static_cast<double>(group.corners.size()));
      Matrix3 axes;
      axes.col(2) = normal;
      axes.col(0) = Eigen::AngleAxisd(point.angle, normal) * axis.normalized();
      axes.col(1) = normal.cross(Vector3(axes.col(0)));
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

  void list_constants() {
    const auto& laminates = structure_.laminates;
    const auto& beams = structure_.beam_properties;
    result_.constants.resize(2, std::ssize(laminates) + std::ssize(beams));
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
  }

  const RecoveredModel& model_;
  const Structure& structure_;
  MatrixX motions_;  // of all nodes, six rows each
  SectionStress result_;
  std::vector<MatrixX> stress_;  // of each point
  std::vector<MatrixX> forces_;  // of each end
};

}  // namespace

RecoverSections make_recovery(const Structure& structure,
                              std::vector<int> places, const NodeMap& map,
                              DrawnStructure drawn) {
  const auto model = std::make_shared<const RecoveredModel>(
      RecoveredModel{structure, std::move(places), map, std::move(drawn)});
  return [model](const MatrixX& moved) {
    return StressRecovery(*model, moved).recover();
  };
}

}  // namespace limber::fem
