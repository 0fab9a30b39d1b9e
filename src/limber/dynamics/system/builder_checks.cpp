// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/builder_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/utf8.hpp"
#include "limber/dynamics/system/inertia_check.hpp"
#include "limber/dynamics/system/name_register.hpp"

namespace limber::dynamics {
namespace {

void check_finite(const std::string& what, const std::string& value,
                  bool is_finite) {
  if (is_finite) return;
  throw InputError(fmt::format("{}: {} is not finite", what, value));
}

void check_size(const std::string& what, const std::string& table,
                Eigen::Index found, Eigen::Index expected) {
  if (found == expected) return;
  throw ContractError(fmt::format("{}: {} has {} columns; expected {}", what,
                                  table, found, expected));
}

void check_rate(const std::string& what, const std::string& value,
                double rate) {
  if (rate >= 0.0 && std::isfinite(rate)) return;
  throw InputError(
      fmt::format("{}: {} is {:g}; expected a finite number >= 0; a negative "
                  "one would supply energy",
                  what, value, rate));
}

}  // namespace

std::string NameRegister::check(const std::string& kind,
                                const std::string& name) const {
  if (name.empty()) {
    throw InputError(fmt::format("a {} has no name; give it one", kind));
  }
  if (!is_utf8(name)) {
    throw InputError(fmt::format(
        "the name '{}' of a {} is not UTF-8, which formats of results need",
        echo(name), kind));
  }
  if (has_control(name) || name.size() > kMostNameBytes) {
    throw InputError(fmt::format(
        "the name '{}' of a {} has a control character or more than {} bytes",
        echo(name), kind, kMostNameBytes));
  }
  if (taken_.count({kind, name}) > 0) {
    throw InputError(
        fmt::format("{} '{}': another {} has this name; give each its own",
                    kind, name, kind));
  }
  return fmt::format("{} '{}'", kind, name);
}

void check_inertia(const std::string& what, double mass,
                   const Matrix3& inertia) {
  constexpr double kSymmetric = 1e-9;  // of the largest entry
  if (!(mass > 0.0) || !std::isfinite(mass)) {
    throw InputError(fmt::format(
        "{}: mass is {:g} kg; a body that moves needs mass > 0", what, mass));
  }
  check_finite(what, "its inertia", inertia.allFinite());
  if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() >
      kSymmetric * inertia.cwiseAbs().maxCoeff()) {
    throw InputError(
        fmt::format("{}: its inertia is not symmetric; the products of inertia "
                    "xy, xz, yz each appear twice",
                    what));
  }
  const std::string problem = find_inertia_problem(inertia);
  if (!problem.empty()) throw InputError(what + ": " + problem);
}

void check_reduced(const std::string& what,
                   const flexbody::ReducedBody& reduced, bool has_modes) {
  check_inertia(what, reduced.mass, reduced.inertia());
  if (!has_modes) return;
  for (Eigen::Index k = 0; k < reduced.lambda.size(); ++k) {
    if (reduced.lambda[k] >= 0.0 && std::isfinite(reduced.lambda[k])) continue;
    throw InputError(fmt::format(
        "{}: eigenvalue {} is {:g} rad^2/s^2; expected a finite number, not "
        "negative",
        what, k + 1, reduced.lambda[k]));
  }
  if (reduced.clamped) {
    const Eigen::Index columns = reduced.integrals.P.cols();
    check_size(what, "the effect of gravity on its modes",
               reduced.manifold
                   ? std::min<Eigen::Index>(columns, reduced.mode_count())
                   : columns,
               reduced.mode_count());
    check_finite(what, "the effect of gravity on its modes",
                 reduced.integrals.P.allFinite());
  }
}

void check_level(const std::string& what, const flexbody::ReducedBody& reduced,
                 Fidelity fidelity) {
  const std::string& gap = reduced.inertia_record.gap;
  if (gap.empty() || fidelity <= Fidelity::uncoupled) return;
  throw InputError(
      fmt::format("{}: level {} is not possible: {}; or choose level uncoupled",
                  what, to_string(fidelity), gap));
}

