// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/mesh_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

Eigen::Index column_of(int node) { return 3 * Eigen::Index{node}; }

}  // namespace

MeshSurface::MeshSurface(flexbody::ContactSurface surface)
    : surface_(std::move(surface)) {
  prepare();
}

MeshSurface::MeshSurface(flexbody::FullContactSurface surface,
                         Eigen::Index mesh_nodes)
    : surface_(std::move(surface.surface)),
      means_(std::move(surface.means)),
      pieces_(std::move(surface.pieces)),
      mesh_nodes_(mesh_nodes) {
  check_means();
  prepare();
  tree_.set_spread(spread_);
}

void MeshSurface::prepare() {
  check();
  const Eigen::Index n = surface_.x_B.cols();
  modes_.resize(surface_.Phi_B.cols(), 3 * n);
  if (modes_.rows() > 0) modes_ = surface_.Phi_B.transpose();
  connect();
  mark_border();
  set_bounds();
  tree_ = SurfaceTree(surface_.faces, surface_.x_B,
                      modes_.rows() > 0 ? surface_.Phi_B : MatrixX(3 * n, 0));
}

void MeshSurface::check() const {
  const flexbody::ContactSurface& s = surface_;
  const auto refuse = [&s](const std::string& problem) {
    throw InputError(
        fmt::format("contact: its surface '{}' {}", s.name, problem));
  };
  const Eigen::Index n = s.x_B.cols();
  if (s.faces.empty()) refuse("has no faces");
  if (s.residual.size() != n ||
      (s.Phi_B.cols() > 0 && s.Phi_B.rows() != 3 * n)) {
    refuse(
        fmt::format("has {} nodes, {} rows of modes and {} residual "
                    "flexibilities; expected 3 n and n",
                    n, s.Phi_B.rows(), s.residual.size()));
  }
  if (!s.x_B.allFinite() || !s.Phi_B.allFinite() || !s.residual.allFinite()) {
    refuse("has a position, mode or residual flexibility that is not finite");
  }
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    const Face& nodes = s.faces[f];
    const bool is_straight = nodes[3] < 0;
    for (std::size_t i = 0; i < 6; ++i) {
      const bool is_absent = i > 2 && is_straight;
      if (is_absent ? nodes[i] == -1 : nodes[i] >= 0 && nodes[i] < n) continue;
      refuse(
          fmt::format("has node {} in face {}; expected 0 to {}, or -1 for "
                      "all three middle nodes",
                      nodes[i], f, n - 1));
    }
    const Vector3 area = (s.x_B.col(nodes[1]) - s.x_B.col(nodes[0]))
                             .cross(s.x_B.col(nodes[2]) - s.x_B.col(nodes[0]));
    if (!(area.norm() > 0.0)) {
      refuse(fmt::format("has a face without area: face {}", f));
    }
  }
}

void MeshSurface::check_means() const {
  const auto n = static_cast<std::size_t>(surface_.x_B.cols());
  const auto is_beyond = [this](int node) {
    return node < 0 || node >= mesh_nodes_;
  };
  if (means_.first.size() == n + 1 && surface_.Phi_B.cols() == 0 &&
      means_.first.back() == means_.nodes.size() &&
      means_.weights.size() == means_.nodes.size() &&
      std::none_of(means_.nodes.begin(), means_.nodes.end(), is_beyond)) {
    return;
  }
  throw InputError(fmt::format(
      "contact: its surface '{}' has means over nodes that do not fit its {} "
      "nodes and the mesh's {}",
      surface_.name, n, mesh_nodes_));
}

