// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/link_start.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/scene/text/force_file.hpp"

namespace limber::scene {
namespace {

using flexbody::ProjectedField;
using OptionalField = std::optional<ProjectedField>;

flexbody::NodalField read_field(const std::filesystem::path& file) {
  if (file.empty()) return {};
  return {file.string(), read_nodal_field(file)};
}

void check_field(const std::filesystem::path& file, const OptionalField& kept,
                 const flexbody::ReducedBody& body, const std::string& what) {
  if (file.empty()) return;
  const std::string remedy = fmt::format(
      "The rows that it needs may not have been kept, so the field must be "
      "projected when reducing: limber reduce --initial-{} {}",
      what, file.string());
  if (!kept) {
    throw InputError(
        fmt::format("the reduced body '{}' holds no initial {}. {}", body.name,
                    what, remedy));
  }
  if (kept->key != flexbody::find_field_key(read_nodal_field(file))) {
    throw InputError(
        fmt::format("the reduced body '{}' was made with another initial {} "
                    "than {}. {}",
                    body.name, what, file.string(), remedy));
  }
}

VectorX find_coordinates(const std::vector<double>& values,
                         const std::filesystem::path& file,
                         const OptionalField& field,
                         const flexbody::ReducedBody& body) {
  if (!file.empty()) {
    LIMBER_EXPECT(field.has_value());
    return field->eta;
  }
  const auto given = static_cast<Eigen::Index>(values.size());
  if (given > body.lambda.size()) {
    throw InputError(fmt::format(
        "{} modal coordinates; the body has {} modes (fewer are padded with "
        "zeros)",
        given, body.lambda.size()));
  }
  VectorX eta = VectorX::Zero(body.lambda.size());
  eta.head(given) = Eigen::Map<const VectorX>(values.data(), given);
  return eta;
}

}  // namespace

const LinkStart* find_start(const Scenario& scenario, const std::string& link) {
  const auto found = scenario.link_starts.find(link);
  return found == scenario.link_starts.end() ? nullptr : &found->second;
}

void add_initial_fields(const LinkStart& start, flexbody::Recipe& recipe) {
  recipe.initial_displacement = read_field(start.displacement);
  recipe.initial_velocity = read_field(start.velocity);
}

void check_saved_fields(const LinkStart& start,
                        const flexbody::ReducedBody& body) {
  check_field(start.displacement, body.initial.displacement, body,
              "displacement");
  check_field(start.velocity, body.initial.velocity, body, "velocity");
}

std::vector<std::string> describe_losses(const LinkStart& start,
                                         const flexbody::ReducedBody& body) {
  std::vector<std::string> texts;
  const auto add = [&](const std::filesystem::path& file,
                       const OptionalField& field, const std::string& what) {
    if (file.empty() || !field) return;
    const auto more = flexbody::describe_losses(*field, what);
    texts.insert(texts.end(), more.begin(), more.end());
  };
  add(start.displacement, body.initial.displacement, "initial displacement");
  add(start.velocity, body.initial.velocity, "initial velocity");
  return texts;
}

ModalStart find_modal_start(const LinkStart& start,
                            const flexbody::ReducedBody& body) {
  return {find_coordinates(start.eta, start.displacement,
                           body.initial.displacement, body),
          find_coordinates(start.etadot, start.velocity, body.initial.velocity,
                           body)};
}

}  // namespace limber::scene
