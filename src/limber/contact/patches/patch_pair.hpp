// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/contact/patches/contact_side.hpp"
#include "limber/contact/patches/patch_finder.hpp"
#include "limber/contact/patches/patch_law.hpp"
#include "limber/contact/patches/patch_memory.hpp"
#include "limber/contact/patches/patch_touches.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::contact {

/// Contact of two bodies: a patch with one wrench for each pair of their convex
/// parts, of which a solid is one, wherever they touch.
///
/// Equation   the energies of PatchFinder; PatchLaw; over a step of the
/// energy-conserving
///            scheme the elastic wrench w at its middle, corrected for the
///            relative motion m by -(W_1 - W_0 + w . m) N m / (m' N m), N = P +
///            1e-6 diag(1, L^2) with PatchLaw's P and the solids' size L, so
///            that it has nearly nothing across the normal; what may be
///            round-off of places is not corrected: of a body at rest it would
///            be a large force
/// Source     docs/theory/contact_laws.md
/// Limits     two separate places of contact of one part, such as a plate with
///            feet, are one patch; parts of a surface are springs side by side:
///            n of them under equal pressure are sqrt(n) times as stiff as one
class PatchPair final : public joints::PairInteraction,
                        public joints::Touching {
 public:
  /// @throws InputError, without the pair's name, for a value outside its
  /// range or a meaning, two sides of which neither has a finite mass, and a
  /// restitution of a body without inertia.
  PatchPair(ContactSide A, ContactSide B, const ContactParameters& parameters);

  [[nodiscard]] std::string_view kind() const override { return "patch"; }
  void describe_parameters(Manifest& out) const override;
  [[nodiscard]] std::size_t most_points() const override {
    return PatchPoints::kCount * most_patches();
  }
  [[nodiscard]] bool couples_points() const override { return true; }
  [[nodiscard]] std::size_t memory_size() const override;
  void check(int modes_A, int modes_B) const override;
  void evaluate(const joints::PairBodies& bodies, const EvaluationTime& now,
                std::span<const double> memory,
                joints::PairResponse& out) const override;
  void evaluate_over_step(const joints::PairStep& step,
                          std::span<const double> memory,
                          joints::PairResponse& out) const override;
  void commit(const joints::PairBodies& bodies, double t,
              std::span<double> memory,
              joints::PairResponse& scratch) const override;
  [[nodiscard]] const Touching* touching() const override { return this; }

  [[nodiscard]] joints::PairTouch find_touch(
      const joints::PairBodies& bodies,
      joints::PairResponse& scratch) const override;
  [[nodiscard]] double find_clearance(
      const joints::PairBodies& bodies) const override;
  [[nodiscard]] double find_speed_bound(
      const joints::PairBodies& bodies) const override;
  [[nodiscard]] joints::TouchReach find_reach_A() const override;
  [[nodiscard]] joints::TouchReach find_reach_B() const override;
  /// At one time.
  [[nodiscard]] std::size_t most_patches() const;
  [[nodiscard]] double find_size() const override { return size_; }
  double begin_touch(const joints::PairBodies& bodies, double t,
                     std::span<double> memory,
                     joints::PairResponse& scratch) const override;
  void set_mobility(const joints::PairMobility& mobility,
                    std::span<double> memory) const override;
  void end_touch(std::span<double> memory) const override;
  [[nodiscard]] joints::TouchReading read(
      const joints::PairBodies& bodies, const EvaluationTime& now,
      std::span<const double> memory,
      joints::PairResponse& scratch) const override;

 private:
  struct Nearest;

  void add_missing(const joints::PairBodies& bodies,
                   const joints::PairResponse& at_bodies,
                   PatchTouches& touches) const;
  [[nodiscard]] double find_energy(const joints::PairBodies& bodies) const;
  [[nodiscard]] Vector6 correct(const Vector6& elastic_W, const Patch& patch,
                                const Vector6& motion, double rise,
                                double rounding) const;
  [[nodiscard]] Nearest find_nearest_parts(
      const joints::PairBodies& bodies) const;
  [[nodiscard]] PatchPoints place_points(const Patch& patch) const;
  void add_points(const joints::PairBodies& bodies, const PatchTouch& touch,
                  const PatchPoints& points, joints::PairResponse& out) const;
  [[nodiscard]] double find_released(const PatchTouches& touches, double t,
                                     std::span<const double> memory) const;
  void add_masses(const joints::PairBodies& bodies, const PatchTouches& touches,
                  std::span<const double> memory, PatchMotion& out) const;
  [[nodiscard]] PatchResponse respond(const PatchTouch& touch,
                                      const PatchMotion& all,
                                      std::span<const double> memory) const;
  [[nodiscard]] PatchMotion find_motion(const joints::PairBodies& bodies,
                                        const PatchTouches& touches,
                                        std::span<const double> memory) const;
  [[nodiscard]] double find_duration(const joints::PairBodies& bodies,
                                     const joints::PairTouch& touch,
                                     double inverse_mass) const;

  ContactSide A_;
  ContactSide B_;
  VectorX reach_A_;
  VectorX reach_B_;
  OpposedMass mass_;
  ContactParameters parameters_;
  PairModuli moduli_;
  std::unique_ptr<const PatchFinder> finder_;
  double size_;
  PatchLaw law_;
};

}  // namespace limber::contact
