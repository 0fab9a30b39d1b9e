// SPDX-License-Identifier: BSD-3-Clause
// Models, states, probes, and what is found of them.
#include "arrays.hpp"
#include "interruption.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/joint_state.hpp"
#include "limber/scene/probes/probe.hpp"

namespace limber::python {
namespace {

using namespace dynamics;
using ModelPointer = std::shared_ptr<SystemModel>;

/// Kinds of index do not mix up; int(index) is the number.
template <typename Index>
void bind_index(py::module_& m, const char* name) {
  py::class_<Index>(m, name)
      .def(py::init([](int value) { return Index(value); }), py::arg("value"))
      .def("__index__", [](Index self) { return static_cast<int>(self); })
      .def("__int__", [](Index self) { return static_cast<int>(self); })
      .def("__eq__",
           [](Index a, const py::object& b) {
             return py::isinstance<Index>(b) &&
                    static_cast<int>(a) == static_cast<int>(b.cast<Index>());
           })
      .def("__hash__", [](Index self) { return static_cast<int>(self); })
      .def("__repr__", [name = std::string(name)](Index self) {
        return name + "(" + std::to_string(static_cast<int>(self)) + ")";
      });
}

void bind_indices(py::module_& m) {
  bind_index<BodyIndex>(m, "BodyIndex");
  bind_index<AttachmentIndex>(m, "AttachmentIndex");
  bind_index<CouplerIndex>(m, "CouplerIndex");
  bind_index<TransmissionIndex>(m, "TransmissionIndex");
  bind_index<LoadIndex>(m, "LoadIndex");
  bind_index<InputIndex>(m, "InputIndex");
  bind_index<ControllerIndex>(m, "ControllerIndex");
  m.attr("WORLD") = py::cast(kWorld);
}

void bind_pose(py::module_& m) {
  py::class_<Pose>(m, "Pose",
                   "Pose X_AB of frame B in frame A: a point b is at p + R b.")
      .def(py::init([](const Vector3& p, const Matrix3& R) {
             return Pose{R, p};
           }),
           py::arg("p") = Vector3(Vector3::Zero()),
           py::arg("R") = Matrix3(Matrix3::Identity()))
      .def_readwrite("p", &Pose::p, "Position, (3,) [m], in A.")
      .def_readwrite("R", &Pose::R, "Rotation, (3, 3) [-].")
      .def("inverse", &Pose::inverse)
      .def("__matmul__",
           [](const Pose& a, const Pose& b) { return Pose(a * b); });
}

void bind_state(py::module_& m) {
  py::class_<BodyState>(m, "BodyState", "Rigid motion of a body's frame B.")
      .def_readwrite("p_WB", &BodyState::p_WB, "Centre of mass, (3,) [m].")
      .def_readwrite("v_WB_W", &BodyState::v_WB_W, "Velocity, (3,) [m/s].")
      .def_readwrite("w_WB_B", &BodyState::w_WB_B,
                     "Angular velocity in B, (3,) [rad/s].")
      .def_property(
          "quat_WB",
          [](const BodyState& body) {
            const Quaternion& q = body.quat_WB;
            return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
          },
          [](BodyState& body, const Eigen::Vector4d& q) {
            if (!(std::abs(q.norm() - 1.0) < 1e-6)) {
              throw InputError("quat_WB: expected a unit quaternion w x y z");
            }
            body.quat_WB = Quaternion(q[0], q[1], q[2], q[3]).normalized();
          },
          "Body to world, unit, (4,) w x y z [-].");
  py::class_<SystemState>(m, "SystemState", "State of a system, a plain value.")
      .def_readwrite("t", &SystemState::t, "Time [s].")
      .def(
          "body",
          [](SystemState& state, BodyIndex body) -> BodyState& {
            return state.bodies.at(static_cast<std::size_t>(int(body)));
          },
          py::arg("body"), py::return_value_policy::reference_internal,
          "The rigid motion of a body; changes of it change this state.")
      .def_readwrite("eta", &SystemState::eta,
                     "Modal coordinates of all bodies, (m,) [kg^1/2 m].")
      .def_readwrite("etadot", &SystemState::etadot,
                     "Their rates, (m,) [kg^1/2 m/s].")
      .def("copy", [](const SystemState& state) { return SystemState(state); });
  py::class_<FrameMotion>(m, "FrameMotion", "Pose and velocity of a frame.")
      .def_readonly("X_WF", &FrameMotion::X_WF)
      .def_readonly("v_WF_W", &FrameMotion::v_WF_W, "(3,) [m/s]")
      .def_readonly("w_WF_W", &FrameMotion::w_WF_W, "(3,) [rad/s]");
  py::class_<EnergyBalance>(m, "EnergyBalance",
                            "Energies [J] and momenta of a system.")
      .def_readonly("kinetic_rigid", &EnergyBalance::kinetic_rigid)
      .def_readonly("kinetic_modal", &EnergyBalance::kinetic_modal)
      .def_readonly("elastic", &EnergyBalance::elastic)
      .def_readonly("coupler", &EnergyBalance::coupler)
      .def_readonly("dissipated", &EnergyBalance::dissipated)
      .def_readonly("work", &EnergyBalance::work)
      .def_readonly("linear_momentum", &EnergyBalance::linear_momentum,
                    "World, (3,) [kg m/s].")
      .def_readonly("angular_momentum", &EnergyBalance::angular_momentum,
                    "About the world's origin, (3,) [kg m^2/s].")
      .def_property_readonly("total", &EnergyBalance::total,
                             "Kinetic, elastic and of couplers [J].");
}

void bind_model(py::module_& m) {
  py::class_<SystemModel, ModelPointer>(
      m, "SystemModel", "Bodies, couplers and loads; immutable.")
      .def_property_readonly("bodies",
                             [](const SystemModel& model) {
                               std::vector<std::string> names;
                               for (const auto& body : model.bodies) {
                                 names.push_back(body.name);
                               }
                               return names;
                             })
      .def_readonly("modal_count", &SystemModel::modal_count,
                    "Number of modes of all bodies.")
      .def("find_body", &SystemModel::find_body, py::arg("name"))
      .def("find_attachment", &SystemModel::find_attachment, py::arg("name"))
      .def("find_coupler", &SystemModel::find_coupler, py::arg("name"))
      .def("find_load", &SystemModel::find_load, py::arg("name"));
}

/// {joint: positions} or {joint: (positions, velocities)}
using Coordinates = std::vector<double>;
using Given = std::map<
    std::string,
    std::variant<double, std::pair<Coordinates, Coordinates>, Coordinates>>;

SystemState make_start(const SystemModel& model, const Given& given) {
  JointStates joints;
  for (const auto& [name, one] : given) {
    if (const auto* angle = std::get_if<double>(&one)) {
      joints[name] = {{*angle}, {}};
    } else if (const auto* position = std::get_if<Coordinates>(&one)) {
      joints[name] = {*position, {}};
    } else {
      const auto& [position_too, rate] =
          std::get<std::pair<Coordinates, Coordinates>>(one);
      joints[name] = {position_too, rate};
    }
  }
  return joints.empty() ? make_state(model) : make_state(model, joints);
}

SystemState find_rest(const SystemModel& model, const SystemState& start,
                      const std::string& method) {
  clear_cause();
  const Progress watch = make_watch(py::none());
  const py::gil_scoped_release release;
  return find_equilibrium(model, start,
                          {.method = parse_equilibrium_method(method)}, watch)
      .state;
}

void bind_findings(py::module_& m) {
  m.def("make_state", &make_start, py::arg("model"),
        py::arg("joints") = Given(),
        "A state in which joints have these coordinates [m, rad], by name: "
        "{'elbow': 1.57}, {'ball': [0.1, 0, 0]}, or with rates {'elbow': "
        "([1.57], [0.5])}; others are at zero.");
  m.def("find_frame_motion", &find_frame_motion, py::arg("model"),
        py::arg("state"), py::arg("attachment"),
        "Pose and velocity of an attachment's frame.");
  m.def(
      "calc_energy",
      [](const SystemModel& model, const SystemState& state) {
        return calc_energy(model, state);
      },
      py::arg("model"), py::arg("state"),
      "Energies and momenta, except work and dissipation, which depend on the "
      "history.");
  m.def("find_natural_frequencies", &find_natural_frequencies, py::arg("model"),
        py::arg("state"), py::call_guard<py::gil_scoped_release>(),
        "At rest and without dampers, increasing; 0 for free motion, negative "
        "for unstable motion, (n,) [Hz].");
  m.def("find_equilibrium", &find_rest, py::arg("model"), py::arg("start"),
        py::arg("method") = "newton",
        "The state of static equilibrium near `start`: 'newton' or "
        "'relaxation'.");
}

scene::Quantity parse_quantity(const std::string& name) {
  using scene::Quantity;
  const std::vector<std::pair<std::string, Quantity>> known = {
      {"displacement", Quantity::displacement},
      {"position", Quantity::position},
      {"velocity", Quantity::velocity},
      {"rotation", Quantity::rotation},
      {"angular_velocity", Quantity::angular_velocity}};
  std::vector<std::string> names;
  for (const auto& [key, value] : known) {
    if (key == name) return value;
    names.push_back(key);
  }
  throw InputError(describe_unknown("quantity of a probe", name, names));
}

scene::Probe make_point_probe(const std::string& name, const SystemModel& model,
                              AttachmentIndex where,
                              const std::string& quantity) {
  const auto i = static_cast<std::size_t>(int(where));
  if (i >= model.attachments.size()) {
    throw ContractError("an attachment of another model");
  }
  const Attachment& at = model.attachments[i];
  scene::PointProbe probe;
  probe.quantity = parse_quantity(quantity);
  probe.body = at.body;
  probe.p_B = at.p_BF;
  probe.Phi_B = at.Phi_B;
  probe.Psi_B = at.Psi_B;
  probe.nodal = at.nodal;
  probe.R_BL = at.R_BF;
  probe.second = at.second;
  return {name, probe};
}

scene::Probe make_joint_probe(const std::string& name, const SystemModel& model,
                              CouplerIndex coupler) {
  const auto i = static_cast<std::size_t>(int(coupler));
  if (i >= model.couplers.size()) {
    throw ContractError("a coupler of another model");
  }
  scene::CouplerProbeSpec spec;
  spec.coupler = model.couplers[i].name;
  return {name, scene::make_coupler_probe(spec, model)};
}

void bind_probes(py::module_& m) {
  py::class_<scene::Probe>(m, "Probe", "What a run records at every output.")
      .def_static("point", &make_point_probe, py::arg("name"), py::arg("model"),
                  py::arg("attachment"), py::arg("quantity") = "displacement",
                  "Three columns of an attachment's frame, in the world: "
                  "displacement or position [m], velocity [m/s], rotation "
                  "[rad], angular_velocity [rad/s].")
      .def_static("coordinates", &make_joint_probe, py::arg("name"),
                  py::arg("model"), py::arg("coupler"),
                  "Coordinates of a joint and their rates [m, rad, m/s, "
                  "rad/s].")
      .def_property_readonly(
          "name", [](const scene::Probe& probe) { return probe.name; })
      .def_property_readonly(
          "columns",
          [](const scene::Probe& probe) {
            std::vector<std::pair<std::string, std::string>> columns;
            for (const auto& column : column_names(probe)) {
              columns.emplace_back(column.name, column.unit);
            }
            return columns;
          },
          "(name, unit) of each.");
}

}  // namespace

void bind_system(py::module_& m) {
  bind_indices(m);
  bind_pose(m);
  bind_model(m);
  bind_state(m);
  bind_probes(m);
  bind_findings(m);
}

}  // namespace limber::python
