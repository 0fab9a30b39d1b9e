// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/list_option.hpp"

#include <fmt/format.h>

#include "limber/common/echo.hpp"

namespace limber::app {

std::vector<std::string> split_list(const std::string& option,
                                    const std::vector<std::string>& given) {
  std::vector<std::string> values;
  for (const std::string& text : given) {
    std::size_t begin = 0;
    for (;;) {
      const std::size_t end = text.find(',', begin);
      values.push_back(text.substr(begin, end - begin));
      if (values.back().empty()) {
        throw CLI::ValidationError(
            option, fmt::format("'{}' has an empty value; expected values "
                                "separated by commas",
                                echo(text)));
      }
      if (end == std::string::npos) break;
      begin = end + 1;
    }
  }
  return values;
}

}  // namespace limber::app
