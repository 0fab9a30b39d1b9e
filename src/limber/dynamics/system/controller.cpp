// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/controller.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/records/manifest.hpp"

namespace limber::dynamics {

std::string_view to_string(InputHold hold) {
  return hold == InputHold::held ? "held" : "linear";
}

long ControllerModel::find_first(double t, double same) const {
  const double at_least = t - same;
  long k = static_cast<long>(
      std::max(0.0, std::floor((at_least - offset) / period)));
  while (find_time(k) < at_least) ++k;
  return k;
}

FunctionController::FunctionController(std::string identity, Function function,
                                       Memory memory)
    : identity_(std::move(identity)),
      function_(std::move(function)),
      memory_(memory) {
  LIMBER_EXPECT(function_ != nullptr);
}

void FunctionController::sample(const ControllerView& view,
                                std::span<double> memory,
                                std::span<double> written) const {
  function_(view, memory, written);
}

void FunctionController::describe(Manifest& out) const {
  out.add("function", std::string_view(identity_));
}

bool FunctionController::has_hidden_memory() const {
  return memory_ == Memory::hidden;
}

}  // namespace limber::dynamics