void MeshSurface::connect() {
  const std::size_t n = node_count();
  std::vector<bool> has_face(n, false);
  first_faces_.assign(n + 1, 0);
  for (const Face& nodes : surface_.faces) {
    for (std::size_t i = 0; i < 6; ++i) {
      if (nodes[i] < 0) continue;
      has_face[index(nodes[i])] = true;
      if (i < 3) ++first_faces_[index(nodes[i]) + 1];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!has_face[i]) {
      throw InputError(fmt::format(
          "contact: its surface '{}' has a node in no face: node {}",
          surface_.name, i));
    }
    first_faces_[i + 1] += first_faces_[i];
  }
  faces_of_nodes_.resize(index(first_faces_.back()));
  std::vector<int> next(first_faces_.begin(), first_faces_.end() - 1);
  for (std::size_t f = 0; f < surface_.faces.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      int& place = next[index(surface_.faces[f][i])];
      faces_of_nodes_[index(place++)] = static_cast<int>(f);
    }
  }
}

void MeshSurface::mark_border() {
  is_border_.resize(surface_.faces.size());
  is_border_node_.assign(node_count(), false);
  for (std::size_t f = 0; f < surface_.faces.size(); ++f) {
    const Face& nodes = surface_.faces[f];
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const int a = nodes[edge];
      const int b = nodes[(edge + 1) % 3];
      const auto around = find_faces_of(a);
      const auto sharing =
          std::count_if(around.begin(), around.end(), [this, b](int other) {
            const Face& corners = face(other);
            return corners[0] == b || corners[1] == b || corners[2] == b;
          });
      if (sharing > 1) continue;
      is_border_[f][edge] = true;
      is_border_node_[index(a)] = is_border_node_[index(b)] = true;
      is_closed_ = false;
    }
  }
}

void MeshSurface::set_bounds() {
  centre_ = 0.5 * (surface_.x_B.rowwise().minCoeff() +
                   surface_.x_B.rowwise().maxCoeff());
  largest_motions_ = VectorX::Zero(modes_.rows());
  const auto take_in = [this](const Vector3& x, const Matrix3X& Phi) {
    radius_ = std::max(radius_, (x - centre_).norm());
    if (Phi.cols() == 0) return;
    largest_motions_ =
        largest_motions_.cwiseMax(Phi.colwise().norm().transpose());
  };
  const auto find_rows = [this](int node) -> Matrix3X {
    return modes_.middleCols<3>(column_of(node)).transpose();
  };
  if (has_means()) {
    for (std::size_t n = 0; n < node_count(); ++n) {
      // For a control point, three times that of a node.
      spread_ = std::max(spread_, 3.0 * sum_weights(static_cast<int>(n)));
    }
  }
  for (const Face& nodes : surface_.faces) {
    for (std::size_t i = 0; i < 6; ++i) {
      if (nodes[i] < 0) continue;
      if (i < 3) {
        take_in(surface_.x_B.col(nodes[i]), find_rows(nodes[i]));
        continue;
      }
      // A face is within the hull of these (SurfaceTree).
      const int a = nodes[i - 3];
      const int b = nodes[(i - 2) % 3];
      take_in(2.0 * surface_.x_B.col(nodes[i]) -
                  0.5 * (surface_.x_B.col(a) + surface_.x_B.col(b)),
              2.0 * find_rows(nodes[i]) - 0.5 * (find_rows(a) + find_rows(b)));
    }
  }
}

std::span<const int> MeshSurface::find_faces_of(int node) const {
  const int first = first_faces_[index(node)];
  return std::span(faces_of_nodes_)
      .subspan(index(first), index(first_faces_[index(node) + 1] - first));
}

double MeshSurface::sum_weights(int node) const {
  double sum = 0.0;
  for (auto k = means_.first[index(node)]; k < means_.first[index(node) + 1];
       ++k) {
    sum += std::abs(means_.weights[k]);
  }
  return sum;
}

VectorX MeshSurface::find_mode_reach() const {
  VectorX reach = VectorX::Zero(mode_count());
  if (has_means()) {
    reach[reach.size() - 1] = spread_;
    return reach;
  }
  for (Eigen::Index row = 0; row < surface_.Phi_B.rows(); row += 3) {
    reach = reach.cwiseMax(
        surface_.Phi_B.middleRows<3>(row).colwise().norm().transpose());
  }
  return reach;
}

