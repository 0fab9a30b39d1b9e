// SPDX-License-Identifier: BSD-3-Clause
// What every command understands: --quiet, --verbose, colours, completion,
// manual pages, and the cache.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::habits_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const char* const kScenario =
    "robot = '" LIMBER_SOURCE_DIR
    "/models/four_bar.urdf'\n[time]\nduration = 0.01\nstep = 1e-3\n"
    "output_interval = 0.01\n[[probe]]\nname = 'rod'\nlink = 'rod'\ninterface "
    "= 'tip'\n";

class SharedGlobalFlags : public ::testing::Test {
 protected:
  explicit SharedGlobalFlags(Cache cache = Cache::shared) : place_(cache) {
    place_.write("s.toml", kScenario);
  }

  [[nodiscard]] CommandResult shell(const std::string& line) const {
    return run_shell(place_, line);
  }

  Workspace place_;
};

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

TEST_F(SharedGlobalFlags, QuietPrintsNothingButWritesTheSameFiles) {
  ASSERT_EQ(place_.limber("run s.toml --out usual").status, 0);
  const CommandResult quiet = place_.limber("run s.toml --out quiet --quiet");
  EXPECT_EQ(quiet.status, 0);
  EXPECT_EQ(quiet.out, "");
  EXPECT_EQ(quiet.errors, "");
  EXPECT_EQ(read_text(place_.folder() / "quiet/probes.csv"),
            read_text(place_.folder() / "usual/probes.csv"));
}

TEST_F(SharedGlobalFlags, QuietStillPrintsWarningsErrorsAndJson) {
  place_.write("rigid.urdf",
               "<robot name='r'><link name='block'><inertial><mass "
               "value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
               "iyz='0'/></inertial></link></robot>");
  place_.write("w.toml",
               "robot = 'rigid.urdf'\n[time]\nduration = 0.01\nstep = 1e-3\n"
               "output_interval = 0.01\n");
  const CommandResult warned =
      place_.limber("run w.toml --fidelity coupled --out w --quiet");
  EXPECT_EQ(warned.status, 0);
  EXPECT_EQ(warned.out, "");
  EXPECT_THAT(warned.errors, HasSubstr("limber: warning: level 'coupled'"));
  const CommandResult wrong = place_.limber("run none.toml -q");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("limber: error: "));
  const CommandResult both = place_.limber("run s.toml -q -v");
  EXPECT_EQ(both.status, 2);
  const CommandResult quiet = place_.limber("run s.toml --out r -q --json");
  EXPECT_EQ(json::parse(quiet.out)["completed"], true);
  EXPECT_THAT(place_.limber("cache list -q").out, HasSubstr("body"));
}

TEST_F(SharedGlobalFlags, VerboseTellsTheBuildTheWorkAndItsCost) {
  const CommandResult result = place_.limber("run s.toml --out r --verbose");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(
      result.errors,
      AllOf(HasSubstr("limber: limber 0."), HasSubstr("LIMBER_REDUCTION"),
            HasSubstr(" s of processors, "), HasSubstr("MiB")));
}

TEST_F(SharedGlobalFlags, ColoursAreOnATerminalOnlyAndObeyNoColor) {
  if (!has_program("script")) GTEST_SKIP() << "needs script (bsdutils)";
  const std::string on =
      "script -qec \"'" LIMBER_COMMAND "' run none.toml\" /dev/null </dev/null";
  EXPECT_THAT(shell("TERM=xterm " + on).out,
              HasSubstr("\033[1;31merror:\033[0m"));
  EXPECT_THAT(shell("NO_COLOR=1 TERM=xterm " + on).out,
              AllOf(HasSubstr("limber: error:"), Not(HasSubstr("\033[1"))));
  EXPECT_THAT(shell("NO_COLOR= TERM=xterm " + on).out, HasSubstr("\033[1;31m"));
  EXPECT_THAT(shell("TERM=dumb " + on).out, Not(HasSubstr("\033[1")));
  EXPECT_THAT(place_.limber("run none.toml").errors, Not(HasSubstr("\033")));
}

TEST_F(SharedGlobalFlags, VersionTellsTheOptionsOfTheBuild) {
  const CommandResult result = place_.limber("--version");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("limber 0."), HasSubstr("build "),
                                HasSubstr("LIMBER_REDUCTION     ON")));
}

