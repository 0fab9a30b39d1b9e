// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/modal/load_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

std::string to_text(const Vector3& v) {
  return fmt::format("({:g}, {:g}, {:g})", v[0], v[1], v[2]);
}

/// Cases with their loads on free degrees of freedom.
class Collection {
 public:
  explicit Collection(Eigen::Index rows) : rows_(rows) {}

  /// Ignores a load that is zero or a multiple of an earlier one. Names are one
  /// line each, for the lists of body files.
  void add(const std::string& name, const VectorX& load) {
    if (load.isZero(0.0) || !seen_.insert(find_direction(load)).second) return;
    names_.push_back(name);
    std::replace(names_.back().begin(), names_.back().end(), '\n', ' ');
    loads_.push_back(load);
  }

  [[nodiscard]] LoadCases take() const {
    LoadCases cases;
    cases.names = names_;
    cases.loads.resize(rows_, static_cast<Eigen::Index>(loads_.size()));
    for (std::size_t i = 0; i < loads_.size(); ++i)
      cases.loads.col(static_cast<Eigen::Index>(i)) = loads_[i];
    return cases;
  }

 private:
  /// The load over its largest entry, rounded so that multiples agree.
  static std::vector<long long> find_direction(const VectorX& load) {
    constexpr double kDigits = 1e12;
    Eigen::Index largest = 0;
    load.cwiseAbs().maxCoeff(&largest);
    LIMBER_EXPECT(load.allFinite() && load[largest] != 0.0);
    std::vector<long long> direction;
    for (const double value : load)
      direction.push_back(std::llround(kDigits * (value / load[largest])));
    return direction;
  }

  Eigen::Index rows_;
  std::vector<std::string> names_;
  std::vector<VectorX> loads_;
  std::set<std::vector<long long>> seen_;
};

std::string describe(const LoadPattern& pattern) {
  std::string text = pattern.interface;
  if (!pattern.force.isZero())
    text += fmt::format(", force {} N", to_text(pattern.force));
  if (!pattern.moment.isZero())
    text += fmt::format(", moment {} N m", to_text(pattern.moment));
  return text;
}

void add_patterns(const ElasticBody& body, const Recipe& recipe,
                  Collection& cases) {
  const MatrixX loads = body.support.on_free(
      find_pattern_loads(body.support.field_rows(), recipe, body.interfaces));
  for (Eigen::Index i = 0; i < loads.cols(); ++i)
    cases.add(describe(recipe.load_patterns[static_cast<std::size_t>(i)]),
              loads.col(i));
}

void add_nodal_forces(const NodalForces& nodal, const Support& support,
                      Collection& cases) {
  check_rows(nodal, support);
  LIMBER_EXPECT(static_cast<Eigen::Index>(nodal.times.size()) ==
                nodal.forces.cols());
  const std::string file =
      std::filesystem::path(nodal.name).filename().string();
  for (Eigen::Index i = 0; i < nodal.forces.cols(); ++i)
    cases.add(fmt::format("{} from {:g} s", file,
                          nodal.times[static_cast<std::size_t>(i)]),
              nodal.forces.col(i));
}

void add_interface(const Interface& interface, const Support& support,
                   Collection& cases) {
  const Matrix6X wrenches = unit_wrenches(interface.motion);
  const MatrixX loads = support.on_free(interface.motion.spread(wrenches));
  for (Eigen::Index i = 0; i < loads.cols(); ++i) {
    const bool is_force = i < 3;
    const Vector3 axis = wrenches.col(i).segment<3>(is_force ? 0 : 3);
    cases.add(fmt::format("{}, {} along {}", interface.name,
                          is_force ? "force" : "moment", to_text(axis)),
              loads.col(i));
  }
}

void add_base_motion(const Support& support, Collection& cases) {
  if (!support.is_clamped)
    throw InputError(
        "measure 'mass' is of the motion of a clamped body's base, but nothing "
        "is clamped: the modes of a free body do not answer it. Use measure "
        "'compliance', or clamp a group.");
  const MatrixX loads =
      fem::multiply_mass(support.matrices.M_s, support.translations);
  for (int axis = 0; axis < 3; ++axis)
    cases.add(fmt::format("base along {}", "xyz"[axis]), loads.col(axis));
}

/// f^T K^+ f, column by column in blocks, so that many cases need little
/// memory. A load that only moves a free body is set to zero: the rest is
/// roundoff.
void find_compliance(const fem::ElasticInverse& inverse, LoadCases& cases) {
  constexpr Eigen::Index kBlock = 64;
  constexpr double kRoundoff = 1e-11;
  cases.compliance.resize(cases.count());
  for (Eigen::Index at = 0; at < cases.count(); at += kBlock) {
    const Eigen::Index width = std::min(kBlock, cases.count() - at);
    auto loads = cases.loads.middleCols(at, width);
    const MatrixX elastic = inverse.project_load(loads);
    for (Eigen::Index i = 0; i < width; ++i)
      if (elastic.col(i).norm() <= kRoundoff * loads.col(i).norm())
        loads.col(i).setZero();
    cases.compliance.segment(at, width) =
        loads.cwiseProduct(inverse.solve(loads)).colwise().sum().transpose();
  }
}

}  // namespace

void check_rows(const NodalForces& nodal, const Support& support) {
  const Eigen::Index rows = support.matrices.dof_count();
  if (nodal.forces.rows() != rows)
    throw InputError(fmt::format(
        "{}: {} rows of forces; expected {}, three for each of the {} nodes "
        "that are not clamped",
        nodal.name, nodal.forces.rows(), rows, rows / 3));
}

LoadCases find_load_cases(const ElasticBody& body, const Recipe& recipe,
                          ModeMeasure measure) {
  const Support& support = body.support;
  Collection collection(support.matrices.dof_count());
  if (measure == ModeMeasure::mass) {
    add_base_motion(support, collection);
  } else {
    add_patterns(body, recipe, collection);
    for (const NodalForces& nodal : recipe.nodal_forces)
      add_nodal_forces(nodal, support, collection);
    if (recipe.load_patterns.empty() && recipe.nodal_forces.empty())
      for (const Interface& interface : body.interfaces)
        add_interface(interface, support, collection);
  }
  LoadCases cases = collection.take();
  const bool has_impacts =
      recipe.basis.automatic && !recipe.basis.automatic->impacts.empty();
  if (cases.count() == 0 && has_impacts) return cases;
  if (cases.count() == 0)
    throw InputError(
        "automatic modes need a load that is not zero: a load on the body, "
        "nodal forces, an interface or a body that strikes it. For a clamped "
        "body there is measure "
        "'mass'; or say how many eigenmodes.");
  find_compliance(body.inverse, cases);
  return cases;
}

}  // namespace limber::flexbody
