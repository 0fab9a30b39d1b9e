// SPDX-License-Identifier: BSD-3-Clause
// What goes wrong around the command: files that are none, streams that are
// full, places that cannot be written, limits.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::faults_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

// A single body on a spring: no mesh, so it starts at once.
void write_robot(const Workspace& place) {
  place.write("r.urdf",
              "<robot name='r'><link name='world'/><link name='arm'><inertial>"
              "<mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
              "ixz='0' iyz='0'/></inertial></link><joint name='j' "
              "type='continuous'><parent link='world'/><child link='arm'/>"
              "<axis xyz='0 0 1'/></joint></robot>");
}

void write_scene(const Workspace& place, const std::string& name,
                 const std::string& probe = "p") {
  write_robot(place);
  place.write(
      name,
      fmt::format(
          "robot = 'r.urdf'\n[gravity]\nacceleration = [0.0, 0.0, -9.81]\n"
          "[time]\nduration = 0.01\nstep = 0.001\n"
          "output_interval = 0.001\n"
          "[output]\npictures = false\n"
          "[[probe]]\nname = \"{}\"\nlink = 'arm'\n"
          "point = [0.0, 0.0, 0.0]\n",
          probe));
}

std::vector<std::string> list_files(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// `timeout` ends with 124 what waits for ever.
void expect_refused(const Workspace& place, const std::string& arguments) {
  const CommandResult result = run_shell(
      place, "ulimit -v 4000000; timeout 20 '" LIMBER_COMMAND "' " + arguments);
  EXPECT_EQ(result.status, 2) << arguments << "\n" << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("expected a regular file")) << arguments;
}

TEST(Inputs, ThatArePipesDevicesOrFoldersAreRefusedAtOnce) {
  if (kIsSanitized) GTEST_SKIP() << "sets limits";
  const Workspace place;
  write_scene(place, "s.toml");
  ASSERT_EQ(mkfifo((place.folder() / "pipe").c_str(), 0600), 0);
  for (const char* name : {"m.msh", "m.geo", "m.toml", "m.urdf", "m.h5"}) {
    ASSERT_EQ(mkfifo((place.folder() / name).c_str(), 0600), 0);
    expect_refused(place, fmt::format("info {}", name));
  }
  for (const char* file : {"pipe", "/dev/zero", "."}) {
    expect_refused(place, fmt::format("run {}", file));
    expect_refused(place, fmt::format("wobble --mesh " LIMBER_SOURCE_DIR
                                      "/meshes/rod.geo --material {} --force "
                                      "x --step 1 --duration 1",
                                      file));
    place.write("robot.toml", fmt::format("robot = '{}'\n[time]\nduration = 1\n"
                                          "step = 0.1\n",
                                          file));
    expect_refused(place, "run robot.toml");
    expect_refused(place, fmt::format("modes " LIMBER_SOURCE_DIR
                                      "/meshes/rod.geo --youngs-modulus 1 "
                                      "--poisson-ratio 0.3 --density 1 "
                                      "--force {}",
                                      file));
  }
  expect_refused(
      place, "modes m.msh --youngs-modulus 1 --poisson-ratio 0.3 --density 1");
  fs::create_symlink("/dev/zero", place.folder() / "zero.msh");
  expect_refused(
      place,
      "modes zero.msh --youngs-modulus 1 --poisson-ratio 0.3 --density 1");
  fs::create_directories(place.folder() / "o/checkpoint.bin");
  const CommandResult resumed = place.limber("run s.toml --out o --resume");
  EXPECT_EQ(resumed.status, 2);
  EXPECT_THAT(resumed.errors, HasSubstr("regular file"));
}

TEST(Inputs, OfARedirectedFileAreRead) {
  const Workspace place;
  write_scene(place, "s.toml");
  const CommandResult result =
      run_shell(place,
                "limber info /dev/stdin < s.toml; cat s.toml | timeout 20 "
                "'" LIMBER_COMMAND "' run /dev/stdin");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("it is a pipe"));
}

