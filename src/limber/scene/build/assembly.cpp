// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/joint_state.hpp"
#include "limber/scene/build/contact_assembly.hpp"
#include "limber/scene/build/coupler_assembly.hpp"
#include "limber/scene/build/interface_tables.hpp"
#include "limber/scene/build/nodal_forces.hpp"
#include "limber/scene/build/piece_joints.hpp"
#include "limber/scene/build/recipes.hpp"
#include "limber/scene/build/rotation_check.hpp"
#include "limber/scene/control/controller_assembly.hpp"
#include "limber/scene/probes/stress_points.hpp"
#include "limber/scene/scenario/link_start.hpp"
#include "limber/scene/text/error_context.hpp"

namespace limber::scene {
namespace {

/// Mass in <inertial> may differ from the mesh's by this fraction.
constexpr double kMassFraction = 0.01;

/// Of bodies that do not deform.
constexpr flexbody::FrequencyBand kAnyBand{1.0, 2.0};

}  // namespace

Assembly::Assembly(const Scene& scene, const BodyPlans& plans,
                   const std::vector<LinkMotion>& motions,
                   const std::optional<ElasticBands>& bands)
    : scene_(scene),
      plans_(plans),
      motions_(motions),
      bands_(bands),
      sites_(scene, plans, motions, body_index_) {
  if (bands) builder_.set_gravity(scene.scenario.gravity);
}

void Assembly::add_bodies() {
  for (const BodyPlan& plan : plans_.bodies) add_body(plan);
}

void Assembly::add_body(const BodyPlan& plan) {
  if (plan.is_world) {
    body_index_.push_back(dynamics::kWorld);
    return;
  }
  if (!plan.reduced) {
    body_index_.push_back(
        builder_.add_rigid_body(plan.name, {plan.mass, plan.inertia}));
    return;
  }
  const Link& link = scene_.robot.links[index(plan.links.front())];
  const dynamics::Fidelity level = scene_.scenario.level_of(link.name);
  body_index_.push_back(add_flexible_body(plan, link));
  if (plan.piece > 0) return;
  double mass = 0.0;
  for (const BodyPlan& piece : find_bodies(plans_, plan.links.front())) {
    mass += piece.mass;
  }
  if (link.inertia &&
      std::abs(link.inertia->mass - mass) > kMassFraction * mass) {
    warnings_.push_back(
        fmt::format("link '{}': the mesh has {:.4g} kg, <inertial> has {:.4g} "
                    "kg; the mesh's is used",
                    link.name, mass, link.inertia->mass));
  }
  if (level == dynamics::Fidelity::rigid &&
      find_start(scene_.scenario, link.name) != nullptr) {
    warnings_.push_back(fmt::format(
        "link '{}' is rigid in this run: its initial deformation is left out",
        link.name));
  }
}

std::size_t Assembly::count_bodies() const {
  return body_index_.size() -
         static_cast<std::size_t>(std::count(
             body_index_.begin(), body_index_.end(), dynamics::kWorld));
}

dynamics::BodyIndex Assembly::add_flexible_body(const BodyPlan& plan,
                                                const Link& link) {
  using dynamics::Fidelity;
  Fidelity level = scene_.scenario.level_of(link.name);
  if (!bands_) {
    if (level != Fidelity::rigid) {
      level = plan.reduced->inertia_record.gap.empty() ? Fidelity::coupled
                                                       : Fidelity::uncoupled;
    }
    return builder_.add_flexible_body(plan.name, plan.reduced, level, {});
  }
  dynamics::ModalDamping damping = link.flexible->damping;
  const double loss_factor = link.flexible->loss_factor;
  if (damping.rayleigh_mass > 0.0 && !plan.reduced->clamped) {
    throw InputError(fmt::format(
        "link '{}': rayleigh_mass would damp its motion relative to its own "
        "moving frame, not relative to its supports, so that it hardly damps "
        "the modes of the arm; it is allowed only for a link with a <clamp>. "
        "Give a ratio or a loss_factor",
        link.name));
  }
  if (plan.full) {
    if (loss_factor > 0.0) {
      if (!damping.ratios.empty()) {
        throw InputError(fmt::format(
            "link '{}': at level full it takes a loss factor or per_mode, not "
            "both",
            link.name));
      }
      damping.ratios = {0.5 * loss_factor};
      warnings_.push_back(
          fmt::format("link '{}' is at level full: its damping ratio of {:g} "
                      "acts on the modes of the body with the boundary "
                      "conditions of its reduction, and those of the arm are "
                      "damped less; at other levels it is that of all modes",
                      link.name, 0.5 * loss_factor));
    }
    return builder_.add_full_body(plan.name, plan.reduced, plan.full, damping);
  }
  if (loss_factor > 0.0) {
    damping.maxwell = with_context("link '" + link.name + "'", [&] {
      return flexbody::find_maxwell_elements(
          loss_factor, bands_->at(count_bodies()).value_or(kAnyBand));
    });
  }
  return builder_.add_flexible_body(plan.name, plan.reduced, level, damping);
}

void Assembly::add_inputs() { scene::add_inputs(scene_.scenario, builder_); }

void Assembly::add_couplers() {
  add_piece_joints(scene_, plans_, sites_, builder_);
  CouplerAssembly couplers(scene_, plans_, sites_, builder_, warnings_);
  couplers.add_all();
  if (auto note = couplers.describe_explicit_defaults()) {
    notes_.push_back(std::move(*note));
  }
}

void Assembly::add_loads() {
  for (const LoadSpec& load : scene_.scenario.loads) {
    with_context("load '" + load.name + "'", [&] {
      load.nodal_forces.empty() ? add_load(load) : add_nodal_load(load);
    });
  }
}

void Assembly::add_contacts() {
  touching_ = ContactAssembly(scene_, sites_, builder_, warnings_).add_all();
}

void Assembly::check_start(const dynamics::SystemModel& model,
                           const dynamics::SystemState& initial) {
  with_context(scene_.scenario.file.string(), [&] {
    for (std::string& notice : check_overlaps(touching_, model, initial)) {
      warnings_.push_back(std::move(notice));
    }
  });
}

PlacedLink Assembly::place_link(int link) const {
  // The frame of the world's body is that of the root link.
  return {sites_.body_of(link), sites_.body_of(link) == dynamics::kWorld
                                    ? motions_[index(link)].X_WL
                                    : sites_.X_BL(link)};
}

void Assembly::add_nodal_load(const LoadSpec& load) {
  const int link = find_link(scene_.robot, load.where.link);
  const BodyPlan& plan = sites_.plan_of(link);
  const FlexibleLink& flexible = *scene_.robot.links[index(link)].flexible;
  const ForceFile file = read_force_file(load.nodal_forces);
  const MatrixX forces = spread_over_nodes(
      *plan.reduced, flexible.clamped_groups, file, load.nodal_forces);
  const bool is_second = scene_.scenario.level_of(load.where.link) ==
                         dynamics::Fidelity::nonlinear;
  const auto reduce = is_second ? flexbody::reduce_second_order_load
                                : flexbody::reduce_nodal_load;
  builder_.add_nodal_load(load.name, sites_.body_of(link),
                          reduce(*plan.reduced, file.times, forces), forces);
}

void Assembly::check_moment(const LoadSpec& load,
                            const AttachmentSite& site) const {
  if (!site.anchor.table || load.moment.isZero()) return;
  const int link = find_link(scene_.robot, load.where.link);
  if (load.frame == dynamics::LoadFrame::body) {
    check_rotation(site, joints::rotation_about(load.moment));
  } else if (sites_.plan_of(link, site.anchor.piece).reduced->clamped) {
    const Matrix3& R_WL = motions_[index(link)].X_WL.R;
    check_rotation(site,
                   joints::rotation_about(R_WL.transpose() * load.moment));
  } else {
    with_context(
        "its moment is fixed in the world, so it acts about every direction of "
        "a link that rotates",
        [&] { check_rotation(site, Matrix3::Identity()); });
  }
}

// Ten radii of gyration are three lengths of a rod.
void Assembly::question_distance(const LoadSpec& load, const BodyPlan& plan,
                                 const Vector3& p_B) {
  constexpr double kFar = 10.0;
  constexpr double kLeast = 1.0;  // [m]
  const double radius = std::sqrt(0.5 * plan.inertia.trace() / plan.mass);
  const double far = std::max(kLeast, kFar * radius);
  if (!load.where.point || !(p_B.norm() > far)) return;
  warnings_.push_back(fmt::format(
      "load '{}' acts {:.3g} m from the centre of mass of link '{}', whose "
      "radius of gyration is {:.3g} m; is its point in metres, in the link's "
      "frame?",
      load.name, p_B.norm(), load.where.link, radius));
}

void Assembly::add_load(const LoadSpec& load) {
  const int link = find_link(scene_.robot, load.where.link);
  const BodyPlan& plan = sites_.plan_of(link);
  if (plan.is_world) throw InputError("it acts on the world, which is fixed");
  Pose X_LF{Matrix3::Identity(), load.where.point.value_or(Vector3::Zero())};
  Anchor anchor;
  if (plan.reduced) {
    anchor = find_anchor(sites_.pieces_of(link), load.where);
    X_LF.p = sites_.X_BL(link, anchor.piece).inverse() * anchor.table->p_B;
  }
  const AttachmentSite site = sites_.find_site(link, X_LF, anchor);
  check_moment(load, site);
  question_distance(load, plan, site.X_BF.p);
  const dynamics::AttachmentIndex where = attach(load.name, site, builder_);
  const bool in_body = load.frame == dynamics::LoadFrame::body;
  const Matrix3 R =
      in_body ? sites_.X_BL(link).R : Matrix3(Matrix3::Identity());
  builder_.add_load(load.name, where, R * load.force, R * load.moment,
                    load.frame, load.time);
}

std::vector<Probe> Assembly::make_probes(
    const dynamics::SystemModel& model) const {
  std::vector<Probe> probes;
  for (const ProbeSpec& spec : scene_.scenario.probes) {
    const std::string who = "probe '" + spec.name + "'";
    if (const auto* point = std::get_if<PointProbeSpec>(&spec.of)) {
      probes.push_back(
          {spec.name, with_context(who + " on link '" + point->where.link + "'",
                                   [&] { return make_point_probe(*point); })});
      continue;
    }
    if (const auto* contact = std::get_if<ContactProbeSpec>(&spec.of)) {
      probes.push_back({spec.name, with_context(who, [&] {
                          return make_contact_probe(*contact, model);
                        })});
      continue;
    }
    if (const auto* written = std::get_if<ControllerProbeSpec>(&spec.of)) {
      probes.push_back({spec.name, ControllerProbe{find_controller(
                                       scene_.scenario, written->controller)}});
      continue;
    }
    if (const auto* stress = std::get_if<StressProbeSpec>(&spec.of)) {
      probes.push_back(
          {spec.name,
           with_context(who + " on link '" + stress->where.link + "'",
                        [&] { return make_stress_probe(*stress); })});
      continue;
    }
    const auto& coupler = std::get<CouplerProbeSpec>(spec.of);
    probes.push_back({spec.name, with_context(who, [&] {
                        return make_coupler_probe(coupler, model);
                      })});
  }
  if (scene_.scenario.output.stress) add_stress_of_links(probes);
  return probes;
}

// @param piece of the link, or that which has the place
StressProbe Assembly::make_stress_probe(const StressProbeSpec& spec,
                                        std::optional<int> piece) const {
  const int link = find_link(scene_.robot, spec.where.link);
  const dynamics::Fidelity level = scene_.scenario.level_of(spec.where.link);
  if (!has_stress(level)) throw InputError(explain_no_stress());
  const StressPlace place = {find_place_interface(spec.where), spec.where.nodes,
                             spec.section};
  const std::span<const BodyPlan> pieces = sites_.pieces_of(link);
  int at = piece.value_or(0);
  if (!piece && pieces.size() > 1) {
    if (place.interface.empty()) {
      throw InputError(
          fmt::format("it is cut into {} pieces, which are separate bodies; "
                      "select a location, or set '[output] stress = true', "
                      "which reports the largest of each",
                      pieces.size()));
    }
    at = find_piece(pieces, spec.where);
  }
  const BodyPlan& plan = sites_.plan_of(link, at);
  const Pose X_BL = sites_.X_BL(link, at);
  StressProbe probe =
      plan.full ? make_full_stress_probe(spec.quantity, *plan.reduced,
                                         *plan.full, place, X_BL)
                : scene::make_stress_probe(spec.quantity, *plan.reduced, level,
                                           place, X_BL);
  probe.body = sites_.body_of(link, at);
  const FlexibleLink& flexible = *scene_.robot.links[index(link)].flexible;
  if (flexible.reduced_file.empty() && !flexible.basis.automatic) {
    probe.eigenmodes = flexible.basis.eigenmodes;
  }
  return probe;
}

void Assembly::add_stress_of_links(std::vector<Probe>& probes) const {
  for (const BodyPlan& plan : plans_.bodies) {
    const std::string& link =
        scene_.robot.links[index(plan.links.front())].name;
    if (!plan.reduced || !wants_stress(scene_.scenario, link)) continue;
    const std::string name = plan.name + ".surface";
    with_context("[output] stress: link '" + plan.name + "'", [&] {
      const auto is_taken = [&](const Probe& probe) {
        return probe.name == name;
      };
      if (std::any_of(probes.begin(), probes.end(), is_taken)) {
        throw InputError("its columns are called like probe '" + name +
                         "'; rename that");
      }
      StressProbeSpec everywhere;
      everywhere.where.link = link;
      StressProbe probe = make_stress_probe(everywhere, plan.piece);
      probe.is_of_link = true;
      probes.push_back({name, std::move(probe)});
    });
  }
}

ContactProbe Assembly::make_contact_probe(
    const ContactProbeSpec& spec, const dynamics::SystemModel& model) const {
  const ProbedContact found =
      check_contact_probe(spec, scene_.touching, scene_.robot, scene_.scenario);
  std::vector<dynamics::PairIndex> pairs;
  for (const PlacedPair& placed : touching_) {
    if (placed.touching == found.touching) pairs.push_back(placed.pair);
  }
  return scene::make_contact_probe(spec, found.is_turned, pairs, model);
}

PointProbe Assembly::make_point_probe(const PointProbeSpec& spec) const {
  const int link = find_link(scene_.robot, spec.where.link);
  if (sites_.plan_of(link).is_world) {
    throw InputError("it is on the world, which is fixed");
  }
  const bool rotates = spec.quantity == Quantity::rotation ||
                       spec.quantity == Quantity::angular_velocity;
  PointProbe probe = make_followed_point(spec.where, rotates);
  probe.quantity = spec.quantity;
  if (!spec.relative_to) return probe;
  const PointProbe base = with_context(
      "relative_to link '" + spec.relative_to->link + "'",
      [&] { return make_followed_point(*spec.relative_to, true); });
  probe.base = std::make_shared<const PointProbe>(base);
  return probe;
}

PointProbe Assembly::make_followed_point(const Place& where,
                                         bool rotates) const {
  const int link = find_link(scene_.robot, where.link);
  const Pose X_BL = sites_.X_BL(link);
  PointProbe probe;
  probe.body = sites_.body_of(link);
  probe.R_BL = X_BL.R;
  probe.p_B = X_BL * where.point.value_or(Vector3::Zero());
  if (!sites_.plan_of(link).reduced) return probe;
  const Anchor anchor = find_anchor(sites_.pieces_of(link), where);
  const BodyPlan& plan = sites_.plan_of(link, anchor.piece);
  probe.body = sites_.body_of(link, anchor.piece);
  if (rotates) check_rotation(*anchor.table, Matrix3::Identity());
  probe.p_B = anchor.table->p_B;
  probe.Phi_B = anchor.table->Phi_B;
  probe.Psi_B = anchor.table->Psi_B;
  if (scene_.scenario.level_of(where.link) == dynamics::Fidelity::nonlinear) {
    probe.second = std::make_shared<const flexbody::QuadraticFrame>(
        flexbody::make_quadratic_frame(plan.reduced->manifold->paired,
                                       anchor.table->Phi2_B,
                                       anchor.table->Psi2_B));
  }
  if (anchor.nodes) {
    probe.nodal = std::make_shared<const dynamics::NodalFrame>(
        dynamics::make_nodal_frame(*plan.full, *anchor.nodes, probe.p_B));
  }
  return probe;
}

dynamics::SystemModel Assembly::build() const { return builder_.build(); }

void Assembly::deform(const dynamics::SystemModel& model,
                      const dynamics::BodyModel& body, VectorX& u_B,
                      VectorX& udot_B, dynamics::SystemState& state) const {
  const LinkStart* start = find_start(scene_.scenario, body.name);
  if (start == nullptr || body.fidelity == dynamics::Fidelity::rigid) return;
  with_context("[initial.links." + body.name + "]", [&] {
    const ModalStart modal = find_modal_start(*start, *body.reduced);
    if (body.full >= 0) {
      const auto& full = model.full_bodies[index(body.full)];
      const MatrixX& Phi = body.reduced->rows.Phi_B;
      u_B.segment(full.first, full.dofs()) = Phi * modal.eta;
      udot_B.segment(full.first, full.dofs()) = Phi * modal.etadot;
      return;
    }
    state.eta.segment(body.offset, body.modes) = modal.eta;
    state.etadot.segment(body.offset, body.modes) = modal.etadot;
  });
}

dynamics::SystemState Assembly::make_initial_state(
    const dynamics::SystemModel& model) const {
  dynamics::SystemState state = dynamics::make_state(model);
  follow_links(find_placed_bodies(plans_), motions_, state);
  VectorX u_B = state.u_H;
  VectorX udot_B = state.udot_H;
  for (const dynamics::BodyIndex body : body_index_) {
    if (body == dynamics::kWorld) continue;
    deform(model, model.bodies[index(body)], u_B, udot_B, state);
  }
  place_nodes(model, u_B, udot_B, state);
  store_turns(model, find_joint_starts(scene_.robot, scene_.scenario), state);
  return state;
}

}  // namespace limber::scene
