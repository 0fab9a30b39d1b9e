// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/bodies/body_coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::results {
namespace {

using flexbody::InterfaceTable;
using flexbody::ReducedBody;

BodyNode make_frame(const InterfaceTable& table, std::size_t tag) {
  const Eigen::Index m = table.Phi_B.cols();
  const bool has_rotation = table.rotation_rank() == 3;
  BodyNode node{tag, table.name, table.p_B,
                MatrixX::Zero(has_rotation ? 6 : 3, 6 + m)};
  node.rows.topRows<3>() << Matrix3::Identity(), -skew(table.p_B), table.Phi_B;
  if (has_rotation)
    node.rows.bottomRows<3>() << Matrix3::Zero(), Matrix3::Identity(),
        table.Psi_B;
  return node;
}

std::size_t last_tag(const ReducedBody& body) {
  std::size_t last = 0;
  for (const std::size_t tag : body.rows.tags) last = std::max(last, tag);
  return last;
}

/// int u_a u_b dm of the motions z.
std::array<MatrixX, 6> find_moments(const ReducedBody& body) {
  constexpr std::array<std::array<int, 2>, 6> kPlaces = {
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  const Eigen::Index m = body.lambda.size();
  const auto S1 = [&](Eigen::Index k) {
    return body.integrals.S1[static_cast<std::size_t>(k)];
  };
  const auto rotation = [](int a) {
    Vector3 axis = Vector3::Zero();
    axis[a] = 1.0;
    return skew(axis);
  };
  // All 3 x 3 integrals of motions i and j; translations have none with the
  // others, as the origin is the centre of mass of a free body.
  const auto integral = [&](Eigen::Index i, Eigen::Index j) -> Matrix3 {
    Matrix3 S = Matrix3::Zero();
    if (i < 3 && j < 3) {
      S(i, j) = body.mass;
    } else if (i >= 6 && j >= 6) {
      S = body.integrals.S2[static_cast<std::size_t>((i - 6) * m + j - 6)];
    } else if (i >= 3 && i < 6 && j >= 3 && j < 6) {
      S = rotation(static_cast<int>(i - 3)) * body.integrals.S0 *
          rotation(static_cast<int>(j - 3)).transpose();
    } else if (i >= 3 && i < 6 && j >= 6) {
      S = rotation(static_cast<int>(i - 3)) * S1(j - 6);
    } else if (j >= 3 && j < 6 && i >= 6) {
      S = (rotation(static_cast<int>(j - 3)) * S1(i - 6)).transpose();
    }
    return S;
  };
  std::array<MatrixX, 6> moments;
  for (MatrixX& moment : moments) moment.resize(6 + m, 6 + m);
  for (Eigen::Index i = 0; i < 6 + m; ++i)
    for (Eigen::Index j = 0; j < 6 + m; ++j) {
      const Matrix3 S = integral(i, j);
      for (std::size_t p = 0; p < 6; ++p)
        moments[p](i, j) = S(kPlaces[p][0], kPlaces[p][1]);
    }
  return moments;
}

MatrixX symmetric(const MatrixX& A) { return 0.5 * (A + A.transpose()); }

}  // namespace

std::vector<BodyNode> list_nodes(const ReducedBody& body) {
  const Eigen::Index m = body.lambda.size();
  std::vector<BodyNode> nodes;
  for (std::size_t i = 0; i < body.rows.tags.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    BodyNode node{body.rows.tags[i], "", body.rows.x_B.col(at),
                  MatrixX(3, 6 + m)};
    node.rows << Matrix3::Identity(), -skew(node.x_B),
        body.rows.Phi_B.middleRows<3>(3 * at);
    nodes.push_back(std::move(node));
  }
  std::size_t tag = last_tag(body);
  for (const InterfaceTable& table : body.interfaces)
    nodes.push_back(make_frame(table, ++tag));
  return nodes;
}

std::vector<BodyNode> list_frames(const ReducedBody& body) {
  std::vector<BodyNode> frames;
  std::size_t tag = last_tag(body);
  for (const InterfaceTable& table : body.interfaces) {
    frames.push_back(make_frame(table, ++tag));
    if (frames.back().rows.rows() == 6) continue;
    throw InputError(fmt::format(
        "interface '{}' of body '{}' has no three rotations: its nodes are a "
        "point or on a line. Expected a frame, of a surface or of a node with "
        "rotations",
        table.name, body.name));
  }
  return frames;
}

VectorX find_scales(const ReducedBody& body) {
  const double radius = std::sqrt(body.integrals.S0.trace() / body.mass);
  VectorX scales(6 + body.lambda.size());
  scales << Vector3::Ones(), Vector3::Constant(1.0 / radius),
      VectorX::Constant(body.lambda.size(), std::sqrt(body.mass));
  return scales;
}

BodyMatrices transform(const ReducedBody& body, const MatrixX& coordinates,
                       double ratio) {
  const Eigen::Index m = body.lambda.size();
  const Eigen::Index n = 6 + m;
  LIMBER_EXPECT(coordinates.rows() == n && coordinates.cols() == n);
  // Of columns of one size, so that the inverse is as accurate as can be.
  const VectorX scales = find_scales(body);
  const MatrixX scaled = coordinates * scales.asDiagonal();
  BodyMatrices made;
  made.T = scales.asDiagonal() * dense::find_inverse(scaled);
  constexpr double kRounding = 1e-6;
  if (!((coordinates * made.T - MatrixX::Identity(n, n)).norm() < kRounding))
    throw NumericalError(fmt::format(
        "body '{}': its interfaces and nodes do not determine its motion",
        body.name));
  VectorX stiffness = VectorX::Zero(n);
  stiffness.tail(m) = body.lambda;
  VectorX damping = VectorX::Zero(n);
  damping.tail(m) = 2.0 * ratio * body.lambda.cwiseMax(0.0).cwiseSqrt();
  MatrixX mass = MatrixX::Identity(n, n);
  mass.topLeftCorner<3, 3>() *= body.mass;
  mass.block<3, 3>(3, 3) = body.inertia();
  const auto apply = [&](const MatrixX& A) {
    return MatrixX(made.T.transpose() * A * made.T);
  };
  made.K = symmetric(apply(stiffness.asDiagonal()));
  made.D = symmetric(apply(damping.asDiagonal()));
  made.M = symmetric(apply(mass));
  const std::array<MatrixX, 6> moments = find_moments(body);
  for (std::size_t p = 0; p < 6; ++p)
    made.S[p] = p < 3 ? symmetric(apply(moments[p])) : apply(moments[p]);
  return made;
}

void require_free(const ReducedBody& body) {
  if (!body.clamped) return;
  throw InputError(fmt::format(
      "body '{}' is clamped: its matrices have no rigid motion, which other "
      "programs need. Reduce it without a clamp, and constrain it there",
      body.name));
}

}  // namespace limber::results
