// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// How the nodes that spiders and means lead move with others.
class NodeMotions {
 public:
  /// The six unknowns of a node by those of one with rows of its own.
  using Contribution = std::pair<int, Matrix6>;

  /// @throws InputError with the place of a node that is led twice or, by a
  /// chain, by itself, and of a mean whose nodes lie on a line
  explicit NodeMotions(const Structure& structure);

  [[nodiscard]] bool is_led(int node) const {
    return !ties_[static_cast<std::size_t>(node)].contributions.empty();
  }
  /// Whether others move with its rotation.
  [[nodiscard]] bool is_hub(int node) const {
    return is_hub_[static_cast<std::size_t>(node)] != 0;
  }
  /// By nodes with rows of their own: itself, where it is not led.
  [[nodiscard]] std::vector<Contribution> find_contributions(int node) const;
  /// Where it is led. "file:line"
  [[nodiscard]] const std::string& place_of(int node) const {
    return ties_[static_cast<std::size_t>(node)].place;
  }

 private:
  struct Tie {
    std::vector<Contribution> contributions;
    std::string place;
  };
  void add(int node, Tie tie);
  void add_mean(const Structure& structure, const StructureMean& mean);
  void resolve();
  void resolve(int node);

  std::vector<Tie> ties_;  // by node; without contributions: it is not led
  std::vector<char> is_hub_;
  const std::vector<std::size_t>& tags_;
};

}  // namespace limber::fem
