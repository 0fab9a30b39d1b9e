// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/model_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <set>
#include <string>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber::dynamics {
namespace {

class ModelCheck {
 public:
  explicit ModelCheck(const SystemModel& model) : model_(model) {}

  void run() {
    if (model_.bodies.empty()) add("the system has no body that can move");
    check_names("body", model_.bodies);
    check_names("coupler", model_.couplers);
    check_names("transmission", model_.transmissions);
    check_names("load", model_.loads);
    check_names("pair", model_.pairs);
    check_names("input", model_.inputs);
    check_names("controller", model_.controllers);
    check_bodies();
    check_full_bodies();
    for (const Attachment& attachment : model_.attachments) check(attachment);
    for (const Coupler& coupler : model_.couplers) check(coupler);
    if (problems_.empty()) check_ideal_joints();
    for (const Transmission& transmission : model_.transmissions) {
      check(transmission);
    }
    for (const Load& load : model_.loads) check(load);
    for (const BodyLoad& load : model_.body_loads) {
      require(has(model_.bodies, load.body), "load", load.name,
              "it acts on no body");
    }
    for (const Pair& pair : model_.pairs) check(pair);
    for (const ControllerModel& controller : model_.controllers) {
      require(controller.law != nullptr, "controller", controller.name,
              "it has no law");
      check_inputs("controller", controller.name, controller.writes);
    }
    if (!model_.gravity_W.allFinite()) add("gravity is not finite");
    if (!problems_.empty()) throw InputError(problems_);
  }

 private:
  template <typename Thing>
  [[nodiscard]] static bool has(const std::vector<Thing>& things, int i) {
    return i >= 0 && i < std::ssize(things);
  }

  void add(const std::string& text) { problems_.push_back(text); }
  void require(bool holds, const char* kind, const std::string& name,
               const std::string& problem) {
    if (!holds) add(fmt::format("{} '{}': {}", kind, echo(name), problem));
  }

  template <typename Thing>
  void check_names(const char* kind, const std::vector<Thing>& things) {
    std::set<std::string> taken;
    for (const Thing& thing : things) {
      if (thing.name.empty()) add(fmt::format("a {} has no name", kind));
      require(taken.insert(thing.name).second, kind, thing.name,
              fmt::format("another {} has this name", kind));
    }
  }

  void check_bodies() {
    int offset = 0;
    Eigen::Index row = 0;
    int maxwell_offset = 0;
    for (const BodyModel& body : model_.bodies) {
      const auto expect = [&](bool holds, const char* problem) {
        require(holds, "body", body.name, problem);
      };
      expect(body.mass > 0.0 && std::isfinite(body.mass),
             "it has no mass; a body that moves needs mass > 0");
      expect(body.J0.allFinite(), "its inertia is not finite");
      expect(body.modes >= 0 && body.offset == offset,
             "its modal coordinates do not follow those of the body before it");
      expect(body.row == row,
             "its unknowns do not follow those of the body before it");
      expect(flexbody::count_modes(body.elasticity) == body.modes &&
                 body.damping.size() == body.modes,
             "its elasticity or damping rates are not one a mode");
      expect(body.damping.allFinite(), "its damping rates are not finite");
      expect(body.inertia != nullptr, "its inertia by mode is missing");
      expect(body.full < 0 || has(model_.full_bodies, body.full),
             "its mesh is missing");
      const flexbody::MaxwellElements& maxwell = body.maxwell;
      expect(body.maxwell_offset == maxwell_offset,
             "its Maxwell elements do not follow those of the body before it");
      expect(maxwell.strengths.size() == maxwell.size() &&
                 (maxwell.strengths.array() >= 0.0).all() &&
                 (maxwell.times.array() > 0.0).all() &&
                 maxwell.strengths.allFinite() && maxwell.times.allFinite(),
             "its Maxwell elements are not finite strengths >= 0 and times > "
             "0");
      offset += body.modes;
      row += 6 + body.modes;
      maxwell_offset += body.modes * static_cast<int>(maxwell.size());
    }
    if (maxwell_offset != model_.maxwell_count) {
      add(fmt::format("the bodies have {} Maxwell elements together, not {}",
                      maxwell_offset, model_.maxwell_count));
    }
    if (offset != model_.modal_count) {
      add(fmt::format("the bodies have {} modal coordinates together, not {}",
                      offset, model_.modal_count));
    }
  }

  void check_full_bodies() {
    Eigen::Index first = 0;
    for (const FullModel& full : model_.full_bodies) {
      if (!has(model_.bodies, full.body) || full.mesh == nullptr ||
          full.first != first) {
        add("an unreduced body has no body, no mesh or another place in the "
            "state than that after the one before it");
        return;
      }
      first += full.dofs();
    }
    if (first != model_.nodal_count) {
      add(fmt::format("the meshes have {} nodal coordinates together, not {}",
                      first, model_.nodal_count));
    }
  }