void check_integrals(const std::string& what,
                     const flexbody::ReducedBody& reduced) {
  const flexbody::InertiaShapeIntegrals& integrals = reduced.integrals;
  const auto modes = static_cast<Eigen::Index>(reduced.mode_count());
  check_size(what, "the shape integral S1", std::ssize(integrals.S1), modes);
  check_size(what, "the shape integral S2", std::ssize(integrals.S2),
             modes * modes);
  const auto is_finite = [](const std::vector<Matrix3>& blocks) {
    return std::all_of(blocks.begin(), blocks.end(),
                       [](const Matrix3& block) { return block.allFinite(); });
  };
  check_finite(what, "the shape integral S1", is_finite(integrals.S1));
  check_finite(what, "the shape integral S2", is_finite(integrals.S2));
}

void check_manifold(const std::string& what,
                    const flexbody::ReducedBody& reduced, bool has_elasticity) {
  if (has_elasticity) {
    throw InputError(what +
                     ": at level nonlinear its elasticity is that of its "
                     "reduced body; give none, or another level");
  }
  if (!reduced.manifold) {
    throw InputError(
        what +
        ": its reduced body has no second-order tables, which level nonlinear "
        "needs; reduce its mesh again for that level, or choose 'coupled'");
  }
  const flexbody::QuadraticManifold& manifold = *reduced.manifold;
  const auto pairs = flexbody::count_pairs(std::ssize(manifold.paired));
  check_size(what, "its second-order inertia", manifold.S2.cols(), pairs);
  check_size(what, "its second-order rows", manifold.Theta_B.cols(), pairs);
  if (reduced.clamped &&
      reduced.integrals.P.cols() != reduced.mode_count() + pairs) {
    throw InputError(
        what +
        ": its saved body lacks the second-order effect of gravity on a "
        "clamped group; reduce its mesh again for level nonlinear");
  }
  if (manifold.Theta_B.rows() != reduced.rows.Phi_B.rows()) {
    throw ContractError(fmt::format("{}: {} second-order rows; expected {}",
                                    what, manifold.Theta_B.rows(),
                                    reduced.rows.Phi_B.rows()));
  }
  check_finite(what, "its second-order inertia", manifold.S2.allFinite());
  check_finite(what, "a second-order row", manifold.Theta_B.allFinite());
}

void check_second_order(const std::string& what,
                        const flexbody::InterfaceTable& interface,
                        std::size_t paired) {
  const std::string table = fmt::format("interface '{}'", interface.name);
  const auto pairs = flexbody::count_pairs(static_cast<Eigen::Index>(paired));
  check_size(what, table + ", second-order translation",
             interface.Phi2_B.cols(), pairs);
  check_size(what, table + ", second-order rotation", interface.Psi2_B.cols(),
             pairs);
  check_finite(what, table,
               interface.Phi2_B.allFinite() && interface.Psi2_B.allFinite());
}

void check_elasticity(const std::string& what,
                      const flexbody::ModalElasticity& elasticity, int modes,
                      const ModalDamping& damping) {
  if (flexbody::count_modes(elasticity) != modes) {
    throw InputError(fmt::format("{}: its elasticity is of {} modes; it has {}",
                                 what, flexbody::count_modes(elasticity),
                                 modes));
  }
  const bool is_by_frequency =
      damping.rayleigh_stiffness != 0.0 ||
      std::any_of(damping.ratios.begin(), damping.ratios.end(),
                  [](double ratio) { return ratio != 0.0; });
  if (!is_by_frequency || flexbody::is_diagonal_at_rest(elasticity)) return;
  throw InputError(
      what +
      ": its modes are coupled and have no frequencies, which damping ratios "
      "and Rayleigh damping of stiffness need; give Rayleigh damping of mass");
}