Vector3 MeshSurface::deform(int node, const ModalView& eta) const {
  Vector3 x = surface_.x_B.col(node);
  if (has_means()) {
    for (auto k = means_.first[index(node)]; k < means_.first[index(node) + 1];
         ++k) {
      x += means_.weights[k] * eta.segment<3>(column_of(means_.nodes[k]));
    }
    return x;
  }
  const Eigen::Index column = column_of(node);
  for (int axis = 0; axis < 3; ++axis) {
    x[axis] += modes_.col(column + axis).dot(eta);
  }
  return x;
}

FacePatch MeshSurface::deform_face(int f, const ModalView& eta) const {
  const Face& nodes = face(f);
  if (nodes[3] < 0) {
    return FacePatch(std::array<Vector3, 3>{
        deform(nodes[0], eta), deform(nodes[1], eta), deform(nodes[2], eta)});
  }
  std::array<Vector3, 6> X;
  for (std::size_t i = 0; i < 6; ++i) X[i] = deform(nodes[i], eta);
  return FacePatch(X);
}

SurfacePlace MeshSurface::make_place(int f, const FacePlace& at) const {
  const Face& nodes = face(f);
  const auto weights = find_shape_functions(at, nodes[3] < 0);
  SurfacePlace place{.face = f, .u = at.u, .v = at.v};
  for (std::size_t i = 0; i < 6; ++i) {
    if (nodes[i] >= 0) place.x_B += weights[i] * surface_.x_B.col(nodes[i]);
  }
  return place;
}

double MeshSurface::find_deformation_bound(const ModalView& eta) const {
  if (has_means()) return spread_ * eta[eta.size() - 1];
  return largest_motions_.dot(eta.cwiseAbs());
}

double MeshSurface::find_extent(const ModalView& eta) const {
  return centre_.norm() + radius_ + find_deformation_bound(eta);
}

void MeshSurface::set_shape_functions(const SurfacePlace& place,
                                      Matrix3X& out) const {
  LIMBER_EXPECT(place.face >= 0 && index(place.face) < surface_.faces.size());
  LIMBER_EXPECT(out.cols() == mode_count());
  const Face& nodes = face(place.face);
  const auto weights = find_shape_functions({place.u, place.v}, nodes[3] < 0);
  out.setZero();
  for (std::size_t i = 0; i < 6; ++i) {
    if (nodes[i] < 0) continue;
    add_rows(nodes[i], weights[i], out);
  }
}

void MeshSurface::add_rows(int node, double weight, Matrix3X& out) const {
  if (!has_means()) {
    out += weight * modes_.middleCols<3>(column_of(node)).transpose();
    return;
  }
  for (auto k = means_.first[index(node)]; k < means_.first[index(node) + 1];
       ++k) {
    out.middleCols<3>(column_of(means_.nodes[k])).diagonal().array() +=
        weight * means_.weights[k];
  }
}

double MeshSurface::find_residual(const SurfacePlace& place) const {
  LIMBER_EXPECT(place.face >= 0 && index(place.face) < surface_.faces.size());
  const Face& nodes = face(place.face);
  const auto weights = FacePlace{place.u, place.v}.weights();
  double residual = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    residual += weights[i] * surface_.residual[nodes[i]];
  }
  return residual;
}

Vector3 MeshSurface::find_position(const SurfacePlace& place,
                                   const ModalView& eta) const {
  return deform_face(place.face, eta).find_point({place.u, place.v});
}

ModalView find_modal_coordinates(const MeshSurface& mesh_surface,
                                 const joints::PairBody& body) {
  if (mesh_surface.mode_count() == 0) return {nullptr, 0};
  LIMBER_EXPECT(mesh_surface.mode_count() == body.modes);
  return {body.eta, body.modes};
}

}  // namespace limber::contact
