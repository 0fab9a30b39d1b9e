// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "support/spring_network.hpp"

namespace limber::testing {

using dynamics::AttachmentIndex;
using dynamics::Fidelity;
using dynamics::ModalDamping;
using dynamics::SystemModel;
using dynamics::SystemState;

inline constexpr int kAllModes = 42;  // of 16 nodes, less rigid motion

/// Lattices one behind the other along z, joined by bushings.
class LatticeChain {
 public:
  LatticeChain();

  void add(Fidelity fidelity, int modes = kAllModes,
           const ModalDamping& damping = {});

  /// Connects the last added body to the previous one, by `count` bushings that
  /// share stiffness and damping equally.
  void join(double stiffness, double damping, int count = 1);
  void join_world(double stiffness, double damping);
  [[nodiscard]] AttachmentIndex last_end() const { return ends_.back().second; }

  [[nodiscard]] SystemModel build() const { return builder.build(); }

  /// In line, a little apart, turning and with a shape in the first modes.
  [[nodiscard]] SystemState place(const SystemModel& model, double gap,
                                  const Vector3& spin, double shape) const;

  dynamics::SystemBuilder builder;
  std::string first_set = "first";
  std::string last_set = "last";

 private:
  template <typename Attach>
  void attach(const Attach& at);
  [[nodiscard]] Vector3 find_mean(const std::string& name) const;
  [[nodiscard]] flexbody::InterfaceTable make_table(
      const std::string& name, const flexbody::ReducedBody& reduced) const;

  SpringNetwork network_;
  std::shared_ptr<const flexbody::FullBody> full_;
  std::vector<std::pair<AttachmentIndex, AttachmentIndex>> ends_;
};

}  // namespace limber::testing