TEST_F(SharedGlobalFlags, HelpTellsWhereTheCacheIs) {
  EXPECT_THAT(place_.limber("--help").out,
              AllOf(HasSubstr("LIMBER_CACHE"), HasSubstr("NO_COLOR"),
                    HasSubstr("Exit status")));
  EXPECT_THAT(place_.limber("run --help").out, HasSubstr("LIMBER_CACHE"));
}

TEST_F(SharedGlobalFlags, EveryCommandHasAManualPageOfItsHelp) {
  ASSERT_EQ(shell("mkdir man && limber __manual man").status, 0);
  const CommandResult help = place_.limber("--help");
  const std::string page = read_text(place_.folder() / "man/limber.1");
  EXPECT_THAT(page,
              AllOf(HasSubstr(".SH SYNOPSIS"), HasSubstr("LIMBER_CACHE")));
  std::size_t pages = 0;
  for (const auto& entry : fs::directory_iterator(place_.folder() / "man")) {
    const std::string name = entry.path().stem();
    if (name == "limber") continue;
    ++pages;
    std::string command = name.substr(std::string("limber-").size());
    std::replace(command.begin(), command.end(), '-', ' ');
    EXPECT_EQ(place_.limber(command + " --help").status, 0) << command;
    EXPECT_THAT(read_text(entry.path()), HasSubstr("\\-\\-verbose"));
  }
  EXPECT_GE(pages, 16U);
  EXPECT_THAT(read_text(place_.folder() / "man/limber-cache-clean.1"),
              HasSubstr("\\-\\-older\\-than"));
  if (!has_program("man")) return;
  const CommandResult shown =
      shell("MANWIDTH=80 man --warnings ./man/limber-run.1");
  EXPECT_THAT(shown.out, HasSubstr("--checkpoint-interval"));
  EXPECT_EQ(shown.errors, "");
}

std::string complete(const Workspace& place, const std::string& words) {
  return place.limber("__complete " + words).out;
}

TEST_F(SharedGlobalFlags, CompletionKnowsCommandsOptionsAndLevels) {
  EXPECT_EQ(complete(place_, "stu"),
            "study\tRun a scenario many times with varied values, with all "
            "results in one table\n");
  EXPECT_THAT(complete(place_, "run s.toml --fi"), HasSubstr("--fidelity\t"));
  EXPECT_EQ(complete(place_, "run --fidelity c"), "coupled\t\n");
  EXPECT_EQ(complete(place_, "run --fidelity=c"), "--fidelity=coupled\t\n");
  EXPECT_EQ(complete(place_, "run --fidelity = c"), "coupled\t\n");
  EXPECT_EQ(complete(place_, "compare --fidelity rigid,f"), "rigid,full\t\n");
  EXPECT_EQ(complete(place_, "cache c"),
            "clean\tRemove bodies and meshes; other files stay\n");
  EXPECT_EQ(complete(place_, "run --out ''"), "");           // a folder
  EXPECT_EQ(complete(place_, "run s.toml --out x ''"), "");  // a file
  EXPECT_THAT(complete(place_, "verify --integrator runge"),
              HasSubstr("runge-kutta-4"));
  EXPECT_THAT(complete(place_, "''"),
              AllOf(HasSubstr("run\t"), HasSubstr("cache\t")));
}

TEST_F(SharedGlobalFlags, CompletionKnowsTheKeysOfTheScenario) {
  EXPECT_EQ(complete(place_, "run s.toml --set time.st"), "time.step\t\n");
  EXPECT_THAT(complete(place_, "run s.toml --set robot.li"),
              HasSubstr("robot.link."));
  EXPECT_EQ(complete(place_, "run none.toml --set time.st"), "");
  EXPECT_EQ(complete(place_, "run --set time.st"), "");
}

