// The program used badly: every fault of a user or a file ends with exit status 2 and a message that says where,
// what was expected and what to do; nothing outside --out is touched, and nothing is a crash.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/mesh_files.h"
#include "tests/tools/process.h"

namespace argil::tests {
namespace {

using testing::HasSubstr;

struct BadCall {
  std::string name;
  std::vector<std::string> arguments;
  std::vector<std::string> says;  // parts of the message
};

void PrintTo(const BadCall& call, std::ostream* out) {
  *out << "argil";
  for (const std::string& argument : call.arguments) *out << " '" << argument << "'";
}

class Misuse : public testing::TestWithParam<BadCall> {};

TEST_P(Misuse, EndsWithStatusTwoAndAMessage) {
  const TemporaryFolder folder;
  folder.write("box.mesh", cube_grid(2, 2, 2));
  folder.write("cut.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 ");
  folder.write("session.argil", "argil 1\nnew box\nlevels 1\nsave box.obj\n");
  folder.write("unclosed.argil", "argil 1\nnew box\nsave \"a.obj\n");
  folder.write("binary", std::string("\x7f"
                                     "ELF\0\xff\xfe",
                                     7));
  folder.write("empty", "");
  folder.write("a.trace", "3 new 0 40f8bffcbeb94af5\n4 step 1 61f2ccba404e7d90\n");
  folder.write("bad.trace", "3 new 0 40f8bffcbeb94af5\n4 step one 61f2ccba404e7d90\n");
  folder.write("folder/journal.argil", "argil 1\nnew box\n");
  const auto before = folder.files();
  const Finished finished = run_argil(GetParam().arguments, folder.path());
  EXPECT_EQ(finished.status, 2) << finished.out << finished.err;
  EXPECT_THAT(finished.err, testing::StartsWith("argil"));
  EXPECT_THAT(finished.err, testing::EndsWith("\n"));
  for (const std::string& part : GetParam().says) EXPECT_THAT(finished.err, HasSubstr(part));
  EXPECT_EQ(folder.files(), before);
}

const BadCall k_calls[] = {
    // How the program is called.
    {"NoSession", {"studio", "no/such.argil"}, {"no file", "leave it out"}},
    {"UnknownSubcommand",
     {"replai", "session.argil"},
     {"'replai' is not a subcommand", "`replay`", "`argil --help`"}},
    {"UnknownOption", {"info", "box.mesh", "--jason"}, {"--jason", "`argil info --help`"}},
    {"MissingArgument", {"convert", "box.mesh"}, {"out is required", "`argil convert --help`"}},
    {"ThreadsNone", {"replay", "session.argil", "--threads", "0"}, {"--threads", "1 to 1024"}},
    {"ThreadsWord", {"replay", "session.argil", "--threads", "many"}, {"--threads", "many"}},
    {"UntilNone", {"replay", "session.argil", "--until", "0"}, {"--until"}},
    {"LevelsNegative", {"refine", "box.mesh", "o.vtu", "--levels", "-1"}, {"--levels", "0 to 8"}},
    {"SpaceUnknown",
     {"elements", "box.mesh", "--levels", "1", "--space", "quartic"},
     {"--space", "default", "cubic"}},
    {"HelpOfNoCommand", {"help", "strok"}, {"'strok' is not a command", "`stroke`"}},
    // Meshes.
    {"MeshMissing", {"info", "none.mesh"}, {"none.mesh", "no such file", "check the name"}},
    {"MeshCut", {"info", "cut.mesh"}, {"cut.mesh:4:"}},
    {"MeshIsAFolder", {"info", "folder"}, {"folder"}},
    {"MeshEnding", {"info", "a.trace"}, {"a.trace", ".mesh, .vtk, .vtu, .msh, .inp or .ovm"}},
    {"ConvertEnding",
     {"convert", "box.mesh", "o.xyz"},
     {"'o.xyz'", ".mesh, .vtk, .vtu, .msh, .inp or .ovm", ".obj"}},
    {"RefineEnding",
     {"refine", "box.mesh", "o", "--levels", "1"},
     {"'o'", ".mesh, .vtk, .vtu, .msh, .inp or .ovm", ".obj"}},
    {"ConvertToNoFolder", {"convert", "box.mesh", "none/o.vtu"}, {"none/o.vtu", "choose a folder"}},
    {"RefineIntoAFile", {"refine", "box.mesh", "empty/o.vtu", "--levels", "1"}, {"empty/o.vtu", "choose a folder"}},
    {"RefineTooFar", {"refine", "box.mesh", "o.vtu", "--levels", "8"}, {"134217728 cells", "--max-cells"}},
    {"RefineLimit",
     {"refine", "box.mesh", "o.vtu", "--levels", "1", "--max-cells", "63"},
     {"64 cells, more than 63", "--max-cells"}},
    {"ElementsTooMany", {"elements", "box.mesh", "--levels", "8"}, {"134217728 cells", "--max-cells"}},
    // Pictures.
    {"RenderEnding", {"render", "box.mesh", "p.jpg"}, {"p.jpg", ".png"}},
    {"RenderMissing", {"render", "none.mesh", "p.png"}, {"none.mesh", "no such file"}},
    {"RenderOption",
     {"render", "box.mesh", "p.png", "--with", "cagee"},
     {"--with:1:14", "'cagee' is not one of its arguments"}},
    {"RenderField", {"render", "box.mesh", "p.png", "--with", "field heat"}, {"field must be one of", "'heat'"}},
    {"RenderSize", {"render", "box.mesh", "p.png", "--with", "size 100"}, {"size wants 2 values"}},
    {"RenderSizeNone", {"render", "box.mesh", "p.png", "--with", "size 0 100"}, {"size"}},
    {"RenderTwoLines", {"render", "box.mesh", "p.png", "--with", "cage\nsave x.obj"}, {"control character"}},
    {"RenderTooFine",
     {"render", "box.mesh", "p.png", "--levels", "8"},
     {"--levels", "134217728 cells", "--max-cells"}},
    {"RenderLimit",
     {"render", "box.mesh", "p.png", "--levels", "1", "--max-cells", "63"},
     {"64 cells, more than 63"}},
    // Traces.
    {"TraceMissing", {"diff", "a.trace", "none"}, {"'none'", "--hash-trace"}},
    {"TraceIsAFolder", {"diff", "folder", "a.trace"}, {"'folder'", "--hash-trace"}},
    {"TraceIsASession", {"diff", "a.trace", "session.argil"}, {"session.argil:1:1", "--hash-trace"}},
    {"TraceDamaged", {"diff", "a.trace", "bad.trace"}, {"bad.trace:2:1", "--hash-trace"}},
    {"TraceBinary", {"diff", "binary", "a.trace"}, {"binary:1:1"}},
    {"TraceEmpty", {"diff", "empty", "empty"}, {"empty", "--hash-trace"}},
    // Sessions as files.
    {"SessionMissing", {"replay", "none.argil"}, {"none.argil", "no such file"}},
    {"SessionIsAFolder", {"replay", "folder"}, {"folder 'folder'", "name a file in it"}},
    {"SessionBinary", {"replay", "binary"}, {"binary:1:1"}},
    {"SessionEmpty", {"replay", "empty"}, {"empty:1:1", "`argil 1`"}},
    {"SessionIsAMesh", {"replay", "box.mesh"}, {"box.mesh:1:1", "`argil 1`"}},
    {"SessionUnclosedString", {"replay", "unclosed.argil"}, {"unclosed.argil:3:6", "closing"}},
    {"OutIsAFile", {"replay", "session.argil", "--out", "empty"}, {"'empty'", "--out"}},
    {"OutBeneathAFile", {"replay", "session.argil", "--out", "empty/out"}, {"'empty/out'", "--out"}},
    {"TraceOntoTheSession",
     {"replay", "session.argil", "--hash-trace", "session.argil"},
     {"overwritten", "--hash-trace"}},
    {"JournalOntoTheSession", {"replay", "folder/journal.argil", "--out", "folder"}, {"overwritten", "--out"}},
    {"TraceOntoAFolder",
     {"replay", "session.argil", "--out", "folder", "--hash-trace", "folder"},
     {"'folder'", "--hash-trace"}},
    // --set.
    {"SetWithoutValue", {"replay", "session.argil", "--set", "space"}, {"COMMAND=ARGUMENTS", "'space'"}},
    {"SetWithoutName", {"replay", "session.argil", "--set", "=cubic"}, {"COMMAND=ARGUMENTS"}},
    {"SetOfNoCommand",
     {"replay", "session.argil", "--set", "level=2"},
     {"--set level", "'level' is not a command", "`levels`"}},
    {"SetWithoutLine", {"replay", "session.argil", "--set", "gravity=0 0 -1"}, {"--set gravity", "no `gravity`"}},
    {"SetTwice", {"replay", "session.argil", "--set", "levels=1", "--set", "levels=2"}, {"--set levels", "twice"}},
};

INSTANTIATE_TEST_SUITE_P(Calls, Misuse, testing::ValuesIn(k_calls),
                         [](const testing::TestParamInfo<BadCall>& instance) { return instance.param.name; });

struct BadLine {
  std::string name, line;
  std::vector<std::string> says;
  std::vector<std::string> options{};
};

void PrintTo(const BadLine& bad, std::ostream* out) {
  *out << bad.line;
}

class BadLines : public testing::TestWithParam<BadLine> {};

TEST_P(BadLines, EndWithStatusTwoAtTheirPlaceAndLeaveNothingOutside) {
  const TemporaryFolder folder;
  folder.write("work/box.mesh", cube_grid(2, 2, 2));
  folder.write("work/cut.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 ");
  folder.write("work/bad.argil", "argil 1\nnew box 2 2 2\nlevels 1\n" + GetParam().line + "\n");
  folder.write("secret.mesh", cube_grid(1, 1, 1));
  folder.write("out/file", "");
  std::filesystem::create_symlink(folder.path(), folder / "out/link");
  std::filesystem::create_symlink(folder.path(), folder / "work/link");
  std::filesystem::create_symlink(folder / "new.obj", folder / "out/dangling.obj");
  auto expected = folder.files();
  std::vector<std::string> arguments{"replay", "work/bad.argil", "--out", "out", "--quiet"};
  arguments.insert(arguments.end(), GetParam().options.begin(), GetParam().options.end());
  const Finished finished = run_argil(arguments, folder.path());
  EXPECT_EQ(finished.status, 2) << finished.out << finished.err;
  EXPECT_THAT(finished.err, testing::StartsWith("argil: "));
  for (const std::string& part : GetParam().says) EXPECT_THAT(finished.err, HasSubstr(part));
  expected.emplace_back("out/journal.argil");
  EXPECT_THAT(folder.files(), testing::UnorderedElementsAreArray(expected));
  // The journal holds what went well, so that the work before the fault is not lost.
  EXPECT_EQ(read_bytes(folder / "out/journal.argil"), "argil 1\nnew box 2 2 2\nlevels 1\n");
}

const BadLine k_lines[] = {
    {"UnknownCommand", "strok", {"bad.argil:4:1: 'strok' is not a command", "`stroke`", "`argil help`"}},
    {"UnknownArgument", "extrude 1 stepz 2", {"bad.argil:4:11", "'stepz'", "steps"}},
    {"WordForNumber", "levels two", {"bad.argil:4:8"}},
    {"FractionForInteger", "levels 1.5", {"bad.argil:4:8"}},
    {"UnknownChoice", "space quartic", {"bad.argil:4:7", "default, cubic"}},
    {"NothingToCheck", "expect volume", {"bad.argil:4:1", "expect volume 0.03 within 1%"}},
    {"UnknownMeasure", "measure colour", {"bad.argil:4:9"}},
    {"UndoTooMany", "undo 5", {"bad.argil:4:1", "2 commands to undo, not 5"}},
    {"LevelsTooHigh", "levels 8", {"bad.argil:4:1", "134217728 cells", "--max-cells"}},
    {"BoxTooLarge", "new box 1000 1000 1000", {"bad.argil:4:1", "1000000000 cells", "--max-cells"}},
    {"TooManySteps", "step 3", {"bad.argil:4:1", "--max-steps"}, {"--max-steps", "2"}},
    {"SaveClimbs", "save ../x.obj", {"bad.argil:4:1", "'../x.obj' climbs out", "--out"}},
    {"SaveClimbsInside", "save a/../../x.obj", {"bad.argil:4:1", "climbs out"}},
    {"SaveAbsolute", "save /tmp/x.obj", {"bad.argil:4:1", "absolute path", "--out"}},
    {"SaveThroughALink", "save link/x.obj", {"bad.argil:4:1", "symbolic link", "--out"}},
    {"SaveThroughADanglingLink", "save dangling.obj", {"bad.argil:4:1", "link", "--out"}},
    {"SaveBeneathAFile", "save file/x.obj", {"bad.argil:4:1", "file/x.obj"}},
    {"SaveEnding", "save x.stp", {"bad.argil:4:1", ".vtu", "x.stp"}},
    {"RenderClimbs", "render ../x.png", {"bad.argil:4:1", "climbs out"}},
    {"RenderEnding", "render x.jpg", {"bad.argil:4:1", ".png"}},
    {"OpenClimbs", "open ../secret.mesh", {"bad.argil:4:1", "climbs out", "the session's own folder"}},
    {"OpenThroughALink", "open link/secret.mesh", {"bad.argil:4:1", "symbolic link"}},
    {"OpenMissing", "open none.mesh", {"no such file"}},
    {"OpenCut", "open cut.mesh", {"cut.mesh:4:"}},
};

INSTANTIATE_TEST_SUITE_P(Lines, BadLines, testing::ValuesIn(k_lines),
                         [](const testing::TestParamInfo<BadLine>& instance) { return instance.param.name; });

TEST(MisuseOfSpaces, AStrokeOnTrianglesAsksForALevel) {
  const TemporaryFolder folder;
  folder.write(
      "a.argil",
      "argil 1\nnew pyramid\nspace cubic\npin where z < 0.1\nstroke from 0.5 0.5 1 to 0.5 0.5 2 ticks 50\n");
  const Finished finished = run_argil({"replay", "a.argil", "--quiet"}, folder.path());
  EXPECT_EQ(finished.status, 2);
  EXPECT_THAT(finished.err, HasSubstr("a.argil:5:1"));
  EXPECT_THAT(finished.err, HasSubstr("levels 1"));
}

TEST(MisuseOfLinks, TheUsersOwnLinksAreFollowed) {
  const TemporaryFolder folder;
  folder.write("far/box.mesh", cube_grid(2, 2, 2));
  folder.write("near/note", "");
  std::filesystem::create_symlink(folder / "far/box.mesh", folder / "near/link.mesh");
  const Finished finished = run_argil({"render", "near/link.mesh", "p.png", "--with", "size 40 30"}, folder.path());
  EXPECT_EQ(finished.status, 0) << finished.err;
}

}  // namespace
}  // namespace argil::tests
