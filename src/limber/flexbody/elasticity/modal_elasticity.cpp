// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/elasticity/modal_elasticity.hpp"

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

// Names the function that a kind lacks.
template <typename... Kinds>
constexpr bool check(const std::variant<Kinds...>* /*any*/) {
  return ([]<typename Kind>(const Kind* /*kind*/) {
    static_assert(ModalElasticityKind<Kind>,
                  "flexbody/elasticity/modal_elasticity_kind.hpp");
    return true;
  }(static_cast<const Kinds*>(nullptr)) &&
          ...);
}
static_assert(check(static_cast<const ModalElasticity*>(nullptr)));

}  // namespace

Eigen::Index count_modes(const ModalElasticity& elasticity) {
  return std::visit([](const auto& own) { return own.size(); }, elasticity);
}

double calc_elastic_energy(const ModalElasticity& elasticity,
                           const ModesIn& q) {
  LIMBER_EXPECT(q.size() == count_modes(elasticity));
  return std::visit([&](const auto& own) { return own.energy(q); }, elasticity);
}

void calc_elastic_force(const ModalElasticity& elasticity, const ModesIn& q,
                        ModesOut force) {
  LIMBER_EXPECT(q.size() == count_modes(elasticity));
  LIMBER_EXPECT(force.size() == q.size());
  std::visit([&](const auto& own) { own.calc_force(q, force); }, elasticity);
}

void calc_elastic_tangent(const ModalElasticity& elasticity, const ModesIn& q,
                          ModesSquare tangent) {
  LIMBER_EXPECT(q.size() == count_modes(elasticity));
  LIMBER_EXPECT(tangent.rows() == q.size() && tangent.cols() == q.size());
  std::visit([&](const auto& own) { own.calc_tangent(q, tangent); },
             elasticity);
}

void calc_elastic_force_over_step(const ModalElasticity& elasticity,
                                  const ModesIn& q0, const ModesIn& q1,
                                  ModesOut force) {
  LIMBER_EXPECT(q0.size() == count_modes(elasticity));
  LIMBER_EXPECT(q1.size() == q0.size() && force.size() == q0.size());
  std::visit([&](const auto& own) { own.calc_force_over_step(q0, q1, force); },
             elasticity);
}

void calc_elastic_tangent_over_step(const ModalElasticity& elasticity,
                                    const ModesIn& q0, const ModesIn& q1,
                                    ModesSquare tangent) {
  LIMBER_EXPECT(q0.size() == count_modes(elasticity));
  LIMBER_EXPECT(q1.size() == q0.size());
  LIMBER_EXPECT(tangent.rows() == q0.size() && tangent.cols() == q0.size());
  std::visit(
      [&](const auto& own) { own.calc_tangent_over_step(q0, q1, tangent); },
      elasticity);
}

const VectorX* find_eigenvalues(const ModalElasticity& elasticity) {
  return std::visit([](const auto& own) { return own.eigenvalues(); },
                    elasticity);
}

bool is_linear(const ModalElasticity& elasticity) {
  return std::visit([](const auto& own) { return own.is_linear(); },
                    elasticity);
}

const VectorX& rest_stiffness(const ModalElasticity& elasticity) {
  return std::visit(
      [](const auto& own) -> const VectorX& { return own.rest_stiffness(); },
      elasticity);
}

bool is_diagonal_at_rest(const ModalElasticity& elasticity) {
  return std::visit([](const auto& own) { return own.is_diagonal_at_rest(); },
                    elasticity);
}

double lowest_rest_stiffness(const ModalElasticity& elasticity) {
  return std::visit([](const auto& own) { return own.lowest_rest_stiffness(); },
                    elasticity);
}

}  // namespace limber::flexbody