TEST(Names, WithControlCharactersAreRefusedWhenRead) {
  const Workspace place;
  for (const char* name : {"a\\u0000b", "a\\nb", "a\\u001b[2Jb", "a\\u009bb"}) {
    write_scene(place, "s.toml", name);
    const CommandResult result = place.limber("run s.toml --out o");
    EXPECT_EQ(result.status, 2) << name;
    EXPECT_THAT(result.errors,
                AllOf(HasSubstr("s.toml:"), HasSubstr("control character")));
    EXPECT_EQ(result.errors.find('\x1b'), std::string::npos);
  }
  write_scene(place, "s.toml");
  std::string robot = read_text(place.folder() / "r.urdf");
  robot.replace(robot.find("name='j'"), 8, "name='j&#x1b;[2J'");
  place.write("r.urdf", robot);
  const CommandResult result = place.limber("run s.toml --out o");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("control character"));
  EXPECT_EQ(result.errors.find('\x1b'), std::string::npos);
}

// As in a robot that was saved as Latin-1. The message itself is UTF-8.
TEST(Names, ThatAreNotUtf8AreRefusedWithTheirLine) {
  for (const char* name : {"name='j'", "name='arm'", "name='r'"}) {
    const Workspace place;
    write_scene(place, "s.toml");
    std::string robot = read_text(place.folder() / "r.urdf");
    const std::size_t at = robot.find(name);
    ASSERT_NE(at, std::string::npos) << name;
    robot.insert(at + std::string(name).size() - 1, "\xe4");
    place.write("r.urdf", robot);
    for (const char* command : {"run s.toml --out o", "info r.urdf"}) {
      const CommandResult result = place.limber(command);
      EXPECT_EQ(result.status, 2) << command << name;
      EXPECT_THAT(result.errors, AllOf(HasSubstr("r.urdf:"), HasSubstr("\\xe4"),
                                       HasSubstr("not UTF-8")));
      EXPECT_EQ(result.errors.find('\xe4'), std::string::npos);
    }
  }
}

TEST(Names, OfAScenarioThatAreNotUtf8AreRefusedWithTheirLine) {
  const Workspace place;
  write_scene(place, "s.toml", "p\xff");
  const CommandResult result = place.limber("run s.toml --out o");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("s.toml:"));
  EXPECT_EQ(result.errors.find('\xff'), std::string::npos);
  EXPECT_EQ(
      place.limber("run s.toml --out o --set probe.p.name=\"q\xff\"").status,
      2);
}

TEST(Names, AreEchoedUpToTwoHundredCharacters) {
  const Workspace place;
  write_scene(place, "s.toml", std::string(100000, 'n'));
  EXPECT_LT(place.limber("run s.toml").errors.size(), 1000U);
  write_scene(place, "s.toml");
  const std::string text = read_text(place.folder() / "s.toml");
  const std::string long_word(100000, 'k');
  for (const std::string& line :
       {"[fidelity]\ndefault = '" + long_word + "'\n", long_word + " = 1\n",
        "[fidelity.links]\n" + long_word + " = 'rigid'\n",
        "'" + long_word + "\n"}) {
    place.write("t.toml", text + line);
    const CommandResult result = place.limber("run t.toml");
    EXPECT_EQ(result.status, 2);
    EXPECT_LT(result.errors.size(), 2000U) << line.substr(0, 20);
  }
  EXPECT_LT(place.limber("run s.toml --fidelity " + long_word).errors.size(),
            2000U);
  EXPECT_LT(place.limber("'" + long_word + "'").errors.size(), 2000U);
}

