// The commands pack and inspect as people use them: options, sidecars, precedence, exit codes, what is left on the
// disk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/common/error.h"
#include "sim/common/files.h"
#include "tests/sim/pack/support.h"

namespace usuzumi {
namespace {

using ::testing::AllOf;
using testing::CommandResult;
using ::testing::ElementsAre;
using testing::GltfBuilder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::json;
using ::testing::Not;
using testing::run_usuzumi;
using testing::TempFolder;

/// Four meshes of a triangle each: body (level 1 by its node), wheel twice, glass (level 2 by its mesh).
std::string car(const TempFolder& folder) {
  GltfBuilder gltf;
  const int p = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const json primitive = {{"attributes", {{"POSITION", p}}}};
  const int body = gltf.mesh(primitive, "body"), wheel = gltf.mesh(primitive, "wheel"),
            glass = gltf.mesh(primitive, "glass");
  gltf.document["meshes"][2]["extras"] = {{"thinning_level", 2}};
  gltf.node({{"name", "Body"}, {"mesh", body}, {"extras", {{"thinning_level", 1}}}});
  gltf.node({{"name", "Front left"}, {"mesh", wheel}});
  gltf.node({{"name", "Front right"}, {"mesh", wheel}});
  gltf.node({{"name", "Glass"}, {"mesh", glass}});
  return folder.write("car.gltf", gltf.text());
}

json inspected(const std::string& rom) {
  const CommandResult result = run_usuzumi({"inspect", rom, "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out);
}

std::vector<int> levels(const std::string& rom) {
  std::vector<int> all;
  const json report = inspected(rom);
  for (const json& mesh : report["meshes"]) all.push_back(mesh["level"]);
  return all;
}

/// Runs pack into out.rom of `folder` and expects success.
std::string packed(const TempFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "pack");
  arguments.insert(arguments.end(), {"-o", folder / "out.rom"});
  const CommandResult result = run_usuzumi(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return folder / "out.rom";
}

/// Expects failure with `code`, one error line, no ROM and nothing left over. Returns the line.
std::string refused(const TempFolder& folder, std::vector<std::string> arguments, int code) {
  const std::vector<std::string> before = folder.files();
  arguments.insert(arguments.begin(), "pack");
  arguments.insert(arguments.end(), {"-o", folder / "out.rom"});
  const CommandResult result = run_usuzumi(arguments);
  EXPECT_EQ(result.exit_code, code) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_THAT(result.err, ::testing::StartsWith("usuzumi: "));
  EXPECT_EQ(folder.files(), before);
  return result.err;
}

TEST(PackCommand, TakesLevelsFromExtrasNodeOverMesh) {
  TempFolder folder;
  EXPECT_THAT(levels(packed(folder, {car(folder)})), ElementsAre(1, 0, 0, 2));
}

TEST(PackCommand, OptionsWinOverSidecarOverExtrasOverDefault) {
  TempFolder folder;
  const std::string model = car(folder);
  const std::string sidecar =
      folder.write("s.json", R"({"meshes": {"*": {"thinning_level": 4}, "body": {"thinning_level": 5}}})");
  EXPECT_THAT(levels(packed(folder, {model, "--default-level", "3"})), ElementsAre(1, 3, 3, 2));
  EXPECT_THAT(levels(packed(folder, {model, "--sidecar", sidecar, "--default-level", "3"})), ElementsAre(5, 4, 4, 4));
  EXPECT_THAT(levels(packed(folder, {model, "--sidecar", sidecar, "--level", "wheel#2=3"})), ElementsAre(5, 4, 3, 4));
}

TEST(PackCommand, LaterRulesOfOnePlaceWin) {
  TempFolder folder;
  const std::string model = car(folder);
  EXPECT_THAT(levels(packed(folder, {model, "--level", "*=3", "--level", "body=1"})), ElementsAre(1, 3, 3, 3));
  EXPECT_THAT(levels(packed(folder, {model, "--level", "body=1", "--level", "*=3"})), ElementsAre(3, 3, 3, 3));
}

TEST(PackCommand, PatternsMeanMeshNamesUniqueNamesAndNodeNames) {
  TempFolder folder;
  const std::string model = car(folder);
  EXPECT_THAT(levels(packed(folder, {model, "--level", "wheel=3"})), ElementsAre(1, 3, 3, 2));
  EXPECT_THAT(levels(packed(folder, {model, "--level", "wheel#?=3"})), ElementsAre(1, 0, 3, 2));
  EXPECT_THAT(levels(packed(folder, {model, "--level", "wheel#1=3"})), ElementsAre(1, 3, 0, 2));
  EXPECT_THAT(levels(packed(folder, {model, "--level", "Front left=3"})), ElementsAre(1, 3, 0, 2));
}

TEST(PackCommand, WritesQuotasAreasAndTelltales) {
  TempFolder folder;
  const std::string rom = packed(folder, {car(folder), "--level", "wheel=3", "--quota", "wheel=12.5%", "--quota",
                                          "wheel#2=7", "--area", "wheel=400.5", "--telltale", "gl*"});
  const json meshes = inspected(rom)["meshes"];
  EXPECT_EQ(meshes[1]["face_quota"], "12.5%");
  EXPECT_EQ(meshes[2]["face_quota"], 7);
  EXPECT_EQ(meshes[1]["area_threshold_px"], 400.5);
  EXPECT_EQ(meshes[0]["face_quota"], nullptr);
  EXPECT_EQ(meshes[3]["telltale"], true);
  EXPECT_EQ(meshes[0]["telltale"], false);
}

TEST(PackCommand, OptionThatFitsNoMeshIsAnErrorWithCloseNames) {
  TempFolder folder;
  const std::string model = car(folder);
  for (const char* option : {"--level", "--quota", "--area"})
    EXPECT_THAT(refused(folder, {model, option, "weel=3"}, 2),
                AllOf(HasSubstr("weel"), HasSubstr("did you mean wheel")))
        << option;
  EXPECT_THAT(refused(folder, {model, "--telltale", "Gla"}, 2), HasSubstr("Glass"));
  EXPECT_THAT(
      refused(folder, {model, "--sidecar", folder.write("s.json", R"({"meshes": {"weel": {"thinning_level": 3}}})")},
              3),
      HasSubstr("did you mean wheel"));
}

TEST(PackCommand, BadOptionValuesAreUsageErrors) {
  TempFolder folder;
  const std::string model = car(folder);
  for (const char* level : {"wheel", "=3", "wheel=6", "wheel=-1", "wheel=x", "wheel="})
    refused(folder, {model, "--level", level}, 2);
  for (const char* quota : {"wheel=0", "wheel=101%", "wheel=a%"}) refused(folder, {model, "--quota", quota}, 2);
  for (const char* area : {"wheel=-1", "wheel=nan", "wheel=inf", "wheel=1e999"})
    refused(folder, {model, "--area", area}, 2);
  EXPECT_EQ(run_usuzumi({"pack", model, "-o", folder / "out.rom", "--default-level", "6"}).exit_code, 2);
  for (const char* seconds : {"0", "-18446744073709551615", "86401"})
    EXPECT_EQ(run_usuzumi({"pack", model, "-o", folder / "out.rom", "--time-limit", seconds}).exit_code, 2) << seconds;
  EXPECT_EQ(run_usuzumi({"pack", model, "-o", folder / "out.rom", "--no-such-option"}).exit_code, 2);
  EXPECT_EQ(run_usuzumi({"pack", model}).exit_code, 2);
}

TEST(PackCommand, BadSidecarsAreRefusedByTheirFault) {
  TempFolder folder;
  const std::string model = car(folder);
  const std::vector<std::pair<const char*, const char*>> cases{
      {"{", "not JSON"},
      {"[]", "a sidecar is"},
      {R"({"mesh": {}})", "a sidecar is"},
      {R"({"meshes": {}, "colour": 1})", "\"colour\""},
      {R"({"meshes": {}})", "names no mesh"},
      {R"({"meshes": {"wheel": {}}})", "meshes.wheel gives no property"},
      {R"({"meshes": {"wheel": {"area_threshold_px": 1e999}}})", "too large"},
      {R"({"meshes": {"wheel": 3}})", "meshes.wheel"},
      {R"({"meshes": {"wheel": {"thining_level": 3}}})", "did you mean thinning_level"},
      {R"({"meshes": {"wheel": {"thinning_level": 9}}})", "not 9"},
      {R"({"meshes": {"wheel": {"face_quota": null}}})", "face_quota"},
      {R"({"meshes": {"wheel": {"thinning_level": 3}, "wheel": {"thinning_level": 1}}})", "twice"},
  };
  for (const auto& [text, fault] : cases)
    EXPECT_THAT(refused(folder, {model, "--sidecar", folder.write("s.json", text)}, 3), HasSubstr(fault)) << text;
  refused(folder, {model, "--sidecar", folder / "nowhere.json"}, 3);
}

TEST(PackCommand, SaysWhenNoMeshHasALevelAndNamesBlendersOption) {
  TempFolder folder;
  const std::string model = folder.write("a.gltf", testing::one_triangle().text());
  EXPECT_THAT(run_usuzumi({"pack", model, "-o", folder / "out.rom"}).err,
              HasSubstr("Export glTF > Include > Data > Custom Properties"));
  EXPECT_THAT(run_usuzumi({"pack", model, "-o", folder / "out.rom", "--default-level", "1"}).err,
              Not(HasSubstr("Blender")));
}

TEST(PackCommand, SaysWhenTheDefaultLevelIsNobodys) {
  TempFolder folder;
  const auto notes = [&](const char* level) {
    return run_usuzumi({"pack", car(folder), "-o", folder / "out.rom", "--level", level, "--default-level", "2"}).err;
  };
  EXPECT_EQ(notes("*=3"), "note: --default-level 2 has no effect: every mesh has a level already\n");
  EXPECT_EQ(notes("wheel#2=3"), "");
}

TEST(PackCommand, SaysWhatALevelDoesNotUse) {
  TempFolder folder;
  const CommandResult result =
      run_usuzumi({"pack", car(folder), "-o", folder / "out.rom", "--quota", "body=5", "--area", "body=5"});
  EXPECT_THAT(result.err, AllOf(HasSubstr("mesh 'body': face_quota"), HasSubstr("mesh 'body': area_threshold_px")));
}

TEST(PackCommand, BareKeepsLevelsSaysWhatIsLostAndRefusesWhatItCannotKeep) {
  TempFolder folder;
  const std::string model = car(folder);
  const CommandResult result = run_usuzumi({"pack", model, "-o", folder / "out.rom", "--bare", "--level", "wheel=3"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("names, normals, colours and sidedness are lost"));
  EXPECT_THAT(levels(folder / "out.rom"), ElementsAre(1, 3, 3, 2));
  EXPECT_EQ(inspected(folder / "out.rom")["format"], "bare");
  std::filesystem::remove(folder / "out.rom");
  EXPECT_THAT(refused(folder, {model, "--bare", "--quota", "wheel=25%"}, 2), HasSubstr("--bare"));
  EXPECT_THAT(refused(folder, {model, "--bare", "--area", "wheel=25"}, 2), HasSubstr("--bare"));
  EXPECT_THAT(refused(folder, {model, "--bare", "--telltale", "wheel"}, 2), HasSubstr("--bare"));
  refused(folder,
          {model, "--bare", "--sidecar", folder.write("s.json", R"({"meshes": {"wheel": {"telltale": true}}})")}, 3);
}

TEST(PackCommand, JoinsSeveralInputsAlsoAfterAnOption) {
  TempFolder folder;
  const std::string model = car(folder);
  const CommandResult result =
      run_usuzumi({"pack", "--level", "body=3", model, "--telltale", "glass", model, "-o", folder / "out.rom"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(levels(folder / "out.rom"), ElementsAre(3, 0, 0, 2, 3, 0, 0, 2));
}

TEST(PackCommand, SameInputGivesTheSameBytes) {
  TempFolder folder;
  const std::string model = car(folder);
  const auto first = testing::bytes_of_file(packed(folder, {model}));
  EXPECT_EQ(testing::bytes_of_file(packed(folder, {model})), first);
}

TEST(PackCommand, UnwritableOutputIsExitCodeFourAndLeavesNothing) {
  TempFolder folder;
  const std::string model = car(folder);
  EXPECT_EQ(run_usuzumi({"pack", model, "-o", folder / "no/such/folder/out.rom"}).exit_code, 4);
  EXPECT_EQ(run_usuzumi({"pack", model, "-o", folder.path().string()}).exit_code, 4);
  EXPECT_EQ(run_usuzumi({"pack", model, "-o", "/dev/full"}).exit_code, 4);
  EXPECT_THAT(folder.files(), ElementsAre("car.gltf"));
}

TEST(PackCommand, FailureLeavesTheOldRomAsItWas) {
  TempFolder folder;
  folder.write("out.rom", "precious");
  const CommandResult result =
      run_usuzumi({"pack", folder.write("bad.obj", "v 0 0\nf 1 2 3\n"), "-o", folder / "out.rom"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(testing::bytes_of_file(folder / "out.rom").size(), 8u);
  EXPECT_THAT(folder.files(), ElementsAre("bad.obj", "out.rom"));
}

TEST(PackCommand, RefusesToWriteOverItsInput) {
  TempFolder folder;
  const std::string model = car(folder);
  const auto before = testing::bytes_of_file(model);
  EXPECT_EQ(run_usuzumi({"pack", model, "-o", model}).exit_code, 2);
  EXPECT_EQ(testing::bytes_of_file(model), before);
  const std::string sidecar = folder.write("s.json", R"({"meshes": {"wheel": {"thinning_level": 3}}})");
  EXPECT_EQ(run_usuzumi({"pack", model, "--sidecar", sidecar, "-o", sidecar}).exit_code, 2);
}

TEST(PackCommand, RefusesToWriteOverABufferOfItsModel) {
  TempFolder folder;
  GltfBuilder gltf = testing::one_triangle();
  gltf.document["buffers"] = json::array({{{"byteLength", 36}, {"uri", "a%20plate.bin"}}});
  const std::string model = folder.write("plate.gltf", gltf.text());
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string buffer = folder.write("a plate.bin", {reinterpret_cast<const char*>(corners), sizeof corners});
  EXPECT_THAT(run_usuzumi({"pack", model, "-o", buffer}).err, HasSubstr("is an input as well"));
  EXPECT_EQ(testing::bytes_of_file(buffer).size(), 36u);
}

TEST(PackCommand, HelpHasAnExample) {
  for (const char* command : {"pack", "inspect"}) {
    const CommandResult result = run_usuzumi({command, "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, HasSubstr(std::string("usuzumi ") + command));
    EXPECT_THAT(result.out, HasSubstr("Example"));
  }
}

TEST(InspectCommand, ShowsEveryMeshInATableAndInJson) {
  TempFolder folder;
  const std::string rom = packed(folder, {car(folder), "--level", "wheel=3", "--quota", "wheel=25%"});
  const CommandResult table = run_usuzumi({"inspect", rom});
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_THAT(table.out, AllOf(HasSubstr("container version 1.1"), HasSubstr("4 meshes"), HasSubstr("sound"),
                               HasSubstr("wheel#2"), HasSubstr("3 collapse"), HasSubstr("25%")));
  const json all = inspected(rom);
  EXPECT_EQ(all["sound"], true);
  EXPECT_EQ(all["bytes"], testing::bytes_of_file(rom).size());
  EXPECT_EQ(all["mesh_max"], 4);
  EXPECT_EQ(all["faces"], 4);
  const json& wheel = all["meshes"][1];
  EXPECT_EQ(wheel["number"], 2);
  EXPECT_EQ(wheel["name"], "wheel");
  EXPECT_EQ(wheel["topology"], "indexed");
  EXPECT_EQ(wheel["vertices"], 3);
  EXPECT_EQ(wheel["normals"], true);
  EXPECT_EQ(wheel["vertex_colours"], false);
  EXPECT_EQ(wheel["base_colour"], "#ffffff");
  EXPECT_EQ(wheel["bounding_box"]["max"], json::parse("[1.0, 1.0, 0.0]"));
}

TEST(InspectCommand, DamagedRomIsExitCodeThreeWithTheOffset) {
  TempFolder folder;
  const std::string rom = packed(folder, {car(folder)});
  auto bytes = testing::bytes_of_file(rom);
  bytes[100] ^= std::byte{1};
  const std::string bad = folder.write("bad.rom", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const CommandResult plain = run_usuzumi({"inspect", bad});
  EXPECT_EQ(plain.exit_code, 3);
  EXPECT_THAT(plain.err, AllOf(HasSubstr("bad.rom"), HasSubstr("CRC-32"), HasSubstr("20")));
  const CommandResult scripted = run_usuzumi({"inspect", bad, "--json"});
  EXPECT_EQ(scripted.exit_code, 3);
  EXPECT_EQ(json::parse(scripted.out)["sound"], false);
  EXPECT_EQ(json::parse(scripted.out)["offset"], 20);
  EXPECT_EQ(run_usuzumi({"inspect", folder / "nowhere.rom"}).exit_code, 3);
  EXPECT_EQ(run_usuzumi({"inspect", folder.write("empty.rom", "")}).exit_code, 3);
}

TEST(Files, AreReplacedWholeAndKeepOrdinaryPermissions) {
  TempFolder folder;
  const mode_t mask = ::umask(022);
  sim::write_file_atomically(folder / "a", "old");
  sim::write_file_atomically(folder / "a", "new text");
  ::umask(mask);
  EXPECT_EQ(testing::bytes_of_file(folder / "a").size(), 8u);
  struct stat info {};
  ASSERT_EQ(::stat((folder / "a").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0644u);
  EXPECT_THAT(folder.files(), ElementsAre("a"));
}

TEST(Files, SymbolicLinksKeepPointing) {
  TempFolder folder;
  folder.write("real", "old");
  std::filesystem::create_symlink("real", folder.path() / "link");
  sim::write_file_atomically(folder / "link", "new!");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_EQ(testing::bytes_of_file(folder / "real").size(), 4u);
}

TEST(Files, AboveTheirBoundAreRefusedBeforeTheyAreRead) {
  TempFolder folder;
  const std::string path = folder.write("big", "x");
  ASSERT_EQ(::truncate(path.c_str(), off_t{1} << 40), 0);  // sparse: takes no room
  EXPECT_THROW(sim::read_file(path), sim::Error);
}

}  // namespace
}  // namespace usuzumi