TEST_F(SharedGlobalFlags, UnknownCommandsAndOptionsNameTheNearest) {
  const auto refuse = [&](const std::string& arguments, const char* why,
                          const char* help) {
    const CommandResult result = place_.limber(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.errors, AllOf(HasSubstr(why), HasSubstr(help)));
  };
  refuse("rnu s.toml", "unknown command 'rnu'; did you mean 'run'?",
         "(see limber --help)");
  refuse("run s.toml --fidelty rigid",
         "unknown option '--fidelty'; did you mean '--fidelity'?",
         "(see limber run --help)");
  refuse("run --resum=yes s.toml",
         "unknown option '--resum'; did you mean '--resume'?",
         "(see limber run --help)");
  refuse("run --quite", "unknown option '--quite'; did you mean '--quiet'?",
         "(see limber run --help)");
  refuse("cache lst", "unknown command 'lst'; did you mean 'list'?",
         "(see limber cache --help)");
  refuse("--vresion", "unknown option '--vresion'; did you mean '--version'?",
         "(see limber --help)");
  refuse("", "subcommand", "(see limber --help)");
}

// limber as a command on the path, in a shell that has read our function.
std::string in_folder() {
  return "mkdir -p bin && ln -sf '" LIMBER_COMMAND
         "' bin/limber && unset -f limber && export PATH=$PWD/bin:$PATH && ";
}
const char* const kShells = LIMBER_SOURCE_DIR "/src/limber/app/shells/";

TEST_F(SharedGlobalFlags, BashCompletes) {
  place_.write("t.bash",
               std::string("source ") + kShells +
                   "limber.bash\n"
                   "try() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1));"
                   " _limber; echo \"${COMPREPLY[*]}\"; }\n"
                   "try limber run --resu\n"
                   "try limber run --fidelity = nonl\n"
                   "try limber run --fidelity =\n"
                   "complete -p limber\n");
  const CommandResult result = shell(in_folder() + "bash t.bash");
  EXPECT_THAT(result.out,
              AllOf(::testing::StartsWith("--resume\nnonlinear\nrigid "),
                    HasSubstr("-F _limber limber")));
}

TEST_F(SharedGlobalFlags, FishCompletes) {
  if (!has_program("fish")) GTEST_SKIP() << "needs fish";
  const CommandResult result =
      shell(in_folder() + "HOME=$PWD fish -N -c 'source " + kShells +
            "limber.fish; complete -C \"limber run --resu\"; complete -C "
            "\"limber cache l\"'");
  EXPECT_THAT(result.out, AllOf(HasSubstr("--resume\tContinue from"),
                                HasSubstr("list\tBodies and meshes")));
}

TEST_F(SharedGlobalFlags, ZshCompletes) {
  if (!has_program("zsh")) GTEST_SKIP() << "needs zsh";
  // A prompt, so that the line is edited when the tabulator comes.
  place_.write("t.zsh",
               std::string("zmodload zsh/zpty\nzpty z zsh -f -i\n"
                           "zpty -w z \"fpath=(") +
                   kShells +
                   " \\$fpath); autoload -U compinit; compinit -u -D; "
                   "PS1=re''ady\"\n"
                   "zpty -r -m z line '*ready*'\n"
                   "zpty -w -n z $'limber run --resu\\t#end\\n'\n"
                   "zpty -r -m z line '*end*'; print -r -- \"$line\"\n");
  const CommandResult result = shell(in_folder() + "timeout 60 zsh -f t.zsh");
  EXPECT_THAT(result.out, HasSubstr("limber run --resume"));
}

