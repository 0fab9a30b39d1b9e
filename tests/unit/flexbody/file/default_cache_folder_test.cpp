// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "limber/flexbody/file/cache.hpp"
#include "unit/flexbody/files.hpp"

namespace limber::flexbody::test::default_cache_folder_test {
namespace {

using ::testing::HasSubstr;

// Sets a variable of the environment, or takes it away, for a while.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    set(value);
  }
  ~Variable() { set(old_ ? old_->c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const char* value) const {
    if (value) {
      setenv(name_, value, 1);
    } else {
      unsetenv(name_);
    }
  }
  const char* name_;
  std::optional<std::string> old_;
};

TEST(DefaultCacheFolder, IsTheFirstOfLimbersXdgsAndHomes) {
  const Variable home("HOME", "/home/me");
  const Variable no_xdg("XDG_CACHE_HOME", nullptr);
  const Variable no_own("LIMBER_CACHE", nullptr);
  EXPECT_EQ(default_cache_folder(), "/home/me/.cache/limber");
  const Variable xdg("XDG_CACHE_HOME", "/xdg");
  EXPECT_EQ(default_cache_folder(), "/xdg/limber");
  const Variable own("LIMBER_CACHE", "/own");
  EXPECT_EQ(default_cache_folder(), "/own");
}

TEST(DefaultCacheFolder, IsNotGuessedWhereThereIsNoHome) {
  const Variable no_xdg("XDG_CACHE_HOME", nullptr);
  const Variable no_own("LIMBER_CACHE", nullptr);
  for (const char* home : {static_cast<const char*>(nullptr), "", "relative"}) {
    const Variable set("HOME", home);
    EXPECT_THAT(find_input_error([] { (void)default_cache_folder(); }),
                HasSubstr("--cache"));
  }
}

}  // namespace
}  // namespace limber::flexbody::test::default_cache_folder_test
