// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/scene/robot/robot_reader.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::test {

/// Of the elements within <robot>. A text without line breaks is on line 2.
inline Robot read(const std::string& body) {
  const TemporaryFile file("robot.urdf",
                           "<robot name='r'>\n" + body + "\n</robot>");
  return read_robot(file.path());
}

inline std::string error_of(const std::string& body) {
  return input_error([&] { (void)read(body); });
}

}  // namespace limber::scene::test
