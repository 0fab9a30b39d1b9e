// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/scene/build/attachment_sites.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/build/link_motion.hpp"
#include "limber/scene/build/scene.hpp"
#include "limber/scene/contacts/start_overlap.hpp"
#include "limber/scene/probes/probe.hpp"

namespace limber::scene {

/// Of dynamics::find_elastic_bands, one per body.
using ElasticBands = std::vector<std::optional<flexbody::FrequencyBand>>;

/// Builds a scene's system, part by part.
class Assembly {
 public:
  /// @param bands of frequencies for loss factors; without them all flexible
  /// bodies are linear and undamped, at level coupled, as find_bands needs them
  Assembly(const Scene& scene, const BodyPlans& plans,
           const std::vector<LinkMotion>& motions,
           const std::optional<ElasticBands>& bands);

  void add_bodies();
  void add_inputs();
  void add_couplers();
  void add_loads();
  void add_contacts();
  /// @param model the result of build()
  [[nodiscard]] std::vector<Probe> make_probes(
      const dynamics::SystemModel& model) const;

  /// @throws InputError with every problem found so far.
  [[nodiscard]] dynamics::SystemModel build() const;
  [[nodiscard]] dynamics::SystemState make_initial_state(
      const dynamics::SystemModel& model) const;
  /// Adds warnings of bodies in contact that overlap at the start.
  /// @throws InputError if they overlap too deeply.
  void check_start(const dynamics::SystemModel& model,
                   const dynamics::SystemState& initial);
  [[nodiscard]] PlacedLink place_link(int link) const;
  [[nodiscard]] const std::vector<std::string>& warnings() const {
    return warnings_;
  }
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  void add_body(const BodyPlan& plan);
  [[nodiscard]] std::size_t count_bodies() const;
  [[nodiscard]] dynamics::BodyIndex add_flexible_body(const BodyPlan& plan,
                                                      const Link& link);
  void check_moment(const LoadSpec& load, const AttachmentSite& site) const;
  /// Warns of a point far from the body: in another unit or frame.
  void question_distance(const LoadSpec& load, const BodyPlan& plan,
                         const Vector3& p_B);
  void add_load(const LoadSpec& load);
  void add_nodal_load(const LoadSpec& load);
  PointProbe make_point_probe(const PointProbeSpec& spec) const;
  StressProbe make_stress_probe(const StressProbeSpec& spec,
                                std::optional<int> piece = {}) const;
  void add_stress_of_links(std::vector<Probe>& probes) const;
  PointProbe make_followed_point(const Place& where, bool rotates) const;
  ContactProbe make_contact_probe(const ContactProbeSpec& spec,
                                  const dynamics::SystemModel& model) const;
  void deform(const dynamics::SystemModel& model,
              const dynamics::BodyModel& body, VectorX& u_B, VectorX& udot_B,
              dynamics::SystemState& state) const;

  const Scene& scene_;
  const BodyPlans& plans_;
  const std::vector<LinkMotion>& motions_;
  std::optional<ElasticBands> bands_;
  std::vector<dynamics::BodyIndex> body_index_;  ///< one per plan
  AttachmentSites sites_;
  dynamics::SystemBuilder builder_;
  std::vector<PlacedPair> touching_;
  std::vector<std::string> warnings_;
  std::vector<std::string> notes_;
};

}  // namespace limber::scene