VectorX check_damping(const std::string& what, const ModalDamping& damping,
                      const VectorX& lambda) {
  const auto& ratios = damping.ratios;
  const auto modes = static_cast<std::size_t>(lambda.size());
  if (ratios.size() > 1 && ratios.size() != modes) {
    throw InputError(fmt::format(
        "{}: {} damping ratios for {} modes; give one for all or one a mode",
        what, ratios.size(), modes));
  }
  check_rate(what, "Rayleigh damping of mass [1/s]", damping.rayleigh_mass);
  check_rate(what, "Rayleigh damping of stiffness [s]",
             damping.rayleigh_stiffness);
  for (const double ratio : ratios) check_rate(what, "a damping ratio", ratio);
  VectorX c(lambda.size());
  for (std::size_t k = 0; k < modes; ++k) {
    const double ratio =
        ratios.empty() ? 0.0 : ratios[ratios.size() == 1 ? 0 : k];
    const auto i = static_cast<Eigen::Index>(k);
    c[i] = 2.0 * ratio * std::sqrt(lambda[i]) + damping.rayleigh_mass +
           damping.rayleigh_stiffness * lambda[i];
  }
  check_finite(what, "the damping of its highest mode", c.allFinite());
  return c;
}

void check_same_nodes(const std::string& what,
                      const flexbody::ReducedBody& reduced,
                      const flexbody::FullBody& full) {
  constexpr double kSame = 1e-9;  // of the body's size
  const Matrix3X& x = reduced.rows.x_B;
  if (x.cols() != full.node_count()) {
    throw InputError(fmt::format(
        "{}: its reduced body keeps {} of {} nodes; level full needs the rows "
        "of all",
        what, x.cols(), full.node_count()));
  }
  if (!((x - full.x_B).cwiseAbs().maxCoeff() <= kSame * reduced.size.norm())) {
    throw InputError(fmt::format(
        "{}: the mesh's nodes are not those of its reduced body; reduce it "
        "again",
        what));
  }
  const MatrixX& Phi = reduced.rows.Phi_B;
  check_size(what, "its table of mode shapes", Phi.cols(),
             reduced.mode_count());
  if (Phi.rows() != 3 * x.cols()) {
    throw ContractError(fmt::format("{}: {} rows of mode shapes; expected {}",
                                    what, Phi.rows(), 3 * x.cols()));
  }
  check_finite(what, "its table of mode shapes", Phi.allFinite());
}

void check_index(const std::string& what, const std::string& kind, int index,
                 std::size_t count) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return;
  throw ContractError(fmt::format("{}: there is no {} {}; the system has {}",
                                  what, kind, index, count));
}

void check_pose(const std::string& what, const Pose& pose) {
  constexpr double kRotation = 1e-9;
  check_finite(what, "its pose", pose.p.allFinite() && pose.R.allFinite());
  const double error =
      (pose.R.transpose() * pose.R - Matrix3::Identity()).norm();
  if (error <= kRotation && pose.R.determinant() > 0.0) return;
  throw InputError(
      fmt::format("{}: its axes are not those of a rotation: R^T R differs "
                  "from the identity by {:.3g}, the determinant is {:.6g}",
                  what, error, pose.R.determinant()));
}

void check_interface(const std::string& what,
                     const flexbody::InterfaceTable& interface,
                     Eigen::Index modes) {
  const std::string table = fmt::format("interface '{}'", interface.name);
  check_size(what, table + ", translation", interface.Phi_B.cols(), modes);
  check_size(what, table + ", rotation", interface.Psi_B.cols(), modes);
  check_finite(what, table,
               interface.p_B.allFinite() && interface.Phi_B.allFinite() &&
                   interface.Psi_B.allFinite());
}

void check_nodes(const std::string& what, const flexbody::NodeSet& nodes,
                 Eigen::Index node_count) {
  constexpr double kSum = 1e-9;
  const auto count = std::ssize(nodes.nodes);
  if (count == 0 || nodes.weights.size() != count ||
      nodes.moments.cols() != count) {
    throw ContractError(fmt::format(
        "{}: node set '{}' has {} nodes and {} weights and {} "
        "moments",
        what, nodes.name, count, nodes.weights.size(), nodes.moments.cols()));
  }
  for (const int node : nodes.nodes) {
    check_index(fmt::format("{}, node set '{}'", what, nodes.name), "node",
                node, static_cast<std::size_t>(node_count));
  }
  if (!(std::abs(nodes.weights.sum() - 1.0) <= kSum)) {
    throw InputError(fmt::format(
        "{}: the weights of node set '{}' sum to {:.9g}; expected 1", what,
        nodes.name, nodes.weights.sum()));
  }
}

