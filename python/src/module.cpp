// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"
#include "limber/common/files/build_id.hpp"
#include "limber/common/files/own_file.hpp"
#include "limber/version.hpp"

PYBIND11_MODULE(_core, m) {
  using namespace limber::python;
  // Python is the program: this module is Limber's own file.
  limber::set_own_code(reinterpret_cast<const void*>(&bind_errors));
  m.doc() = "The compiled part of limber.";
  m.attr("__version__") = LIMBER_VERSION;
  m.attr("build_id") = limber::find_build_id();
  bind_errors();
  bind_functions(m);
  bind_laws(m);
  bind_body(m);
  bind_system(m);
  bind_builder(m);
  bind_run(m);
  bind_simulator(m);
  bind_batch(m);
  bind_scenario(m);
  bind_analysis(m);
  bind_linear(m);
  bind_study(m);
}
