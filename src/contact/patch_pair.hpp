// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/contact_side.hpp"
#include "limber/contact/narrow_phase/shape_pair.hpp"
#include "limber/contact/patch_law.hpp"
#include "limber/contact/patch_memory.hpp"
#include "limber/contact/potential/pair_potential.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::contact {

/// Contact of two solids with flat faces, boxes or half spaces: one patch with
/// one wrench, wherever they touch.
///
/// Equation   PairPotential, PatchLaw; over a step of the energy-conserving
///            scheme the elastic wrench w at its middle, corrected along the
///            relative motion m by -(W_1 - W_0 + w . m) N m / (m' N m), N =
///            diag(1, L^2) with the solids' size L
/// Source     docs/theory/contact_laws.md
/// Limits     two separate places of contact, as of a plate with feet, are one
///            patch; the solids move with their bodies' frames
class PatchPair final : public joints::PairInteraction,
                        public joints::Touching {
 public:
  /// @throws InputError, without the pair's name, for a value outside its
  /// range, two sides of which neither has a finite mass or a material, and a
  /// restitution of a body without inertia.
  /// @throws ContractError unless suits(A, B, parameters).
  PatchPair(ContactSide A, ContactSide B, const ContactParameters& parameters);

  [[nodiscard]] std::string_view kind() const override { return "patch"; }
  void describe_parameters(Manifest& out) const override;
  [[nodiscard]] std::size_t most_points() const override {
    return PatchPoints::kCount;
  }
  [[nodiscard]] bool couples_points() const override { return true; }
  [[nodiscard]] std::size_t memory_size() const override;
  void check(int /*modes_A*/, int /*modes_B*/) const override {}
  void evaluate(const joints::PairBodies& bodies, const Instant& now,
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
  [[nodiscard]] double find_size() const override { return size_; }
  double begin_touch(const joints::PairBodies& bodies, double t,
                     std::span<double> memory,
                     joints::PairResponse& scratch) const override;
  void set_mobility(const joints::PairMobility& mobility,
                    std::span<double> memory) const override;
  void end_touch(std::span<double> memory) const override;
  [[nodiscard]] joints::TouchReading read(
      const joints::PairBodies& bodies, const Instant& now,
      std::span<const double> memory,
      joints::PairResponse& scratch) const override;

  /// Whether it holds for these: solids of which one has a material, and none
  /// of the parameters of a point of contact.
  [[nodiscard]] static bool suits(const ContactSide& A, const ContactSide& B,
                                  const ContactParameters& parameters);

 private:
  [[nodiscard]] PatchPoints place_points(const Patch& patch) const;
  [[nodiscard]] double find_inverse_mass(const joints::PairBodies& bodies,
                                         const Patch& patch,
                                         std::span<const double> memory) const;
  [[nodiscard]] PatchResponse respond(const joints::PairBodies& bodies,
                                      const Patch& patch,
                                      std::span<const double> memory) const;
  [[nodiscard]] double find_duration(const joints::PairBodies& bodies,
                                     const joints::PairTouch& touch,
                                     double inverse_mass) const;

  ContactSide A_;
  ContactSide B_;
  OpposedMass mass_;
  ContactParameters parameters_;
  ShapePair shapes_;
  PairPotential potential_;
  PatchLaw law_;
  double size_;
};

}  // namespace limber::contact
