// SPDX-License-Identifier: BSD-3-Clause
#include "limber/mesher/sandbox.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace limber::mesher::sandbox_test {
namespace {

// Protection from geometries on kernels with neither seccomp nor Landlock.
TEST(DangerousWord, IsFoundHoweverItIsWritten) {
  for (const std::string text :
       {"SystemCall \"touch x\";", "x = 1; System\n\"touch x\";",
        "NonBlockingSystemCall \"x\";", "UnixCmd \"x\";",
        "a[]={1};OnelabRun(\"x\");", "Save \"x.msh\";", "Print \"x.png\";",
        "Printf(\"hello\") > \"file\";", "Printf(Str(\"a;b\")) >> \"file\";",
        "Printf(\"a > b\", 1) > Str(\"file\");", "Error(\"x\") > \"file\";",
        "Plugin(Skin).Run;", "Parse(\"Save\");", "/* */ Save \"x\";",
        "// \"\nSave \"x\";", "For i In {0:1} Save \"x\"; EndFor"}) {
    EXPECT_TRUE(find_dangerous_command(text)) << text;
  }
}

TEST(DangerousWord, IsNotInPlainGeometries) {
  for (const std::string text :
       {"", "Point(1) = {0, 0, 0, 0.1};", "Printf(\"a > b; Save\");",
        "// SystemCall \"x\";\n", "/* Save \"x\"; */",
        "SaveAll = 1; MySystem = 2; Mesh.SaveAll = 1;",
        "x = \"SystemCall\"; y = 'Save';", "If(1 > 0) Printf(\"x\"); EndIf"}) {
    EXPECT_FALSE(find_dangerous_command(text)) << text;
  }
}

TEST(FleetingWord, IsTheClockMemoryChanceAndEnvironment) {
  for (const std::string word :
       {"Cpu", "Memory", "TotalMemory", "Today", "GetEnv(\"A\")", "Rand(1)"}) {
    EXPECT_TRUE(has_unrepeatable_command("x = " + word + ";")) << word;
  }
  EXPECT_FALSE(has_unrepeatable_command("Random = 1; MyCpu = 2; x = Cpus;"));
}

}  // namespace
}  // namespace limber::mesher::sandbox_test