  void check(const Attachment& attachment) {
    const auto expect = [&](bool holds, const char* problem) {
      require(holds, "frame", attachment.name, problem);
    };
    expect(attachment.p_BF.allFinite() && attachment.R_BF.allFinite(),
           "its pose is not finite");
    if (attachment.body == kWorld) return;
    if (!has(model_.bodies, attachment.body)) {
      expect(false, "it is on no body");
      return;
    }
    const BodyModel& body = model_.bodies[index(attachment.body)];
    expect(attachment.Phi_B.cols() == body.modes &&
               attachment.Psi_B.cols() == body.modes,
           "its tables do not have a column for each mode of its body");
    expect(!attachment.nodal || body.full >= 0,
           "it follows nodes, but its body is reduced");
  }

  void check(const Coupler& coupler) {
    if (!has(model_.attachments, coupler.frame_F) ||
        !has(model_.attachments, coupler.frame_M)) {
      require(false, "coupler", coupler.name, "it joins no two frames");
      return;
    }
    require(model_.attachments[index(coupler.frame_F)].body !=
                model_.attachments[index(coupler.frame_M)].body,
            "coupler", coupler.name, "both of its ends are on the same body");
    check_inputs("coupler", coupler.name, joints::find_inputs(coupler.law));
  }

  // Of a loop of ideal joints the forces would not be determined.
  void check_ideal_joints() {
    std::vector<std::size_t> root_of(model_.bodies.size() + 1);
    std::iota(root_of.begin(), root_of.end(), std::size_t{0});
    const auto find_root = [&](AttachmentIndex frame) {
      const BodyIndex b = model_.attachments[index(frame)].body;
      std::size_t i = b == kWorld || model_.bodies[index(b)].clamped
                          ? model_.bodies.size()
                          : index(b);
      while (root_of[i] != i) i = root_of[i];
      return i;
    };
    for (const Coupler& coupler : model_.couplers) {
      if (!joints::is_ideal(coupler.law)) continue;
      const std::size_t F = find_root(coupler.frame_F);
      const std::size_t M = find_root(coupler.frame_M);
      require(F != M, "joint", coupler.name,
              "it closes a loop of ideal joints; give it a stiffness");
      root_of[F] = M;
    }
  }

  void check(const Transmission& transmission) {
    const auto expect = [&](bool holds, const char* problem) {
      require(holds, "transmission", transmission.name, problem);
    };
    if (const auto* path =
            std::get_if<PathCoordinate>(&transmission.coordinate)) {
      expect(path->points.size() >= 2, "its path has fewer than two points");
      for (const AttachmentIndex point : path->points) {
        expect(has(model_.attachments, point),
               "its path has a point on no frame");
      }
      return;
    }
    const auto& sum = std::get<JointSum>(transmission.coordinate);
    expect(!sum.terms.empty(), "its sum has no joint");
    for (const JointSum::Term& term : sum.terms) {
      expect(has(model_.couplers, term.coupler) &&
                 has(joints::coordinates_of(
                         model_.couplers[index(term.coupler)].law),
                     term.coordinate),
             "a term of its sum is not a coordinate of a joint");
      expect(std::isfinite(term.factor) && term.factor != 0.0,
             "a factor of its sum is zero or not finite");
    }
  }

  void check(const Load& load) {
    const auto expect = [&](bool holds, const char* problem) {
      require(holds, "load", load.name, problem);
    };
    const bool is_there = has(model_.attachments, load.where);
    expect(is_there, "it acts on no frame");
    expect(!is_there || model_.attachments[index(load.where)].body != kWorld,
           "it acts on the world, which does not move");
    expect(load.force.allFinite() && load.moment.allFinite(),
           "its force or moment is not finite");
    if (const auto* input = std::get_if<InputFunction>(&load.function)) {
      check_inputs("load", load.name, {input->input});
    }
  }

  void check(const Pair& pair) {
    const auto expect = [&](bool holds, const char* problem) {
      require(holds, "pair", pair.name, problem);
    };
    expect(pair.law != nullptr, "it has no law");
    expect(pair.body_A != pair.body_B, "its two bodies are one");
    for (const BodyIndex body : {pair.body_A, pair.body_B}) {
      expect(body == kWorld || has(model_.bodies, body),
             "one of its bodies does not exist");
    }
    expect(pair.first_memory <= model_.pair_memory_size,
           "its memory is not in the state");
  }

  void check_inputs(const char* kind, const std::string& name,
                    const std::vector<int>& inputs) {
    for (const int input : inputs) {
      require(has(model_.inputs, input), kind, name,
              "one of its inputs does not exist");
    }
  }

  const SystemModel& model_;
  std::vector<std::string> problems_;
};

}  // namespace

void check_model(const SystemModel& model) { ModelCheck(model).run(); }

SystemModel with_controllers(SystemModel model,
                             std::vector<ControllerModel> controllers) {
  model.controllers = std::move(controllers);
  check_model(model);
  return model;
}

}  // namespace limber::dynamics
