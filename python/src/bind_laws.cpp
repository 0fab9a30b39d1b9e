// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>

#include "bindings.hpp"
#include "laws.hpp"
#include "limber/common/errors.hpp"
#include "limber/joints/coupler_law.hpp"
#include "limber/joints/scalar/scalar_law.hpp"

namespace limber::python {
namespace {

using namespace joints;

/// A number (the same in all directions), three of a diagonal, or 3 x 3.
Matrix3 to_matrix(const char* name, const py::object& given) {
  const auto values =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(
          given);
  if (values && values.ndim() == 0) {
    return *values.data() * Matrix3::Identity();
  }
  if (values && values.ndim() == 1 && values.size() == 3) {
    return Vector3(values.data()).asDiagonal();
  }
  if (values && values.ndim() == 2 && values.shape(0) == 3 &&
      values.shape(1) == 3) {
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    return Eigen::Map<const RowMajor>(values.data());
  }
  PyErr_Clear();
  throw InputError(std::string(name) +
                   ": expected a number, three numbers or a 3 x 3 matrix");
}

Bushing::Parameters make_bushing(const py::object& translational_stiffness,
                                 const py::object& rotational_stiffness,
                                 const py::object& translational_damping,
                                 const py::object& rotational_damping) {
  Bushing::Parameters p;
  p.translational_stiffness =
      to_matrix("translational_stiffness", translational_stiffness);
  p.rotational_stiffness =
      to_matrix("rotational_stiffness", rotational_stiffness);
  p.translational_damping =
      to_matrix("translational_damping", translational_damping);
  p.rotational_damping = to_matrix("rotational_damping", rotational_damping);
  return p;
}

DriveMode parse_mode(const std::string& name) {
  if (name == "position") return DriveMode::position;
  if (name == "velocity") return DriveMode::velocity;
  if (name == "effort") return DriveMode::effort;
  throw InputError("mode of a drive '" + name +
                   "'; expected position, velocity or effort");
}

/// A number, a signal without shaper, or one with.
using AnySignal = std::variant<Signal, ConstantSignal, RampSignal, TableSignal,
                               SineSignal, InputSignal, double>;

Signal to_signal(const AnySignal& given) {
  return std::visit(
      [](const auto& one) -> Signal {
        using Given = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<Given, Signal>) {
          return one;
        } else if constexpr (std::is_same_v<Given, double>) {
          return {ConstantSignal{one}, {{}}};
        } else {
          return {one, {{}}};
        }
      },
      given);
}

void bind_couplers(py::module_& m) {
  py::class_<Bushing>(
      m, "Bushing",
      "Spring and damper in all six directions of frame M in frame F. Each is "
      "a number, three of a diagonal, or a (3, 3) matrix, in F: stiffness "
      "[N/m, N m/rad], damping [N s/m, N m s/rad].")
      .def(py::init([](const py::object& kt, const py::object& kr,
                       const py::object& ct, const py::object& cr) {
             return Bushing(make_bushing(kt, kr, ct, cr));
           }),
           py::arg("translational_stiffness") = 0.0,
           py::arg("rotational_stiffness") = 0.0,
           py::arg("translational_damping") = 0.0,
           py::arg("rotational_damping") = 0.0);
  py::class_<PointSpring>(
      m, "PointSpring",
      "Spring and damper along the line of two frames' origins: f = k s + k2 s "
      "|s| + the table's, s the length less the free one [m].")
      .def(py::init([](double stiffness, double damping, double free_length,
                       double quadratic, std::vector<double> extensions,
                       std::vector<double> forces, bool tension_only) {
             return PointSpring({stiffness, damping, free_length, quadratic,
                                 std::move(extensions), std::move(forces),
                                 tension_only});
           }),
           py::arg("stiffness") = 0.0, py::arg("damping") = 0.0,
           py::arg("free_length") = 0.0, py::arg("quadratic") = 0.0,
           py::arg("extensions") = std::vector<double>(),
           py::arg("forces") = std::vector<double>(),
           py::arg("tension_only") = false);
  py::class_<Latch>(
      m, "Latch",
      "A bushing that acts once two frames have come within `reach` [m], until "
      "`release_time` [s] or a force of `release_force` [N].")
      .def(py::init([](double reach, const py::object& kt, const py::object& kr,
                       const py::object& ct, const py::object& cr,
                       double release_force, double release_time) {
             return Latch({reach, make_bushing(kt, kr, ct, cr), release_force,
                           release_time});
           }),
           py::arg("reach"), py::arg("translational_stiffness") = 0.0,
           py::arg("rotational_stiffness") = 0.0,
           py::arg("translational_damping") = 0.0,
           py::arg("rotational_damping") = 0.0,
           py::arg("release_force") = Latch::kNever,
           py::arg("release_time") = Latch::kNever);
}

void bind_scalars(py::module_& m) {
  py::class_<ScalarSpring>(
      m, "ScalarSpring",
      "Spring and damper along a coordinate z [m or rad]: stiffness [N/m or N "
      "m/rad], damping [N s/m or N m s/rad], at rest at z = rest.")
      .def(py::init([](double stiffness, double damping, double rest,
                       double quadratic, std::vector<double> extensions,
                       std::vector<double> forces, bool tension_only) {
             return ScalarSpring(
                 {SpringCurve({stiffness, quadratic, std::move(extensions),
                               std::move(forces)}),
                  damping, rest, tension_only});
           }),
           py::arg("stiffness") = 0.0, py::arg("damping") = 0.0,
           py::arg("rest") = 0.0, py::arg("quadratic") = 0.0,
           py::arg("extensions") = std::vector<double>(),
           py::arg("forces") = std::vector<double>(),
           py::arg("tension_only") = false);
  py::class_<Friction>(m, "Friction",
                       "Coulomb friction [N or N m], regularised below `speed` "
                       "[m/s or rad/s], and viscous [N s/m or N m s/rad].")
      .def(py::init([](double coulomb, double viscous, double speed) {
             return Friction({coulomb, viscous, speed});
           }),
           py::arg("coulomb") = 0.0, py::arg("viscous") = 0.0,
           py::arg("speed") = 1e-3);
  py::class_<EndStop>(m, "EndStop",
                      "Stops at one or both ends of a coordinate [m or rad]: "
                      "stiffness [N/m or N m/rad], damping [s/m or s/rad].")
      .def(py::init([](double stiffness, double lower, double upper,
                       double damping) {
             return EndStop({lower, upper, stiffness, damping});
           }),
           py::arg("stiffness"), py::arg("lower") = -EndStop::kUnbounded,
           py::arg("upper") = EndStop::kUnbounded, py::arg("damping") = 0.0);
  py::class_<Drive>(
      m, "Drive",
      "A motor along a coordinate that follows a signal (or a number): "
      "position [m or rad] by a spring and a damper, velocity by a damper, or "
      "effort [N or N m]; within max_effort and max_speed.")
      .def(py::init([](const std::string& mode, const AnySignal& signal,
                       double stiffness, double damping, double max_effort,
                       double max_speed, bool pulls_only) {
             return Drive({parse_mode(mode), to_signal(signal), stiffness,
                           damping, max_effort, max_speed, pulls_only});
           }),
           py::arg("mode"), py::arg("signal"), py::arg("stiffness") = 0.0,
           py::arg("damping") = 0.0, py::arg("max_effort") = Drive::kUnlimited,
           py::arg("max_speed") = Drive::kUnlimited,
           py::arg("pulls_only") = false);
}

ScalarLaw to_scalar_law(const py::object& given) {
  if (py::isinstance<ScalarSpring>(given)) return given.cast<ScalarSpring>();
  if (py::isinstance<Friction>(given)) return given.cast<Friction>();
  if (py::isinstance<EndStop>(given)) return given.cast<EndStop>();
  if (py::isinstance<Drive>(given)) return given.cast<Drive>();
  throw InputError("'" + name_type(given) +
                   "' is not a law along a coordinate; expected a "
                   "ScalarSpring, Friction, EndStop or Drive");
}

}  // namespace

CouplerLaw to_coupler_law(const py::object& given) {
  if (py::isinstance<Bushing>(given)) return given.cast<Bushing>();
  if (py::isinstance<PointSpring>(given)) return given.cast<PointSpring>();
  if (py::isinstance<Latch>(given)) return given.cast<Latch>();
  throw InputError("'" + name_type(given) +
                   "' is not a law of a coupler; expected a Bushing, "
                   "PointSpring or Latch (joints are made by add_joint)");
}

std::vector<ScalarLaw> to_scalar_laws(const std::vector<py::object>& given) {
  std::vector<ScalarLaw> laws;
  for (const py::object& one : given) laws.push_back(to_scalar_law(one));
  return laws;
}

std::vector<JointElement> to_elements(
    const std::vector<std::pair<int, py::object>>& given) {
  std::vector<JointElement> elements;
  for (const auto& [coordinate, law] : given) {
    elements.push_back({coordinate, to_scalar_law(law)});
  }
  return elements;
}

void bind_laws(py::module_& m) {
  bind_couplers(m);
  bind_scalars(m);
}

}  // namespace limber::python
