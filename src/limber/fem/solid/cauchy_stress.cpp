// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/cauchy_stress.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/solid/element_matrices.hpp"
#include "limber/fem/solid/stress_recovery.hpp"

namespace limber::fem {
namespace {

using PointOfElement = std::pair<int, int>;  // node, material

Vector6 calc_cauchy(Elasticity law, const Hooke& hooke, const Matrix3& H) {
  const Matrix3 S = hooke.calc_stress(law, H);
  const Matrix3 F = Matrix3::Identity() + H;
  return to_components(F * S * F.transpose() / F.determinant());
}

}  // namespace

CauchyStress::CauchyStress(const Mesh& mesh,
                           const std::vector<ElasticMaterial>& materials,
                           Elasticity law, const std::vector<int>& nodes)
    : law_(law) {
  LIMBER_EXPECT(materials.size() == mesh.volume_groups.size());
  const std::vector<int> material_of_region =
      index_materials(materials).of_region;
  const auto visit = [&](const auto& use) {
    for (const ElementBlock& block : mesh.blocks) {
      for (std::size_t e = 0; e < block.size(); ++e) {
        const int* first = block.element_nodes(e);
        const std::vector<int> own(first, first + block.element->node_count);
        use(block, e, own);
      }
    }
  };
  const auto is_wanted = [&](int node) {
    return std::binary_search(nodes.begin(), nodes.end(), node);
  };
  std::vector<PointOfElement> points;
  visit([&](const ElementBlock& block, std::size_t e,
            const std::vector<int>& own) {
    const int material =
        material_of_region[static_cast<std::size_t>(block.regions[e])];
    for (const int node : own) {
      if (is_wanted(node)) points.emplace_back(node, material);
    }
  });
  std::sort(points.begin(), points.end());
  std::vector<double> counts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 0 || points[i] != points[i - 1]) counts.push_back(0.0);
    counts.back() += 1.0;
  }
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const auto& [node, material] : points) nodes_.push_back(node);

  visit([&](const ElementBlock& block, std::size_t e,
            const std::vector<int>& own) {
    if (std::none_of(own.begin(), own.end(), is_wanted)) return;
    const auto region = static_cast<std::size_t>(block.regions[e]);
    const Matrix3X x = mesh.x(Eigen::all, own);
    const ReferenceElement& type = *block.element;
    const Quadrature& rule =
        is_parallel_sided(type, x) ? type.stiffness : type.curved;
    const MatrixX fit = make_stress_fit(type, rule);
    ElementGradients gradients = calc_gradients(type, x);
    Element element{own,
                    std::move(gradients.at),
                    list_laws(materials[region], gradients.x),
                    {}};
    for (std::size_t a = 0; a < own.size(); ++a) {
      if (!is_wanted(own[a])) continue;
      const auto point =
          std::lower_bound(points.begin(), points.end(),
                           PointOfElement(own[a], material_of_region[region])) -
          points.begin();
      element.wanted.push_back(
          {static_cast<int>(point),
           fit.row(static_cast<Eigen::Index>(a)).transpose() /
               counts[static_cast<std::size_t>(point)]});
    }
    elements_.push_back(std::move(element));
  });
}

void CauchyStress::evaluate(const Eigen::Ref<const Matrix3X>& u,
                            Eigen::Ref<Matrix6X> stress) const {
  LIMBER_EXPECT(stress.cols() == std::ssize(nodes_));
  stress.setZero();
  for (const Element& element : elements_) {
    for (std::size_t q = 0; q < element.gradients.size(); ++q) {
      Matrix3 H = Matrix3::Zero();
      for (std::size_t a = 0; a < element.nodes.size(); ++a) {
        H.noalias() +=
            u.col(element.nodes[a]) *
            element.gradients[q].col(static_cast<Eigen::Index>(a)).transpose();
      }
      const Vector6 s = calc_cauchy(law_, element.laws[q], H);
      for (const Wanted& wanted : element.wanted) {
        stress.col(wanted.point) +=
            wanted.fit[static_cast<Eigen::Index>(q)] * s;
      }
    }
  }
}

}  // namespace limber::fem