TEST(StandardOutput, ThatIsFullIsAnError) {
  const Workspace place;
  write_scene(place, "s.toml");
  ASSERT_EQ(place.limber("run s.toml --out h").status, 0);
  for (const char* arguments :
       {"run s.toml --out o", "run s.toml --out o --json", "info s.toml",
        "info h/results.h5 --json", "frequencies s.toml", "--help", "--version",
        "verify s.toml"}) {
    const CommandResult result =
        run_shell(place, fmt::format("limber {} > /dev/full", arguments));
    EXPECT_EQ(result.status, 2) << arguments << "\n" << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("standard output cannot be written"))
        << arguments;
  }
  EXPECT_TRUE(fs::exists(place.folder() / "o/results.h5"));
  EXPECT_TRUE(fs::exists(place.folder() / "o/summary.json"));
}

TEST(StandardOutput, ThatIsClosedOrBrokenIsAnError) {
  const Workspace place;
  write_scene(place, "s.toml");
  const CommandResult closed =
      run_shell(place, "limber run s.toml --out o --json >&-");
  EXPECT_EQ(closed.status, 2) << closed.errors;
  const CommandResult broken = run_shell(
      place,
      "{ sleep 1; limber info s.toml; echo $? > status; } | true; "
      "while ! test -s status; do sleep 0.1; done; exit $(cat status)");
  EXPECT_EQ(broken.status, 2) << broken.errors;
}

TEST(StandardError, ThatIsFullChangesNothing) {
  const Workspace place;
  write_scene(place, "s.toml");
  EXPECT_EQ(run_shell(place, "limber run s.toml --out o 2> /dev/full").status,
            0);
  EXPECT_EQ(run_shell(place, "limber run absent.toml 2> /dev/full").status, 2);
}

TEST(Results, ThatCannotBeWrittenAreSavedElsewhere) {
  const Workspace place;
  write_scene(place, "s.toml");
  fs::create_directories(place.folder() / "o/results.h5");
  fs::create_directories(place.folder() / "tmp");
  const CommandResult result = run_shell(
      place, "TMPDIR=\"$PWD/tmp\" '" LIMBER_COMMAND "' run s.toml --out o");
  EXPECT_EQ(result.status, 2);
  const auto saved = list_files(place.folder() / "tmp");
  ASSERT_EQ(saved.size(), 1U);
  EXPECT_THAT(result.errors,
              AllOf(HasSubstr("results.h5"), HasSubstr(saved[0])));
  EXPECT_THAT(list_files(place.folder() / "tmp" / saved[0]),
              ::testing::ElementsAre("envelopes.csv", "peaks.csv", "probes.csv",
                                     "results.h5", "summary.json"));
  const auto mode = fs::status(place.folder() / "tmp" / saved[0]).permissions();
  EXPECT_EQ(mode, fs::perms::owner_all);
}

TEST(Results, FindAPlaceWithoutATemporaryFolder) {
  const Workspace place;
  write_scene(place, "s.toml");
  EXPECT_EQ(run_shell(place, "TMPDIR=/no/such/folder '" LIMBER_COMMAND
                             "' run s.toml --out good")
                .status,
            0);
  fs::create_directories(place.folder() / "o/results.h5");
  const CommandResult result = run_shell(
      place, "TMPDIR=/no/such/folder '" LIMBER_COMMAND "' run s.toml --out o");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("'limber-results-"));
}

TEST(Results, ThatAFileLimitCutsAreAnErrorAndNoSignal) {
  if (kIsSanitized) GTEST_SKIP() << "sets limits";
  const Workspace place;
  write_scene(place, "s.toml");
  ASSERT_EQ(place.limber("run s.toml --out o").status, 0);
  const std::string before = read_text(place.folder() / "o/results.h5");
  const CommandResult result =
      run_shell(place, "ulimit -f 8; limber run s.toml --out o");
  EXPECT_EQ(result.status, 2) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("cannot be written"));
  EXPECT_EQ(read_text(place.folder() / "o/results.h5"), before);
}

