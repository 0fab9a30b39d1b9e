// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"
#include "laws.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "python_controller.hpp"

namespace limber::python {
namespace {

using namespace dynamics;

joints::JointKind parse_kind(const std::string& name) {
  using joints::JointKind;
  const std::vector<std::pair<std::string, JointKind>> kinds = {
      {"fixed", JointKind::fixed},
      {"revolute", JointKind::revolute},
      {"continuous", JointKind::continuous},
      {"prismatic", JointKind::prismatic},
      {"planar", JointKind::planar},
      {"floating", JointKind::floating},
      {"universal", JointKind::universal},
      {"ball", JointKind::ball}};
  std::vector<std::string> known;
  for (const auto& [key, kind] : kinds) {
    if (key == name) return kind;
    known.push_back(key);
  }
  throw InputError(describe_unknown("kind of joint", name, known));
}

InputHold parse_hold(const std::string& name) {
  if (name == "held") return InputHold::held;
  if (name == "linear") return InputHold::linear;
  throw InputError("hold of an input '" + name + "'; expected held or linear");
}

LoadFrame parse_frame(const std::string& name) {
  if (name == "body") return LoadFrame::body;
  if (name == "world") return LoadFrame::world;
  throw InputError("frame of a load '" + name + "'; expected body or world");
}

BodyIndex add_flexible(SystemBuilder& builder, const std::string& name,
                       std::shared_ptr<flexbody::ReducedBody> body,
                       const std::string& fidelity,
                       const std::vector<double>& ratios, double rayleigh_mass,
                       double rayleigh_stiffness, double loss_factor,
                       const std::pair<double, double>& band) {
  ModalDamping damping{rayleigh_mass, rayleigh_stiffness, ratios};
  if (loss_factor != 0.0) {
    damping.maxwell =
        flexbody::find_maxwell_elements(loss_factor, {band.first, band.second});
  }
  return builder.add_flexible_body(name, std::move(body),
                                   parse_fidelity(fidelity), damping);
}

AttachmentIndex attach_interface(SystemBuilder& builder,
                                 const std::string& name, BodyIndex body,
                                 const flexbody::InterfaceTable& interface,
                                 const std::optional<Pose>& X_BF) {
  return builder.attach_interface(
      name, body, interface,
      X_BF.value_or(Pose{Matrix3::Identity(), interface.p_B}));
}

JointSide make_side(BodyIndex body, const std::optional<Pose>& X_BF,
                    const std::optional<std::string>& interface) {
  JointSide side;
  side.body = body;
  side.X_BF = X_BF;
  if (interface) side.interface = *interface;
  return side;
}

CouplerIndex add_joint(SystemBuilder& builder, const std::string& name,
                       const std::string& kind, const JointSide& parent,
                       const JointSide& child, const Vector3& axis_F,
                       const Vector3& second_F,
                       const std::vector<std::pair<int, py::object>>& elements,
                       const std::optional<double>& kt,
                       const std::optional<double>& kr,
                       const std::optional<double>& ct,
                       const std::optional<double>& cr,
                       const std::optional<double>& free_damping) {
  JointOptions options;
  options.second_F = second_F;
  options.held = {kt, kr, ct, cr, free_damping};
  options.elements = to_elements(elements);
  return builder.add_joint(name, parse_kind(kind), parent, child, axis_F,
                           options);
}

TransmissionIndex add_joint_sum(
    SystemBuilder& builder, const std::string& name,
    const std::vector<std::tuple<CouplerIndex, int, double>>& terms,
    double offset, const std::vector<py::object>& laws) {
  JointSum sum;
  sum.offset = offset;
  for (const auto& [coupler, coordinate, factor] : terms) {
    sum.terms.push_back({coupler, coordinate, factor});
  }
  return builder.add_joint_sum(name, sum, to_scalar_laws(laws));
}

std::vector<Measurement> to_measurements(const py::dict& measures) {
  std::vector<Measurement> made;
  for (const auto& [name, measure] : measures) {
    made.push_back(make_python_measurement(name.cast<std::string>(),
                                           measure.cast<py::function>()));
  }
  return made;
}

ControllerIndex add_controller(
    SystemBuilder& builder, const std::string& name, double period,
    const std::vector<InputIndex>& writes, const py::function& law,
    const py::dict& measures, const std::optional<std::vector<double>>& memory,
    double offset, const std::optional<std::string>& identity) {
  ControllerModel controller;
  controller.name = name;
  controller.period = period;
  controller.offset = offset;
  for (const InputIndex input : writes) controller.writes.push_back(int(input));
  controller.measures = to_measurements(measures);
  controller.memory = memory.value_or(std::vector<double>());
  controller.law = make_python_law(law, memory, identity.value_or(name));
  return builder.add_controller(controller);
}

}  // namespace

void bind_builder(py::module_& m) {
  py::class_<JointSide>(
      m, "JointSide",
      "One side of a joint: a frame on a body, or in the world. Without a pose "
      "X_BF it is the middle of the interface, else the body's frame.")
      .def(py::init(&make_side), py::arg("body") = kWorld,
           py::arg("X_BF") = py::none(), py::arg("interface") = py::none());

  const Vector3 zero = Vector3::Zero();
  const Vector3 x = Vector3::UnitX();
  const Vector3 z = Vector3::UnitZ();
  py::class_<SystemBuilder>(
      m, "SystemBuilder",
      "Builds a system of bodies, joints, loads and controllers. Invalid input "
      "raises InputError and is not added.")
      .def(py::init<>())
      .def(
          "add_rigid_body",
          [](SystemBuilder& builder, const std::string& name, double mass,
             const Matrix3& inertia) {
            return builder.add_rigid_body(name, {mass, inertia});
          },
          py::arg("name"), py::arg("mass"), py::arg("inertia"),
          "A body with its frame at the centre of mass: mass [kg], inertia "
          "(3, 3) [kg m^2].")
      .def("add_flexible_body", &add_flexible, py::arg("name"), py::arg("body"),
           py::arg("fidelity") = "coupled",
           py::arg("damping_ratios") = std::vector<double>(),
           py::arg("rayleigh_mass") = 0.0, py::arg("rayleigh_stiffness") = 0.0,
           py::arg("loss_factor") = 0.0,
           py::arg("band") = std::pair<double, double>(),
           "A reduced body at a level; damping ratios of its modes [-] (one "
           "for all, or one each), Rayleigh's alpha [1/s] and beta [s], or a "
           "loss factor of its material [-] in a band of frequencies (low, "
           "high) [rad/s], at the low end of which it has its stiffness.")
      .def("attach_frame", &SystemBuilder::attach_frame, py::arg("name"),
           py::arg("body"), py::arg("X_BF"),
           "A frame fixed to a body's frame, whatever its deformation.")
      .def("attach_interface", &attach_interface, py::arg("name"),
           py::arg("body"), py::arg("interface"), py::arg("X_BF") = py::none(),
           "A frame on an interface of a flexible body "
           "(ReducedBody.interface), by default at its middle.")
      .def("attach_world", &SystemBuilder::attach_world, py::arg("name"),
           py::arg("X_WF"), "A frame fixed in the world.")
      .def(
          "add_coupler",
          [](SystemBuilder& builder, const std::string& name,
             const py::object& law, AttachmentIndex F, AttachmentIndex M) {
            return builder.add_coupler(name, to_coupler_law(law), F, M);
          },
          py::arg("name"), py::arg("law"), py::arg("frame_F"),
          py::arg("frame_M"),
          "A Bushing, PointSpring or Latch between two attachments.")
      .def("add_joint", &add_joint, py::arg("name"), py::arg("kind"),
           py::arg("parent"), py::arg("child"), py::arg("axis_F") = z,
           py::arg("second_F") = x,
           py::arg("elements") = std::vector<std::pair<int, py::object>>(),
           py::arg("translational_stiffness") = py::none(),
           py::arg("rotational_stiffness") = py::none(),
           py::arg("translational_damping") = py::none(),
           py::arg("rotational_damping") = py::none(),
           py::arg("free_damping") = py::none(),
           "A joint: fixed, revolute, continuous, prismatic, planar, floating, "
           "universal or ball, about or along an axis in frame F, with laws "
           "[(coordinate, law), ...] along its coordinates. Stiffness [N/m, N "
           "m/rad] and damping [N s/m, N m s/rad] follow from the bodies.")
      .def(
          "add_path",
          [](SystemBuilder& builder, const std::string& name,
             const std::vector<AttachmentIndex>& points,
             const std::vector<py::object>& laws) {
            return builder.add_path(name, points, to_scalar_laws(laws));
          },
          py::arg("name"), py::arg("points"), py::arg("laws"),
          "Laws along the length of a path through attachments, as a tendon.")
      .def("add_joint_sum", &add_joint_sum, py::arg("name"), py::arg("terms"),
           py::arg("offset"), py::arg("laws"),
           "Laws along z = sum of factor * coordinate - offset; terms "
           "[(coupler, coordinate, factor), ...].")
      .def(
          "add_load",
          [](SystemBuilder& builder, const std::string& name,
             AttachmentIndex where, const Vector3& force, const Vector3& moment,
             const std::string& frame, const TimeFunction& function) {
            return builder.add_load(name, where, force, moment,
                                    parse_frame(frame), function);
          },
          py::arg("name"), py::arg("where"), py::arg("force") = zero,
          py::arg("moment") = zero, py::arg("frame") = "body",
          py::arg("function") = TimeFunction(Constant{}),
          "Force (3,) [N] and moment (3,) [N m] at an attachment, in the axes "
          "of the body or the world, times a function of time.")
      .def(
          "add_input",
          [](SystemBuilder& builder, const std::string& name, double initial,
             const std::string& hold) {
            return builder.add_input(name, initial, parse_hold(hold));
          },
          py::arg("name"), py::arg("initial") = 0.0, py::arg("hold") = "held",
          "A number that a controller writes and loads and drives follow: "
          "'held' between samples, or 'linear'.")
      .def("add_controller", &add_controller, py::arg("name"),
           py::arg("period"), py::arg("writes"), py::arg("law"),
           py::arg("measures") = py::dict(), py::arg("memory") = py::none(),
           py::arg("offset") = 0.0, py::arg("identity") = py::none(),
           "A function that is called every `period` [s] and returns one "
           "number for each input of `writes`: law(t, measured, memory), or "
           "law(t, measured) without memory; such a law may keep data of its "
           "own, but only in runs that are not repeated. `measures` are "
           "functions of the state, {name: measure(state)}.")
      .def("set_gravity", &SystemBuilder::set_gravity, py::arg("gravity_W"),
           "Uniform, world frame, (3,) [m/s^2].")
      .def(
          "build",
          [](const SystemBuilder& builder) {
            return std::make_shared<SystemModel>(builder.build());
          },
          "The model; later changes of the builder do not affect it.");
}

}  // namespace limber::python
