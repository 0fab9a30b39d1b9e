// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/common/evaluation_time.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

/// Contributions of pair interactions to the equations of motion.
namespace limber::dynamics {

/// For make_terms.
[[nodiscard]] PairTerms make_pair_terms(const SystemModel& model);
[[nodiscard]] ProductTerms make_product_terms(const SystemModel& model,
                                              BodyIndex body);

/// Both bodies of a pair, as set_pair_bodies left them.
[[nodiscard]] joints::PairBodies find_bodies(const Pair& pair,
                                             const PairTerms& terms);

/// A pair's part of SystemState::pair_memory.
template <typename State>
[[nodiscard]] auto memory_of(const Pair& pair, State& state) {
  return state.pair_memory.at(pair.first_memory, pair.law->memory_size());
}

/// Whether a pair has no points in this step (SystemState::far_pairs).
[[nodiscard]] inline bool is_far(const SystemState& state, std::size_t pair) {
  return pair < state.far_pairs.size() && state.far_pairs[pair] != 0;
}

/// Motion of the bodies that have pairs; `terms` refers to the coordinates of
/// `state`. Needs R_WB.
void set_pair_bodies(const SystemModel& model, const SystemState& state,
                     SystemTerms& terms);

/// Both bodies of a pair at a state. Allocates only in its constructor.
///
/// For an unreduced body frame B is the mean-axis frame; eta holds the
/// displacements of all nodes relative to B [m], then the largest of their
/// magnitudes, which is only a bound; etadot likewise. Forces act on nodes
/// only: where PairPlace::x_B is off the surface in a direction normal to the
/// force, the moment of that arm is neglected.
class PairMotion {
 public:
  PairMotion(const SystemModel& model, const Pair& pair);
  PairMotion(const PairMotion&) = delete;  // it refers to itself
  PairMotion& operator=(const PairMotion&) = delete;
  PairMotion(PairMotion&&) = default;
  PairMotion& operator=(PairMotion&&) = default;
  ~PairMotion() = default;

  /// Refers to this, and to the coordinates of `state`.
  joints::PairBodies set(const SystemModel& model, const Pair& pair,
                         const SystemState& state);
  /// The bodies as last set.
  [[nodiscard]] joints::PairBodies bodies() const { return {A_, B_}; }

 private:
  joints::PairBody A_;
  joints::PairBody B_;
  ProductTerms coordinates_A_;
  ProductTerms coordinates_B_;
};

/// A PairMotion set to a state.
[[nodiscard]] PairMotion find_pair_motion(const SystemModel& model,
                                          const Pair& pair,
                                          const SystemState& state);

/// A response that a pair's law fills, of its size.
[[nodiscard]] joints::PairResponse make_response(const SystemModel& model,
                                                 const Pair& pair);

/// Evaluates all pairs and adds their forces and powers. Needs R_WB.
/// @throws NumericalError naming the pair and the time.
void apply_pairs(const SystemModel& model, const SystemState& state,
                 const EvaluationTime& now, SystemTerms& terms);

/// @throws NumericalError if its force, energy or dissipation is not finite.
void check_finite(const joints::PairResponse& response);

/// Whether a pair has points.
[[nodiscard]] bool has_points(const SystemTerms& terms);

/// Whether a pair has points on an unreduced body. NewtonMatrix treats such a
/// body as the world there, so that corrections have to be exact.
[[nodiscard]] bool acts_on_nodes(const SystemModel& model,
                                 const SystemTerms& terms);

/// Adds the residual of a force on B and its reaction on A at a point, rows as
/// increments of NewtonMatrix.
void add_residual(const SystemModel& model, const Pair& pair,
                  const joints::PairPoint& point, const Vector3& force_W,
                  const SystemTerms& terms, VectorX& residual);

/// Calls the laws' commit() at the end of an accepted step. Does nothing if no
/// law has a memory.
class PairCommit {
 public:
  explicit PairCommit(const SystemModel& model);
  void operator()(SystemState& state);

 private:
  const SystemModel& model_;
  std::vector<std::size_t> pairs_;             // that remember
  std::vector<joints::PairResponse> scratch_;  // one each
  std::vector<PairMotion> motions_;            // one each
};

/// @throws NumericalError with the pair's name and the time before the text.
[[noreturn]] void throw_pair(const std::string& name, double t,
                             const NumericalError& error);

/// Runs `work`; adds the pair's name and the time to a NumericalError.
template <typename Work>
void name_pair(const std::string& name, double t, const Work& work) {
  try {
    work();
  } catch (const NumericalError& error) {
    throw_pair(name, t, error);
  }
}

}  // namespace limber::dynamics