// A gnuplot that notes what has been printed, and what is there, and fails.
TEST(Results, AreTheirsToReadBeforePicturesAreDrawn) {
  const Workspace place;
  write_scene(place, "s.toml");
  std::string text = read_text(place.folder() / "s.toml");
  text.erase(text.find("[output]\npictures = false\n"), 26);
  place.write("s.toml", text);
  fs::create_directories(place.folder() / "bin");
  place.write("bin/gnuplot",
              "#!/bin/sh\ncat output > seen; ls o > files; exit 1\n");
  fs::permissions(place.folder() / "bin/gnuplot", fs::perms::owner_all);
  for (const char* form : {"", " --json"}) {
    const CommandResult result =
        run_shell(place, fmt::format("PATH=\"$PWD/bin:$PATH\" '" LIMBER_COMMAND
                                     "' run s.toml --out o{} > output",
                                     form));
    ASSERT_EQ(result.status, 0) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("no picture"));
    EXPECT_FALSE(read_text(place.folder() / "output").empty());
    EXPECT_EQ(read_text(place.folder() / "seen"),
              read_text(place.folder() / "output"));
    EXPECT_EQ(
        read_text(place.folder() / "files"),
        "envelopes.csv\npeaks.csv\nprobes.csv\nresults.h5\nsummary.json\n");
    fs::remove_all(place.folder() / "o");
  }
}

TEST(Results, OfAnEarlierRunGoAndFilesOfTheUserStay) {
  const Workspace place;
  write_scene(place, "s.toml");
  std::string text = read_text(place.folder() / "s.toml");
  text.erase(text.find("[output]\npictures = false\n"), 26);
  place.write("old.toml", text);
  const CommandResult old = place.limber("run old.toml --out o --xdmf");
  ASSERT_EQ(old.status, 0);
  EXPECT_THAT(old.errors, HasSubstr("no motion.xdmf: no body has a mesh"));
  ASSERT_TRUE(fs::exists(place.folder() / "o/probe_p.png"));
  place.write("o/probe_mine.png", "the user's");
  place.write("o/notes.txt", "the user's");
  text.replace(text.find("name = \"p\""), 10, "name = \"q\"");
  place.write("new.toml", text);
  ASSERT_EQ(place.limber("run new.toml --out o").status, 0);
  EXPECT_TRUE(fs::exists(place.folder() / "o/probe_q.png"));
  EXPECT_FALSE(fs::exists(place.folder() / "o/probe_p.png"));
  ASSERT_EQ(place.limber("run s.toml --out o").status, 0);  // no pictures
  EXPECT_THAT(
      list_files(place.folder() / "o"),
      ::testing::ElementsAre(".limber-files", "envelopes.csv", "notes.txt",
                             "peaks.csv", "probe_mine.png", "probes.csv",
                             "results.h5", "summary.json"));
}

TEST(Results, OfRunsThatAnEarlierCompareKeptGo) {
  const Workspace place;
  write_scene(place, "s.toml");
  const std::string two = "compare s.toml --keep --out o --step 1e-3,5e-4";
  ASSERT_EQ(place.limber(two).status, 0);
  const fs::path out = place.folder() / "o";
  const std::vector<std::string> before = list_files(out);
  ASSERT_TRUE(fs::exists(out / "coupled-0.001s/results.h5"));
  ASSERT_TRUE(fs::exists(out / "coupled-0.0005s/results.h5"));
  fs::create_directories(out / "mine");
  place.write("o/mine/results.h5", "the user's");
  place.write("o/reference/notes.txt", "the user's");

  const std::string one = "compare s.toml --keep --out o --step 1e-3";
  ASSERT_EQ(place.limber(one).status, 0);
  EXPECT_TRUE(fs::exists(out / "coupled-0.001s/results.h5"));
  EXPECT_TRUE(fs::exists(out / "reference/results.h5"));
  EXPECT_FALSE(fs::exists(out / "coupled-0.0005s"));

  ASSERT_EQ(place.limber("run s.toml --out o").status, 0);
  EXPECT_FALSE(fs::exists(out / "coupled-0.001s"));
  EXPECT_THAT(list_files(out / "reference"),
              ::testing::ElementsAre("notes.txt"));
  EXPECT_TRUE(fs::exists(out / "mine/results.h5"));
}

