// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/nonlinear_solid.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "limber/common/errors.hpp"
#include "limber/common/material/anisotropy.hpp"
#include "limber/fem/linalg/parallel.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/solid/hooke.hpp"

namespace limber::fem {
namespace {

// One rule for all elements of a batch: the curved one is valid for straight
// elements too.
const Quadrature& choose_rule(const Mesh& mesh, const ElementBlock& block,
                              std::size_t first, std::size_t count) {
  for (std::size_t e = first; e < first + count; ++e) {
    const Matrix3X x = element_positions(mesh, block, e);
    if (!is_parallel_sided(*block.element, x)) return block.element->curved;
  }
  return block.element->stiffness;
}

}  // namespace

NonlinearSolid::NonlinearSolid(const Mesh& mesh,
                               const std::vector<ElasticMaterial>& materials,
                               Elasticity law)
    : source_(mesh.source), law_(law), node_count_(mesh.x.cols()) {
  LIMBER_EXPECT(materials.size() == mesh.volume_groups.size());
  require_law(mesh, materials, law);
  for (const ElementBlock& block : mesh.blocks) {
    add_block(mesh, block, materials);
  }
  link_nodes();
}

void NonlinearSolid::add_block(const Mesh& mesh, const ElementBlock& block,
                               const std::vector<ElasticMaterial>& materials) {
  for (std::size_t first = 0; first < block.size(); first += kLanes) {
    const std::size_t count =
        std::min<std::size_t>(kLanes, block.size() - first);
    const Quadrature& rule = choose_rule(mesh, block, first, count);
    Batch batch;
    batch.nodes = static_cast<std::size_t>(block.element->node_count);
    batch.points = static_cast<std::size_t>(rule.weights.size());
    batch.node.resize(batch.nodes * kLanes);
    batch.gradients.resize(batch.points * batch.nodes * 3);
    batch.measures.assign(batch.points, Lane::Zero());
    const auto material_of = [&](std::size_t e) -> const ElasticMaterial& {
      return materials[static_cast<std::size_t>(block.regions[e])];
    };
    for (std::size_t e = first; e < first + count; ++e)
      if (material_of(e).anisotropy) batch.constants.resize(batch.points);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t e = first + std::min(lane, count - 1);
      fill_lane(mesh, block, e, rule, static_cast<int>(lane), batch);
      if (!batch.constants.empty())
        fill_constants(material_of(e),
                       element_positions(mesh, block, e) * rule.shape,
                       static_cast<int>(lane), batch);
      const auto lame = find_lame_constants(material_of(e));
      batch.lame.lambda[static_cast<int>(lane)] = lame.lambda;
      batch.lame.mu[static_cast<int>(lane)] = lame.mu;
      if (lane < count) {
        batch.tags.push_back(block.tags[e]);
      } else {
        for (Lane& m : batch.measures) m[static_cast<int>(lane)] = 0.0;
      }
    }
    batch.place = force_count_;
    force_count_ += batch.nodes * 3 * kLanes;
    batches_.push_back(std::move(batch));
  }
}

void NonlinearSolid::fill_lane(const Mesh& mesh, const ElementBlock& block,
                               std::size_t e, const Quadrature& rule, int lane,
                               Batch& batch) {
  const int* nodes = block.element_nodes(e);
  for (std::size_t a = 0; a < batch.nodes; ++a) {
    batch.node[a * kLanes + static_cast<std::size_t>(lane)] = nodes[a];
  }
  const Matrix3X x = element_positions(mesh, block, e);
  for (std::size_t q = 0; q < batch.points; ++q) {
    const Matrix3 jacobian = x * rule.gradients[q].transpose();
    const Matrix3X gradients =
        jacobian.inverse().transpose() * rule.gradients[q];
    Lane* at = batch.gradients.data() + 3 * batch.nodes * q;
    for (Eigen::Index k = 0; k < gradients.size(); ++k) {
      at[k][lane] = gradients.data()[k];
    }
    batch.measures[q][lane] =
        rule.weights[static_cast<Eigen::Index>(q)] * jacobian.determinant();
  }
}

// @param x 3 x points
void NonlinearSolid::fill_constants(const ElasticMaterial& material,
                                    const Matrix3X& x, int lane, Batch& batch) {
  for (std::size_t q = 0; q < batch.points; ++q) {
    const Constants21 own = list_constants(
        find_stiffness(material, Vector3(x.col(static_cast<Eigen::Index>(q)))));
    for (std::size_t k = 0; k < own.size(); ++k)
      batch.constants[q][k][lane] = own[k];
  }
}