class TheCache : public SharedGlobalFlags {
 protected:
  TheCache() : SharedGlobalFlags(Cache::own) {}
  void SetUp() override {
    ASSERT_EQ(place_.limber("run s.toml --out r").status, 0);
  }
  [[nodiscard]] json list() const {
    return json::parse(place_.limber("cache list --json").out);
  }
  [[nodiscard]] fs::path folder() const { return place_.cache(); }
  void make_older(const fs::path& file, int hours) const {
    fs::last_write_time(
        file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }
};

TEST_F(TheCache, ListsBodiesWithSizeAgeAndMesh) {
  const json items = list()["items"];
  ASSERT_EQ(items.size(), 2U);
  for (const json& item : items) {
    EXPECT_THAT(item["mesh"].get<std::string>(),
                ::testing::EndsWith("meshes/rod.geo"));
    EXPECT_GT(item["bytes"], 0);
    EXPECT_LT(item["age"], 600);
    if (item["kind"] != "body") continue;
    EXPECT_EQ(item["body"], "rod");
    EXPECT_GT(item["nodes"], 0);
    EXPECT_GT(item["modes"], 0);
  }
  EXPECT_THAT(
      place_.limber("cache list").out,
      AllOf(HasSubstr("rod"), HasSubstr("rod.geo"), HasSubstr("2 entries")));
  EXPECT_EQ(place_.limber("cache list --cache none").out,
            "0 entries, 0 B in none\n");
}

TEST_F(TheCache, IsUsedAgainByARunWhichMakesItsEntriesYoung) {
  for (const auto& entry : fs::directory_iterator(folder())) {
    make_older(entry.path(), 100);
  }
  for (const json& item : list()["items"]) EXPECT_GT(item["age"], 99 * 3600);
  ASSERT_EQ(place_.limber("run s.toml --out r").status, 0);
  for (const json& item : list()["items"]) EXPECT_LT(item["age"], 600);
}

TEST_F(TheCache, IsCleanedOfWhatIsOursAlone) {
  const std::string key(32, 'a');
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder() / name) << text;
  };
  write("notes.txt", "mine");
  write("results.h5", "mine");
  write(key + ".h5", "not a body");
  write(key + ".mesh", "not a record");
  fs::create_directory(folder() / (std::string(32, 'b') + ".h5"));
  fs::create_symlink("/etc/hostname",
                     folder() / (std::string(32, 'c') + ".h5"));
  write(key + ".h5.part-1-abcdef", "being written by a process that lives");
  const json before = list();
  EXPECT_EQ(before["others"], 7);
  ASSERT_EQ(before["items"].size(), 2U);
  const CommandResult dry = place_.limber("cache clean --all --dry-run");
  EXPECT_THAT(dry.out, HasSubstr("would be removed"));
  EXPECT_EQ(list()["items"].size(), 2U);
  const CommandResult result = place_.limber("cache clean --all");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.out, HasSubstr("7 files that are not of a cache"));
  std::size_t left = 0;
  for (const auto& entry : fs::directory_iterator(folder())) {
    (void)entry;
    ++left;
  }
  EXPECT_EQ(left, 7U);
}

TEST_F(TheCache, IsCleanedByAgeAndBySize) {
  for (const auto& entry : fs::directory_iterator(folder())) {
    if (entry.path().extension() == ".h5") make_older(entry.path(), 49);
  }
  (void)place_.limber("cache clean --older-than 3d");
  EXPECT_EQ(list()["items"].size(), 2U);
  (void)place_.limber("cache clean --keep 1GB");
  EXPECT_EQ(list()["items"].size(), 2U);
  (void)place_.limber("cache clean --older-than 2d");
  ASSERT_EQ(list()["items"].size(), 1U);
  EXPECT_EQ(list()["items"][0]["kind"], "mesh");
  (void)place_.limber("cache clean --keep 0B");
  EXPECT_EQ(list()["items"].size(), 0U);
}

TEST_F(TheCache, TellsOfDamagedBodiesAndRemovesThem) {
  for (const auto& entry : fs::directory_iterator(folder())) {
    if (entry.path().extension() != ".h5") continue;
    fs::resize_file(entry.path(), 3000);
  }
  EXPECT_THAT(place_.limber("cache list").out, HasSubstr("(damaged)"));
  (void)place_.limber("cache clean --all");
  EXPECT_EQ(list()["items"].size(), 0U);
}

TEST_F(TheCache, IsNotCleanedWhileAnotherProcessHoldsIt) {
  const CommandResult result =
      shell("exec 9>cache/.limber-lock && flock 9 && limber cache clean --all");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("is in use by another process"));
  EXPECT_EQ(list()["items"].size(), 2U);
}

TEST_F(TheCache, AsksWhatToClean) {
  for (const char* options : {"", "--all --keep 1GB", "--older-than 3",
                              "--older-than d", "--keep 5XB", "--keep -1GB"}) {
    const CommandResult result =
        place_.limber(std::string("cache clean ") + options);
    EXPECT_EQ(result.status, 2) << options;
    EXPECT_THAT(result.errors, HasSubstr("limber: error: ")) << options;
  }
  EXPECT_EQ(list()["items"].size(), 2U);
}

}  // namespace
}  // namespace limber::test::habits_test
