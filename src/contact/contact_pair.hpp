// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/contact/law/point_law.hpp"
#include "limber/contact/narrow_phase/shape_pair.hpp"
#include "limber/contact/pad_contact.hpp"
#include "limber/contact/patches/contact_side.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::contact {

struct Touch;

/// Contact of two shapes that have no potential (PatchPair): at each of their
/// features a normal force, which stores energy and is damped to a restitution,
/// and friction.
///
/// Equation   on B at a feature f n + t, f = damp(HertzLaw(k, R)) at its depth
///            with one s of all features that touch (find_damping), k for 1/R_e
///            = the sum of both curvatures, R = R_A + R_B the residual
///            flexibilities of both bases there; t of LoadShells within mu f;
///            for a flat surface of a flexible body on a plane, a face of a
///            box, an end of a cylinder or another flat surface the forces of
///            its pads (PadContact); for shapes that touch at one place also
///            a friction moment about the normal, as a couple of two forces
/// Source     docs/theory/contact_laws.md
/// Limits     flexible bodies are damped as rigid ones, and as free ones where
///            no mobility of joints is set; the tangent takes the normal and
///            the damping by other features as constant; shapes that touch at
///            several features have no torsional friction at each of them
class ContactPair final : public joints::PairInteraction,
                          public joints::Touching {
 public:
  /// @throws InputError, without the pair's name, for a value outside its
  /// range, shapes that have no rule for each other, two sides of which neither
  /// has a finite mass, and a restitution of a body that may turn without
  /// inertia.
  ContactPair(ContactSide side_A, ContactSide side_B,
              const ContactParameters& parameters);

  [[nodiscard]] std::string_view kind() const override { return "contact"; }
  void describe_parameters(Manifest& out) const override;
  [[nodiscard]] std::size_t most_points() const override;
  [[nodiscard]] bool couples_points() const override {
    return pads_.has_value() || has_twist_;
  }
  [[nodiscard]] std::size_t memory_size() const override;
  void check(int modes_A, int modes_B) const override;
  void evaluate(const joints::PairBodies& bodies, const Instant& now,
                std::span<const double> memory,
                joints::PairResponse& out) const override;
  void evaluate_over_step(const joints::PairStep& step,
                          std::span<const double> memory,
                          joints::PairResponse& out) const override;
  void commit(const joints::PairBodies& bodies, double t,
              std::span<double> memory,
              joints::PairResponse& scratch) const override;
  [[nodiscard]] const joints::Touching* touching() const override {
    return this;
  }

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
  void set_mobility(const joints::PairMobility& mobility,
                    std::span<double> memory) const override;
  void end_touch(std::span<double> memory) const override;
  double begin_touch(const joints::PairBodies& bodies, double t,
                     std::span<double> memory,
                     joints::PairResponse& scratch) const override;
  [[nodiscard]] joints::TouchReading read(
      const joints::PairBodies& bodies, const Instant& now,
      std::span<const double> memory,
      joints::PairResponse& scratch) const override;

 private:
  [[nodiscard]] std::size_t count_features() const {
    return shapes_.most_points();
  }
  void add_twist(const joints::PairBodies& bodies, const Meeting& meeting,
                 const PointResponse& response, std::size_t point,
                 joints::PairResponse& out) const;
  // Finds all meetings, in the order of the points' memories.
  void meet(const joints::PairBodies& bodies, double reach,
            std::span<const double> memory, std::span<Meeting> out) const;
  // The same at a step's begin, middle and end, in one common order.
  void meet(const joints::PairStep& step, std::span<const double> memory,
            std::span<Meeting> begin, std::span<Meeting> middle,
            std::span<Meeting> end) const;
  [[nodiscard]] bool is_pad(std::size_t i) const {
    return i < shapes_.pad_count();
  }
  void evaluate_pads(std::span<const Meeting> meetings,
                     PadLaw::Response& out) const;
  [[nodiscard]] ElasticPoint find_elastic(const PointMotion& motion,
                                          std::size_t i,
                                          const PadLaw::Response& pads) const;
  // Finds all that touches, and adds a point to `out` for each.
  void gather(const joints::PairBodies& bodies, double t,
              std::span<const double> memory, std::span<const Meeting> meetings,
              Touch& touch, joints::PairResponse& out) const;
  [[nodiscard]] double find_inverse_mass(const joints::PairBodies& bodies,
                                         const Touch& touch) const;
  void set_rates(const joints::PairBodies& bodies, const Touch& touch,
                 joints::TouchReading& reading) const;
  [[nodiscard]] DampingRate find_damping(const joints::PairBodies& bodies,
                                         const Touch& touch) const;
  // Sets the forces and tangents of the touch's points.
  void respond(const joints::PairBodies& bodies,
               std::span<const Meeting> meetings, const Touch& touch,
               joints::PairResponse& out) const;
  [[nodiscard]] bool touches(const Meeting& meeting, std::size_t i,
                             const PadLaw::Response& pads) const;
  // The meetings of a step's begin, middle and end.
  struct StepMeetings {
    std::span<const Meeting> begin;
    std::span<const Meeting> middle;
    std::span<const Meeting> end;
  };
  void add_pads_over_step(const joints::PairStep& step,
                          const StepMeetings& meetings,
                          std::span<const double> memory, Touch& touch,
                          joints::PairResponse& out) const;
  [[nodiscard]] PointMotion place(const joints::PairBodies& bodies,
                                  const Meeting& meeting,
                                  const PointMemory& memory, double t,
                                  joints::PairPoint& point) const;
  [[nodiscard]] HertzLaw find_law(const Meeting& meeting, double share) const;
  // The force over a step that balances the energies of both ends, and the mean
  // of these.
  [[nodiscard]] ElasticPoint find_step_force(const joints::PairStep& step,
                                             const PointMotion& motion,
                                             const joints::PairPoint& point,
                                             const Meeting& begin,
                                             const Meeting& end) const;

  ContactSide A_;
  ContactSide B_;
  OpposedMass mass_;
  ContactParameters parameters_;
  ShapePair shapes_;
  PointLaw law_;
  std::optional<PadContact> pads_;
  bool has_twist_;
  double size_;
  VectorX mode_reach_A_;
  VectorX mode_reach_B_;
};

}  // namespace limber::contact