// Each node gathers the forces on it in one fixed order.
void NonlinearSolid::link_nodes() {
  const auto nodes = static_cast<std::size_t>(node_count_);
  first_link_.assign(nodes + 1, 0);
  const auto for_each = [&](auto visit) {
    for (const Batch& batch : batches_) {
      for (std::size_t a = 0; a < batch.nodes; ++a) {
        for (std::size_t lane = 0; lane < batch.tags.size(); ++lane) {
          visit(static_cast<std::size_t>(batch.node[a * kLanes + lane]),
                batch.place + a * 3 * kLanes + lane);
        }
      }
    }
  };
  for_each([&](std::size_t n, std::size_t) { ++first_link_[n + 1]; });
  std::partial_sum(first_link_.begin(), first_link_.end(), first_link_.begin());
  links_.resize(first_link_.back());
  std::vector<std::size_t> next(first_link_.begin(), first_link_.end() - 1);
  for_each(
      [&](std::size_t n, std::size_t place) { links_[next[n]++] = place; });
}

NonlinearSolid::Workspace NonlinearSolid::make_workspace() const {
  return {std::vector<double>(force_count_),
          std::vector<double>(batches_.size())};
}

double NonlinearSolid::calc_force(const Eigen::Ref<const Matrix3X>& u,
                                  Eigen::Ref<Matrix3X> force,
                                  Workspace& workspace) const {
  LIMBER_EXPECT(u.cols() == node_count_ && force.cols() == node_count_);
  LIMBER_EXPECT(workspace.forces.size() == force_count_);
  constexpr std::size_t kBatches = 100;  // worth a thread
  constexpr std::size_t kNodes = 5000;
  const auto calc = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      workspace.energies[i] = calc_batch(
          batches_[i], u, workspace.forces.data() + batches_[i].place);
    }
  };
  const auto gather = [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Vector3 sum = Vector3::Zero();
      for (std::size_t i = first_link_[n]; i < first_link_[n + 1]; ++i) {
        const double* at = workspace.forces.data() + links_[i];
        sum += Vector3(at[0], at[kLanes], at[2 * kLanes]);
      }
      force.col(static_cast<Eigen::Index>(n)) = sum;
    }
  };
  parallel_ranges(batches_.size(), calc, kBatches);
  parallel_ranges(static_cast<std::size_t>(node_count_), gather, kNodes);
  return std::accumulate(workspace.energies.begin(), workspace.energies.end(),
                         0.0);
}

double NonlinearSolid::calc_batch(const Batch& batch,
                                  const Eigen::Ref<const Matrix3X>& u,
                                  double* forces) const {
  constexpr std::size_t kMostNodes = 64;
  std::array<Lane, 3 * kMostNodes> displacement;
  std::array<Lane, 3 * kMostNodes> force;
  for (std::size_t a = 0; a < batch.nodes; ++a) {
    for (std::size_t c = 0; c < 3; ++c) {
      Lane& lane = displacement[3 * a + c];
      for (int l = 0; l < kLanes; ++l) {
        lane[l] = u(static_cast<Eigen::Index>(c),
                    batch.node[a * kLanes + static_cast<std::size_t>(l)]);
      }
      force[3 * a + c].setZero();
    }
  }
  Lane energy = Lane::Zero();
  for (std::size_t q = 0; q < batch.points; ++q) {
    const Lane* gradients = batch.gradients.data() + 3 * batch.nodes * q;
    Tensor<Lane> H;
    for (auto& row : H) row.fill(Lane::Zero());
    for (std::size_t a = 0; a < batch.nodes; ++a) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          H[i][j] += displacement[3 * a + i] * gradients[3 * a + j];
        }
      }
    }
    Tensor<Lane> F = H;
    for (std::size_t i = 0; i < 3; ++i) F[i][i] += 1.0;
    const Lane J = determinant(F);
    if (!(J.minCoeff() > 0.0)) refuse(batch, J);
    const Stress<Lane> stress =
        batch.constants.empty()
            ? calc_stress(law_, batch.lame, H)
            : calc_st_venant_kirchhoff<Lane>(batch.constants[q], H);
    energy += batch.measures[q] * stress.W;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const Lane P = batch.measures[q] *
                       (F[i][0] * stress.S[0][j] + F[i][1] * stress.S[1][j] +
                        F[i][2] * stress.S[2][j]);
        for (std::size_t a = 0; a < batch.nodes; ++a) {
          force[3 * a + i] += P * gradients[3 * a + j];
        }
      }
    }
  }
  for (std::size_t k = 0; k < 3 * batch.nodes; ++k) {
    Eigen::Map<Lane>(forces + k * kLanes) = force[k];
  }
  return energy.sum();
}

void NonlinearSolid::refuse(const Batch& batch, const Lane& J) const {
  int lane = 0;
  const double least = J.minCoeff(&lane);
  // NaN fails every comparison: name the first of the four then.
  const auto at =
      std::min(static_cast<std::size_t>(lane), batch.tags.size() - 1);
  throw NumericalError(
      fmt::format("{}: element {} is inverted (det F = {:.3g}); the motion is "
                  "beyond what the mesh can follow, or the step is too long",
                  source_, batch.tags[at], least));
}

}  // namespace limber::fem
