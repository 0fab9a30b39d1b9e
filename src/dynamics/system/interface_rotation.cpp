// SPDX-License-Identifier: BSD-3-Clause
#include "scene/rotation_check.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <string>

#include "common/errors.hpp"
#include "common/overloaded.hpp"
#include "scene/naming.hpp"

namespace limber::scene {
namespace {

using flexbody::InterfaceTable;

/// A direction counts as asked from this share of the largest on.
constexpr double kNothing = 1e-12;
/// Directions this near to each other are the same [rad]: URDF files round
/// their angles, 1.5708 for pi / 2.
constexpr double kTilt = 1e-4;

Matrix3 normalised(const Matrix3& matrix) {
  const double size = matrix.norm();
  return size > 0.0 ? Matrix3(matrix / size) : matrix;
}

/// Orthonormal basis of the directions in which `matrix`, symmetric and
/// positive semi-definite, is not zero.
Matrix3X find_range(const Matrix3& matrix) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(matrix);
  const double largest = eigen.eigenvalues()[2];
  Matrix3X range(3, 0);
  for (int k = 0; k < 3; ++k) {
    if (!(eigen.eigenvalues()[k] > kNothing * largest)) continue;
    range.conservativeResize(3, range.cols() + 1);
    range.rightCols<1>() = eigen.eigenvectors().col(k);
  }
  return range;
}

/// Of the directions that `missing` spans, those that `asked` reaches.
Matrix3X find_asked(const Matrix3X& missing, const Matrix3X& asked) {
  if (missing.cols() == 0 || asked.cols() == 0) return Matrix3X(3, 0);
  const MatrixX overlap = asked.transpose() * missing;
  const Eigen::JacobiSVD<MatrixX> svd(overlap, Eigen::ComputeFullV);
  const Eigen::Index count = (svd.singularValues().array() > kTilt).count();
  return missing * svd.matrixV().leftCols(count);
}

/// A direction without sign and without digits of rounding.
std::string to_text(const Vector3& direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  const Vector3 e = direction[largest] < 0.0 ? Vector3(-direction) : direction;
  const auto cut = [](double x) { return std::abs(x) < 1e-6 ? 0.0 : x; };
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", cut(e[0]), cut(e[1]),
                     cut(e[2]));
}

/// A bushing's coupling of translation and rotation asks no more: its matrices
/// are positive semi-definite.
AskedSides find_asked_by(const joints::Bushing::Parameters& bushing) {
  const Matrix3 asked = normalised(bushing.rotational_stiffness) +
                        normalised(bushing.rotational_damping);
  return {asked, asked};
}

/// The direction that it holds, a x R b, is normal to a in F and to b in M.
AskedSides find_asked_by(const joints::UniversalHold::Parameters& hold) {
  if (hold.rotational_stiffness == 0.0 && hold.rotational_damping == 0.0) {
    return {};
  }
  const auto normal_to = [](const Vector3& axis) -> Matrix3 {
    return Matrix3::Identity() - rotation_about(axis.normalized());
  };
  return {normal_to(hold.axis_F), normal_to(hold.axis_M)};
}

AskedSides find_asked_by(const joints::Joint& joint) {
  AskedSides asked = std::visit(
      [](const auto& hold) { return find_asked_by(hold.parameters()); },
      joint.hold());
  for (const joints::JointElement& element : joint.elements()) {
    const AskedSides more =
        find_asked_rotations(joint.coordinates(), element.coordinate);
    asked.F += more.F;
    asked.M += more.M;
  }
  return asked;
}

Matrix3X find_complement(const Matrix3X& directions) {
  return find_range(
      Matrix3(Matrix3::Identity() - directions * directions.transpose()));
}

std::string describe_nodes(const InterfaceTable& table) {
  if (table.rotation_rank() == 2) {
    return fmt::format(
        "its {} nodes are on one line along {}", table.node_count,
        to_text(find_complement(table.rotation_axes).leftCols<1>()));
  }
  if (table.node_count == 1) return "it is one node";
  return fmt::format("its {} nodes are at one point", table.node_count);
}

std::string describe_directions(const Matrix3X& directions) {
  if (directions.cols() == 3) return "any direction";
  if (directions.cols() == 1) return to_text(directions.col(0));
  return "directions normal to " +
         to_text(find_complement(directions).leftCols<1>());
}

}  // namespace

AskedRotations rotation_about(const Vector3& direction) {
  return direction * direction.transpose();
}

AskedSides find_asked_rotations(
    const std::vector<joints::AxisCoordinate>& coordinates, int index) {
  using Kind = joints::AxisCoordinate::Kind;
  const auto& own = coordinates.at(static_cast<std::size_t>(index));
  if (own.kind == Kind::distance) return {};
  const auto angles =
      std::count_if(coordinates.begin(), coordinates.end(),
                    [](const auto& c) { return c.kind == Kind::angle; });
  // Of several angles, each turns the axes of the others.
  if (angles > 1) return {Matrix3::Identity(), Matrix3::Identity()};
  return {rotation_about(own.axis), rotation_about(own.axis)};
}

AskedSides find_asked_rotations(const joints::CouplerLaw& law) {
  return std::visit(
      Overloaded{
          [](const joints::Bushing& bushing) {
            return find_asked_by(bushing.parameters());
          },
          [](const joints::PointSpring& /*spring*/) { return AskedSides{}; },
          [](const joints::Joint& joint) { return find_asked_by(joint); },
          [](const joints::Latch& latch) {
            // It closes in any pose.
            const AskedSides closed = find_asked_by(latch.parameters().bushing);
            const Matrix3 any = Matrix3::Identity();
            return closed.F.isZero() ? AskedSides{} : AskedSides{any, any};
          }},
      law);
}

void check_rotation(const InterfaceTable& table,
                    const AskedRotations& asked_B) {
  if (table.rotation_rank() == 3) return;
  const Matrix3X asked =
      find_asked(find_complement(table.rotation_axes), find_range(asked_B));
  if (asked.cols() == 0) return;
  throw InputError(fmt::format(
      "interface '{}': {}, so it has no rotation about {} (mesh axes), which "
      "is asked of it. Take nodes that span a surface, or ask no rotation "
      "about {}",
      table.name, describe_nodes(table), describe_directions(asked),
      asked.cols() == 1 ? "that direction" : "them"));
}

void check_rotation(const Mount& mount, const AskedRotations& asked_F) {
  if (!mount.anchor.table) return;
  const Matrix3& R_BF = mount.X_BF.R;
  naming("link '" + mount.link + "'", [&] {
    check_rotation(*mount.anchor.table, R_BF * asked_F * R_BF.transpose());
  });
}

}  // namespace limber::scene