void check_joint_sum(const std::string& what, const JointSum& sum,
                     const SystemModel& model) {
  if (sum.terms.empty()) {
    throw ContractError(what + ": its sum has no joint");
  }
  check_finite(what, "its offset", std::isfinite(sum.offset));
  for (const JointSum::Term& term : sum.terms) {
    check_index(what, "coupler", term.coupler, model.couplers.size());
    const Coupler& coupler =
        model.couplers[static_cast<std::size_t>(term.coupler)];
    check_index(fmt::format("{}, coupler '{}'", what, coupler.name),
                "coordinate", term.coordinate,
                joints::coordinates_of(coupler.law).size());
    if (term.factor == 0.0 || !std::isfinite(term.factor)) {
      throw InputError(fmt::format(
          "{}: the factor of '{}' is {:g}; expected a finite number other than "
          "0",
          what, coupler.name, term.factor));
    }
  }
}

namespace {

void check_writes(const std::string& what, const ControllerModel& controller,
                  const SystemModel& model) {
  if (controller.writes.empty()) {
    throw InputError(what + ": it writes no input; expected one or more");
  }
  std::vector<int> written;
  for (const int input : controller.writes) {
    check_index(what, "input", input, model.inputs.size());
    const std::string& name = model.inputs[index(input)].name;
    if (std::count(written.begin(), written.end(), input) > 0) {
      throw InputError(
          fmt::format("{}: it writes input '{}' twice", what, name));
    }
    written.push_back(input);
    for (const ControllerModel& other : model.controllers) {
      if (std::count(other.writes.begin(), other.writes.end(), input) == 0) {
        continue;
      }
      throw InputError(
          fmt::format("{}: it writes input '{}', which controller '{}' also "
                      "writes; an input has only one writer",
                      what, name, other.name));
    }
  }
}

}  // namespace

void check_controller(const std::string& what,
                      const ControllerModel& controller,
                      const SystemModel& model) {
  LIMBER_EXPECT(controller.law != nullptr);
  if (!(controller.period > 0.0) || !std::isfinite(controller.period)) {
    throw InputError(fmt::format("{}: its period is {:g} s; expected > 0", what,
                                 controller.period));
  }
  if (!std::isfinite(controller.offset)) {
    throw InputError(
        fmt::format("{}: its offset is {} s; expected a finite number", what,
                    controller.offset));
  }
  check_writes(what, controller, model);
  for (const double value : controller.memory) {
    if (std::isfinite(value)) continue;
    throw InputError(what + ": a number of its memory is not finite");
  }
  std::set<std::string> names;
  for (const Measurement& measurement : controller.measures) {
    LIMBER_EXPECT(measurement.measure != nullptr);
    if (measurement.name.empty() || !names.insert(measurement.name).second) {
      throw InputError(
          fmt::format("{}: it measures '{}' twice, or something without a name",
                      what, measurement.name));
    }
  }
}

void check_pair_bodies(const std::string& what, BodyIndex body_A,
                       BodyIndex body_B) {
  if (body_A != body_B) return;
  throw InputError(
      fmt::format("{}: both of its bodies are {}; expected two different ones",
                  what, body_A == kWorld ? "the world" : "the same"));
}

void check_nodal_load(const std::string& what,
                      const flexbody::NodalLoad& history, Eigen::Index modes) {
  const auto count = static_cast<Eigen::Index>(history.times.size());
  check_size(what, "its force", history.force.cols(), count);
  check_size(what, "its moment", history.moment.cols(), count);
  if (modes > 0) {
    check_size(what, "its modal force", history.modal.cols(), count);
    check_size(what, "its moment by mode", history.moment_by_mode.cols(),
               modes * count);
    if (history.modal.rows() != modes) {
      throw ContractError(fmt::format("{}: {} rows of modal force; expected {}",
                                      what, history.modal.rows(), modes));
    }
  }
  check_finite(what, "a force",
               history.force.allFinite() && history.moment.allFinite() &&
                   history.modal.allFinite() &&
                   history.moment_by_mode.allFinite());
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    const bool is_later = i == 0 || history.times[i] > history.times[i - 1];
    if (is_later && std::isfinite(history.times[i])) continue;
    throw InputError(fmt::format(
        "{}: time {} is {:g} s; expected finite times that increase", what,
        i + 1, history.times[i]));
  }
}

}  // namespace limber::dynamics
