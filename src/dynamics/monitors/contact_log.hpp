// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/refined_peak.hpp"
#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/monitors/contact_record.hpp"
#include "limber/dynamics/monitors/touch_watch.hpp"

namespace limber::dynamics {

/// A contact of a pair, from its first to its last touch.
struct OngoingContact {
  bool is_touching = false;
  double force = 0.0;         ///< normal, at the last state [N]
  double left = 0.0;          ///< time of the last leave [s]
  RefinedPeak most_force;     ///< of this record, normal [N]
  RefinedPeak most_depth;     ///< of this record [m]
  ContactRecord record = {};  ///< of no touches: there is none
};

constexpr auto fields_of(const OngoingContact*) {
  return list_fields("ongoing contact", "is touching", "force [N]", "left [s]",
                     "largest force [N]", "largest depth [m]", "record");
}

/// Records every impact from the ends of all accepted steps.
///
/// Equation   impulse by the trapezoidal rule; peaks of parabolas through three
///            steps' ends
class ContactLog {
 public:
  ContactLog(const SystemModel& model, IntegratorKind scheme);

  /// To be called at the start, and then after every accepted step.
  void include(const SystemState& state, TouchWatch& touches);

  /// In the order of time; contacts that have not ended last until the last
  /// state.
  [[nodiscard]] std::vector<ContactRecord> find_records() const;
  /// Warns of steps too long for their impacts, of bases too small for them
  /// (ImpactSpectrum), of joints too soft (JointResponse), of contacts deeper
  /// than kDeepest, of touches of surfaces that do not face each other, and of
  /// the stable step of an explicit scheme where the force was largest.
  void add_warnings(std::vector<std::string>& warnings) const;
  /// Depth over the radius of curvature, or over the smaller body's extent
  /// (areas shared by corners of a mesh define no radius), that gives a
  /// warning: the area's radius is then 0.3 of it, while Hertz's paraboloid on
  /// a half space assumes that it is small [@johnson1985] [-].
  static constexpr double kDeepest = 0.1;

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  void include(std::size_t index, const SystemState& state, TouchWatch& touches,
               double h);
  void begin(std::size_t index, const SystemState& state, TouchWatch& touches);
  [[nodiscard]] double find_approach(const Pair& pair, const SystemState& state,
                                     const Vector3& p_W,
                                     const Vector3& normal_W) const;

  void keep_stiffest(const SystemState& state, const ContactRecord& record);
  void add_stable_step(std::vector<std::string>& warnings) const;
  void add_deep(const std::vector<ContactRecord>& records,
                std::vector<std::string>& warnings) const;
  void add_unmet(const std::vector<ContactRecord>& records,
                 std::vector<std::string>& warnings) const;
  [[nodiscard]] double find_extent(const std::string& pair) const;

  const SystemModel& model_;
  IntegratorKind scheme_;
  // For explicit schemes, the state with the largest force.
  SystemState stiffest_;
  ContactRecord strongest_;
  std::vector<OngoingContact> pairs_;  // in the order of TouchWatch
  std::vector<ContactRecord> finished_;
  double time_ = 0.0;  // of the last state [s]
};

}  // namespace limber::dynamics
