// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <vector>

#include "limber/dynamics/system/controller.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/sliding_masses.hpp"

namespace limber::testing {

using dynamics::ControllerModel;
using dynamics::ControllerView;
using dynamics::FunctionController;
using dynamics::InputIndex;
using dynamics::Measurement;
using dynamics::SystemBuilder;
using dynamics::SystemModel;
using dynamics::SystemState;

using Function = FunctionController::Function;

inline Measurement measure_x() {
  return {"x", "p_WB.x", [](const SystemModel&, const SystemState& state) {
            return state.bodies[0].p_WB.x();
          }};
}

struct Sample {
  double t;
  long number;
};

/// A pushed mass on a rail whose controller notes its samples.
class Sampled : public ::testing::Test {
 protected:
  Sampled() {
    mass_ = add_mass(builder_, "mass", 2.0);
    input_ = builder_.add_input("push", 0.0);
    builder_.add_load("push", mass_.frame, Vector3::UnitX(), Vector3::Zero(),
                      dynamics::LoadFrame::world,
                      dynamics::InputFunction{input_, 1.0});
  }

  ControllerModel make(double period, Function function,
                       FunctionController::Memory memory =
                           FunctionController::Memory::in_state) {
    return {
        .name = "controller",
        .period = period,
        .writes = {input_},
        .measures = {measure_x()},
        .law = std::make_shared<FunctionController>("test", function, memory)};
  }

  Function note(double kx) {
    return [this, kx](const ControllerView& view, std::span<double>,
                      std::span<double> written) {
      samples_.push_back({view.t, view.sample});
      written[0] = kx * view.measured[0] + 0.3;
    };
  }

  // k = first, ..., each once and at its time.
  void expect_each_once(long first, long count, double offset, double period) {
    ASSERT_EQ(std::ssize(samples_), count);
    for (long k = 0; k < count; ++k) {
      const Sample& sample = samples_[static_cast<std::size_t>(k)];
      EXPECT_EQ(sample.number, first + k);
      EXPECT_EQ(sample.t, offset + static_cast<double>(first + k) * period);
    }
  }

  SystemBuilder builder_;
  Mass mass_;
  InputIndex input_;
  std::vector<Sample> samples_;
};

}  // namespace limber::testing
