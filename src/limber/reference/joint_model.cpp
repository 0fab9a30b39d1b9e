// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reference/joint_model.hpp"

#include "limber/common/names.hpp"

namespace limber::reference {

const std::vector<std::string>& joint_model_names() {
  static const std::vector<std::string> names = {"bushings", "linear-bushings",
                                                 "ideal"};
  return names;
}

JointModel parse_joint_model(std::string_view name) {
  return static_cast<JointModel>(
      find_name("joint model", name, joint_model_names()));
}

}  // namespace limber::reference