TEST(Results, FolderInTheListThatIsALinkIsLeftAlone) {
  const Workspace place;
  write_scene(place, "s.toml");
  ASSERT_EQ(place.limber("run s.toml --out precious").status, 0);
  fs::create_directories(place.folder() / "o");
  fs::create_directory_symlink(place.folder() / "precious",
                               place.folder() / "o/link");
  place.write("o/.limber-files", "list:\nlink/\n../precious/\n/\n../\n");
  ASSERT_EQ(place.limber("run s.toml --out o").status, 0);
  EXPECT_TRUE(fs::exists(place.folder() / "precious/results.h5"));
}

TEST(Results, ListOfFilesThatLeadsElsewhereRemovesNothing) {
  const Workspace place;
  write_scene(place, "s.toml");
  place.write("precious", "x");
  fs::create_directories(place.folder() / "o");
  place.write("o/.limber-files", "list:\n../precious\n..\n.\n\n");
  ASSERT_EQ(place.limber("run s.toml --out o").status, 0);
  EXPECT_TRUE(fs::exists(place.folder() / "precious"));
}

TEST(AddressSpace, ThatIsShortEndsWithWordsAndNeverHangs) {
  if (kIsSanitized) GTEST_SKIP() << "sets limits";
  const Workspace place;
  write_scene(place, "s.toml");
  for (const int kilobytes :
       {100000, 220000, 300000, 450000, 600000, 900000, 1300000, 2000000}) {
    for (const char* arguments :
         {"run s.toml --out o",
          "modes " LIMBER_SOURCE_DIR "/meshes/rod.geo --youngs-modulus 2e11 "
          "--poisson-ratio 0.3 --density 7800"}) {
      const CommandResult result = run_shell(
          place, fmt::format("ulimit -v {}; timeout 60 '" LIMBER_COMMAND "' {}",
                             kilobytes, arguments));
      // Before any code of ours: 127, the system's loader has not found room
      // for the libraries and says "shared object"; 130, OpenBLAS has not for
      // its threads, says "pthread_create failed" and interrupts the program.
      EXPECT_THAT(result.status, AnyOf(0, 2, 3, 127, 130))
          << kilobytes << " " << arguments << "\n"
          << result.errors;
      EXPECT_THAT(result.errors,
                  result.status == 0     ? HasSubstr("")
                  : result.status == 127 ? HasSubstr("shared object")
                  : result.status == 130 ? HasSubstr("pthread_create failed")
                                         : HasSubstr("memory"));
    }
  }
}

TEST(RigidScene, NeedsNoPlaceForReducedBodies) {
  const Workspace place;
  write_scene(place, "s.toml");
  const CommandResult result = run_shell(
      place, "env -u HOME -u LIMBER_CACHE -u XDG_CACHE_HOME '" LIMBER_COMMAND
             "' run s.toml");
  EXPECT_EQ(result.status, 0) << result.errors;
}

TEST(Stack, ThatIsShortIsReportedAndDoesNotOverflow) {
  const Workspace place;
  write_scene(place, "s.toml");
  for (const int kilobytes : {64, 256, 1024}) {
    const CommandResult result = run_shell(
        place, fmt::format("ulimit -s {}; '" LIMBER_COMMAND "' run s.toml",
                           kilobytes));
    EXPECT_EQ(result.status, kilobytes < 1024 ? 3 : 0) << result.errors;
    EXPECT_THAT(result.errors,
                HasSubstr(kilobytes < 1024 ? "stack (ulimit -s)" : ""));
  }
}

}  // namespace
}  // namespace limber::test::faults_test
