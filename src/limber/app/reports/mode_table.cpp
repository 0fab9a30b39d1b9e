// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/mode_table.hpp"

#include <fmt/format.h>

#include <numbers>
#include <numeric>

#include "limber/app/options/mode_options.hpp"

namespace limber::app {
namespace {

using flexbody::BaseMotionStudy;
using flexbody::LoadCaseStudy;
using flexbody::ModeStudy;

VectorX frequencies(const ModeStudy& study) {
  return study.lambda.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
}

/// Percent of a total; zeros if the total is zero.
VectorX find_percent(const VectorX& parts, double total) {
  if (total == 0.0) return VectorX::Zero(parts.size());
  return 100.0 / total * parts;
}

VectorX accumulate(const VectorX& parts) {
  VectorX sums(parts.size());
  std::partial_sum(parts.begin(), parts.end(), sums.begin());
  return sums;
}

MatrixX find_base_percent(const BaseMotionStudy& base) {
  MatrixX percent(base.effective_mass.cols(), 3);
  for (Eigen::Index a = 0; a < 3; ++a)
    percent.col(a) =
        find_percent(base.effective_mass.row(a).transpose(), base.total[a]);
  return percent;
}

MatrixX accumulate_columns(const MatrixX& parts) {
  MatrixX sums(parts.rows(), parts.cols());
  for (Eigen::Index a = 0; a < parts.cols(); ++a)
    sums.col(a) = accumulate(parts.col(a));
  return sums;
}

Json describe_case(const LoadCaseStudy& study) {
  Json json{{"load", study.name},
            {"effective_mass", to_json(study.effective_mass)}};
  if (study.effective_mass_total) {
    const VectorX percent =
        find_percent(study.effective_mass, *study.effective_mass_total);
    json["effective_mass_percent"] = to_json(percent);
    json["effective_mass_cumulative_percent"] = to_json(accumulate(percent));
    json["effective_mass_total"] = *study.effective_mass_total;
  }
  const VectorX percent =
      find_percent(study.compliance, study.compliance_total);
  json["compliance"] = to_json(study.compliance);
  json["compliance_percent"] = to_json(percent);
  json["compliance_cumulative_percent"] = to_json(accumulate(percent));
  json["compliance_total"] = study.compliance_total;
  return json;
}

Json describe_base(const BaseMotionStudy& base) {
  const MatrixX percent = find_base_percent(base);
  return Json{{"participation_factors", to_json(base.factors.transpose())},
              {"effective_mass", to_json(base.effective_mass.transpose())},
              {"effective_mass_percent", to_json(percent)},
              {"cumulative_percent", to_json(accumulate_columns(percent))},
              {"total", to_json(base.total)}};
}

void print_modes(const ModeStudy& study) {
  const VectorX hz = frequencies(study);
  fmt::print("{:>5} {:>16} {:>16}\n", "mode", "frequency [Hz]",
             "eigenvalue [1/s^2]");
  for (Eigen::Index i = 0; i < hz.size(); ++i) {
    fmt::print("{:>5} {:>16.8g} {:>16.10g}\n", i + 1, hz[i], study.lambda[i]);
  }
}

void print_masses(const LoadCaseStudy& study, Eigen::Index mode) {
  fmt::print("{:>5} {:>14.6g}", mode + 1, study.effective_mass[mode]);
  if (!study.effective_mass_total) {
    fmt::print(" {:>8} {:>8}", "-", "-");
    return;
  }
  const VectorX percent =
      find_percent(study.effective_mass, *study.effective_mass_total);
  fmt::print(" {:>8.2f} {:>8.2f}", percent[mode], accumulate(percent)[mode]);
}

void print_case(const LoadCaseStudy& study) {
  fmt::print("\nload '{}'\n{:>5} {:>14} {:>8} {:>8} {:>14} {:>8} {:>8}\n",
             study.name, "mode", "eff. mass", "%", "sum", "compliance [J]", "%",
             "sum");
  const VectorX percent =
      find_percent(study.compliance, study.compliance_total);
  const VectorX sums = accumulate(percent);
  for (Eigen::Index i = 0; i < percent.size(); ++i) {
    print_masses(study, i);
    fmt::print(" {:>14.6g} {:>8.2f} {:>8.2f}\n", study.compliance[i],
               percent[i], sums[i]);
  }
  fmt::print("{:>5} {:>14} {:>8} {:>8} {:>14.6g}\n", "all",
             study.effective_mass_total
                 ? fmt::format("{:.6g}", *study.effective_mass_total)
                 : "unknown",
             "", "", study.compliance_total);
  if (!study.effective_mass_total) {
    fmt::print(
        "The effective mass of all modes is unknown: the mesh is too large to "
        "find them all.\n");
  }
}

void print_base(const BaseMotionStudy& base) {
  fmt::print(
      "\nbase motion: participation factor [kg^1/2], effective modal mass "
      "[kg], its percentage and their sum\n");
  const MatrixX percent = find_base_percent(base);
  const MatrixX sums = accumulate_columns(percent);
  for (Eigen::Index a = 0; a < 3; ++a) {
    fmt::print("{:>5} {:>14} {:>14} {:>8} {:>8}\n", "mode",
               fmt::format("{} factor", "xyz"[a]), "mass", "%", "sum");
    for (Eigen::Index i = 0; i < percent.rows(); ++i) {
      fmt::print("{:>5} {:>14.6g} {:>14.6g} {:>8.2f} {:>8.2f}\n", i + 1,
                 base.factors(a, i), base.effective_mass(a, i), percent(i, a),
                 sums(i, a));
    }
    fmt::print("{:>5} {:>14} {:>14.6g}\n", "all", "", base.total[a]);
  }
}

}  // namespace

Json to_json(const ModeStudy& study) {
  Json json{{"nodes", study.mesh_nodes},
            {"elements", study.mesh_elements},
            {"boundary_nodes", study.mesh_boundary_nodes},
            {"clamped", study.clamped},
            {"size", to_json(study.size)},
            {"mass", study.mass},
            {"center_of_mass", to_json(study.p_MoBcm_M)},
            {"inertia", to_json(study.inertia)},
            {"eigenvalues", to_json(study.lambda)},
            {"frequencies_hz", to_json(frequencies(study))}};
  if (!study.found.empty()) json["found"] = study.found;
  if (study.locking) json["locking"] = to_json(*study.locking);
  if (!study.cases.empty()) json["load_cases"] = Json::array();
  for (const LoadCaseStudy& item : study.cases)
    json["load_cases"].push_back(describe_case(item));
  if (study.base) json["base_motion"] = describe_base(*study.base);
  return json;
}

void print_text(const ModeStudy& study) {
  const Vector3& c = study.p_MoBcm_M;
  if (study.mesh_elements > 0) {
    fmt::print("{} nodes ({} on the boundary), {} elements\n", study.mesh_nodes,
               study.mesh_boundary_nodes, study.mesh_elements);
  } else {  // matrices
    fmt::print("{} nodes\n", study.mesh_nodes);
  }
  fmt::print("{:.4g} x {:.4g} x {:.4g} m, ", study.size.x(), study.size.y(),
             study.size.z());
  fmt::print("mass {:.6g} kg, centre of mass ({:.6g}, {:.6g}, {:.6g}) m\n",
             study.mass, c.x(), c.y(), c.z());
  print_modes(study);
  for (const LoadCaseStudy& item : study.cases) print_case(item);
  if (study.base) print_base(*study.base);
}

}  // namespace limber::app
