// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "arrays.hpp"
#include "interruption.hpp"
#include "limber/app/options/mesh_options.hpp"
#include "limber/app/options/mode_options.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/reports/describe.hpp"
#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/length_unit.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/runs/library_lock.hpp"

namespace limber::python {
namespace {

namespace fs = std::filesystem;
using flexbody::InterfaceTable;
using flexbody::ReducedBody;
using BodyPointer = std::shared_ptr<ReducedBody>;

ReducedBody& body_of(const py::object& self) {
  return self.cast<ReducedBody&>();
}

/// @param unit a number [m], one of its names, or None for the file's
/// @throws InputError if it is no unit.
double read_unit(const py::object& unit) {
  if (unit.is_none()) return 0.0;
  const std::string text = py::str(unit);
  const std::optional<double> metres = parse_length_unit(text);
  if (!metres) {
    throw InputError(
        fmt::format("unit is '{}'; expected {}, or None for the "
                    "file's",
                    echo(text), kLengthUnits));
  }
  return *metres;
}

/// @throws InputError if it is no unit.
double read_force_unit(const py::object& unit) {
  if (unit.is_none()) return 0.0;
  const std::string text = py::str(unit);
  const std::optional<double> newtons = parse_force_unit(text);
  if (!newtons)
    throw InputError(fmt::format("force_unit is '{}'; expected {}, or None",
                                 echo(text), kForceUnits));
  return *newtons;
}

std::optional<Vector3> read_direction(const py::dict& wish, const char* name) {
  const auto v = wish[name].cast<std::vector<double>>();
  if (v.empty()) return std::nullopt;
  if (v.size() == 3) return Vector3(v[0], v[1], v[2]);
  throw InputError(
      fmt::format("{} has {} numbers; expected three", name, v.size()));
}

StatedMaterial read_material(const py::dict& wish) {
  const auto numbers = [&](const char* name) {
    return wish[name].cast<std::vector<double>>();
  };
  StatedMaterial material;
  material.youngs_modulus = numbers("youngs_modulus");
  material.poisson_ratio = numbers("poisson_ratio");
  material.shear_modulus = numbers("shear_modulus");
  material.stiffness = numbers("stiffness");
  material.density = wish["density"].cast<double>();
  material.axis_1 = read_direction(wish, "axis_1");
  material.axis_2 = read_direction(wish, "axis_2");
  material.cylinder_axis = read_direction(wish, "cylinder_axis");
  material.cylinder_point = read_direction(wish, "cylinder_point");
  return material;
}

flexbody::Recipe make_recipe(const py::dict& wish) {
  app::MeshOptions options;
  options.file = wish["mesh"].cast<std::string>();
  options.matrices = wish["matrices"].cast<std::vector<std::string>>();
  options.recovery = wish["recovery"].cast<std::vector<std::string>>();
  options.mass = wish["mass"].cast<double>();
  options.material = read_material(wish);
  options.size = wish["size"].cast<double>();
  options.order = wish["order"].cast<int>();
  options.unit = read_unit(wish["unit"]);
  options.force = read_force_unit(wish["force_unit"]);
  options.ignored = wish["ignore"].cast<std::vector<std::string>>();
  options.materials = wish["materials"].cast<std::vector<std::string>>();
  options.shells = wish["shells"].cast<std::vector<std::string>>();
  options.beams = wish["beams"].cast<std::vector<std::string>>();
  flexbody::Recipe recipe = app::make_recipe(options);
  app::ModeOptions modes;
  modes.count = py::str(wish["modes"]);
  app::apply(modes, recipe.basis);
  recipe.clamped_groups = wish["clamps"].cast<std::vector<std::string>>();
  recipe.rows =
      flexbody::parse_rows(wish["rows"].cast<std::vector<std::string>>());
  recipe.manifold = wish["second_order"].cast<bool>();
  recipe.stress = wish["stress"].cast<bool>();
  for (const auto& group :
       wish["interfaces"].cast<std::vector<std::string>>()) {
    flexbody::InterfaceRequest request;
    request.name = group;
    request.nodes = flexbody::GroupNodes{group};
    recipe.interfaces.push_back(request);
  }
  return recipe;
}

/// @param wish of the arguments of limber.reduce
py::tuple reduce(const py::dict& wish) {
  clear_cause();
  const flexbody::Recipe recipe = make_recipe(wish);
  const Progress watch = make_watch(py::none());
  BodyPointer body;
  std::vector<std::string> notices;
  {
    const py::gil_scoped_release release;
    const auto lock = runs::lock_libraries();
    const flexbody::MeshAtHand mesh =
        app::make_reducer(watch).make_mesh(recipe.mesh);
    body = std::make_shared<ReducedBody>(mesh.reduce(recipe));
    notices = mesh.record.notices;
    if (const auto text = describe_locking(body->locking))
      notices.push_back(*text);
  }
  return py::make_tuple(body, notices);
}

BodyPointer read_body(const fs::path& file) {
  const py::gil_scoped_release release;
  const auto lock = runs::lock_libraries();
  return std::make_shared<ReducedBody>(flexbody::read_body(file));
}

void save(const ReducedBody& body, const fs::path& file) {
  const py::gil_scoped_release release;
  const auto lock = runs::lock_libraries();
  flexbody::write_body(body, file);
}

VectorX calc_frequencies(const ReducedBody& body) {
  return body.lambda.cwiseMax(0.0).cwiseSqrt() / (2.0 * M_PI);
}

std::vector<std::string> list_interfaces(const ReducedBody& body) {
  std::vector<std::string> names;
  for (const InterfaceTable& one : body.interfaces) names.push_back(one.name);
  return names;
}

}  // namespace

void bind_body(py::module_& m) {
  py::class_<InterfaceTable>(m, "InterfaceTable",
                             "Mean motion of a named node set of a body.")
      .def_readonly("name", &InterfaceTable::name)
      .def_readonly("p_B", &InterfaceTable::p_B,
                    "Undeformed mean point from the centre of mass, (3,) [m].");

  py::class_<ReducedBody, BodyPointer>(
      m, "ReducedBody",
      "A flexible body after reduction. Its frame B has its origin at the "
      "centre of mass and the mesh's axes.")
      .def_readonly("name", &ReducedBody::name)
      .def_readonly("clamped", &ReducedBody::clamped)
      .def_readonly("mass", &ReducedBody::mass, "Mass [kg].")
      .def_property_readonly("inertia", &ReducedBody::inertia,
                             "About the centre of mass, (3, 3) [kg m^2].")
      .def_readonly("p_MoBcm_M", &ReducedBody::p_MoBcm_M,
                    "Centre of mass in the mesh's frame, (3,) [m].")
      .def_property_readonly("mode_count", &ReducedBody::mode_count,
                             "Number of modes m.")
      .def_property_readonly("frequencies", &calc_frequencies,
                             "Natural frequencies of the modes, (m,) [Hz].")
      .def_property_readonly(
          "eigenvalues",
          [](const py::object& self) {
            const VectorX& lambda = body_of(self).lambda;
            return view_of(lambda.data(), {lambda.size()}, {1}, self);
          },
          "Of the modes, (m,) [rad^2/s^2]; shares the body's memory.")
      .def_property_readonly(
          "nodes",
          [](const py::object& self) {
            const Matrix3X& x = body_of(self).rows.x_B;
            return view_of(x.data(), {x.cols(), 3}, {3, 1}, self);
          },
          "Undeformed positions of the stored nodes relative to the centre of "
          "mass, (n, 3) [m]; shares the body's memory.")
      .def_property_readonly(
          "mode_shapes",
          [](const py::object& self) {
            return view_of_matrix(body_of(self).rows.Phi_B, self);
          },
          "Of the stored nodes, row 3 i + c for component c of node i, "
          "(3n, m) [kg^-1/2]; shares the body's memory.")
      .def_property_readonly("interfaces", &list_interfaces,
                             "Names of the interfaces.")
      .def(
          "interface",
          [](const ReducedBody& body, const std::string& name) {
            return body.interfaces[flexbody::find_interface(body, name)];
          },
          py::arg("name"), "The interface of that name.")
      .def("save", &save, py::arg("file"),
           "Writes it to one HDF5 file, which a robot's <reduced file=.../> "
           "and read_body read.");
  m.def("reduce", &reduce, py::arg("wish"));
  m.def("read_body", &read_body, py::arg("file"),
        "Reads a body that ReducedBody.save or `limber reduce` wrote.");
}

}  // namespace limber::python
