// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/dynamics/bodies/modal_factor.hpp"
#include "limber/dynamics/bodies/nodal_factor.hpp"

namespace limber::dynamics {

/// Functions that a kind of body provides for its block D of Newton's matrix.
template <typename Factor>
concept FactorKind = requires(Factor& factor, const Factor& made,
                              const SystemModel& model, std::size_t body,
                              const SystemState& state, SystemTerms& terms,
                              const Matrix3& T, const TangentCoefficients& c,
                              bool renews, LinkEnd& end, VectorX& x,
                              void (*finish)(Matrix6X&)) {
  // Whether renew_end() is due.
  {
    factor.update(model, body, state, terms, T, c, renews)
    } -> std::same_as<bool>;
  made.renew_end(model, body, terms, end);
  // D^-1 of all that stands in the body's rows.
  factor.solve(model, body, terms, x);
  { made.make_end(model, body) } -> std::same_as<LinkEnd>;
  made.calc_rows(model, body, state, terms, T, end);
  made.solve_end(model, body, state, T, finish, end);
  { made.block_count() } -> std::same_as<int>;
};
static_assert(FactorKind<ModalFactor>);
static_assert(FactorKind<NodalFactor>);

/// The factors of one body's block D of NewtonMatrix, of any kind.
class BodyFactor {
 public:
  BodyFactor(const SystemModel& model, std::size_t body);

  /// Factors at evaluated `terms`, with the stiffness of modes that elasticity
  /// couples. @param T derivative of the step's rotation by the increment at
  /// its end [-]
  /// @param renews also what is kept over steps
  /// @returns whether renew_end() is due
  /// @throws NumericalError naming the body.
  bool update(const SystemModel& model, const SystemState& state,
              SystemTerms& terms, const Matrix3& T,
              const TangentCoefficients& c, bool renews) {
    return std::visit(
        [&](auto& own) {
          return own.update(model, b_, state, terms, T, c, renews);
        },
        factor_);
  }

  /// An end on the body, of its size.
  [[nodiscard]] LinkEnd make_end(const SystemModel& model,
                                 AttachmentIndex attachment) const {
    LinkEnd end = std::visit(
        [&](const auto& own) { return own.make_end(model, b_); }, factor_);
    end.attachment = attachment;
    end.Zt = end.G;
    return end;
  }
  void renew_end(const SystemModel& model, const SystemTerms& terms,
                 LinkEnd& end) const {
    std::visit([&](const auto& own) { own.renew_end(model, b_, terms, end); },
               factor_);
  }
  /// Sets G to the motion of the end's frame, in a frame F.
  void calc_rows(const SystemModel& model, const SystemState& state,
                 const SystemTerms& terms, const Matrix3& R_FW,
                 LinkEnd& end) const {
    std::visit(
        [&](const auto& own) {
          own.calc_rows(model, b_, state, terms, R_FW, end);
        },
        factor_);
  }
  /// Sets Zt from G = finish(motion of the end's frame), finish linear.
  template <typename Finish>
  void solve_end(const SystemModel& model, const SystemState& state,
                 const Matrix3& R_FW, const Finish& finish,
                 LinkEnd& end) const {
    std::visit(
        [&](const auto& own) {
          own.solve_end(model, b_, state, R_FW, finish, end);
        },
        factor_);
  }

  /// x := D^-1 x in the body's rows; 0 where it is held.
  void solve(const SystemModel& model, const SystemTerms& terms, VectorX& x) {
    std::visit([&](auto& own) { own.solve(model, b_, terms, x); }, factor_);
  }

  /// Blocks of six by six of D that are dense, 0 if it is sparse.
  [[nodiscard]] int block_count() const {
    return std::visit([](const auto& own) { return own.block_count(); },
                      factor_);
  }
  /// The same as an own kind. @throws ContractError if D is sparse.
  [[nodiscard]] const ModalFactor& dense() const {
    const auto* dense = std::get_if<ModalFactor>(&factor_);
    LIMBER_EXPECT(dense != nullptr);
    return *dense;
  }

 private:
  std::size_t b_;
  std::variant<ModalFactor, NodalFactor> factor_;
};

}  // namespace limber::dynamics
