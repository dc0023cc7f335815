#include <map>
#include <set>

#include "tests/sim/cli/command.h"

namespace usuzumi {
namespace {

using testing::expect_one_line_error;
using testing::Ran;

class RunCommand : public testing::CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    write_hills("hills.obj", 20);
    ASSERT_EQ(usuzumi("pack hills.obj -o hills.rom --default-level 3").exit_code, 0);
  }
  nlohmann::json stats(const std::string& options) {
    const Ran ran = usuzumi("run hills.rom --size 160x96 --stats stats.json " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return json_file("stats.json");
  }
};

TEST_F(RunCommand, WritesAPictureAndStatisticsOfEveryFrame) {
  const auto report = stats("--frames 3 --orbit --out pictures");
  ASSERT_EQ(report["frames"].size(), 3u);
  std::set<std::string> crcs;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& f = report["frames"][i];
    EXPECT_TRUE(exists("pictures/frame-000" + std::to_string(i) + ".png"));
    EXPECT_EQ(f["meshes_in"], 1);
    EXPECT_EQ(f["meshes_out"], 1);
    EXPECT_EQ(f["faces_in"], 800);
    EXPECT_EQ(f["faces_thinned"], 400) << "half, where nobody gives a quota";
    EXPECT_LE(f["faces_drawn"].get<int>(), 400);
    EXPECT_GT(f["faces_drawn"].get<int>(), 0);
    EXPECT_GT(f["engine_cycles"].get<int>(), 0);
    EXPECT_GT(f["draw_ms"].get<double>(), 0);
    EXPECT_NEAR(f["scanout_ms"].get<double>(), 1000.0 / 60, 0.5);
    EXPECT_EQ(f["thinning"]["meshes_collapsed"], i == 0 ? 1 : 0) << "what nothing changed is not thinned again";
    crcs.insert(f["crc32"].get<std::string>());
  }
  EXPECT_GT(report["frames"][0]["thin_ms"].get<double>(), report["frames"][1]["thin_ms"].get<double>());
  EXPECT_EQ(crcs.size(), 3u) << "the model turns";
  EXPECT_GT(report["ram_peak_bytes"].get<int>(), 0);
  EXPECT_EQ(report["rom_bytes"], std::filesystem::file_size(folder() / "hills.rom"));
  EXPECT_EQ(report["vram_bytes"], 160 * 96 * 4 * 3) << "two pictures and depth";
}

TEST_F(RunCommand, ShowsTheSamePictureForAnyNumberOfThreadsAndAtEveryRun) {
  const auto once = stats("--frames 2 --orbit");
  for (const char* options :
       {"--frames 2 --orbit", "--frames 2 --orbit --threads 2", "--frames 2 --orbit --threads 3"}) {
    const auto again = stats(options);
    for (std::size_t i = 0; i < 2; ++i)
      for (const char* key : {"crc32", "engine_cycles", "thin_ms", "draw_ms", "scanout_ms", "faces_drawn"})
        EXPECT_EQ(again["frames"][i][key], once["frames"][i][key]) << options << " " << key;
  }
}

TEST_F(RunCommand, TheFirstFrameOfTwoRunsIsTheSamePng) {
  ASSERT_EQ(usuzumi("run hills.rom --size 160x96 --out a").exit_code, 0);
  ASSERT_EQ(usuzumi("run hills.rom --size 160x96 --out b").exit_code, 0);
  EXPECT_EQ(usuzumi("compare a/frame-0000.png b/frame-0000.png").exit_code, 0);
  ASSERT_EQ(usuzumi("run hills.rom --size 160x96 --thin off --out c").exit_code, 0);
  EXPECT_EQ(usuzumi("compare a/frame-0000.png c/frame-0000.png").exit_code, 1);
}

TEST_F(RunCommand, OsmesaDrawsNearlyTheSame) {
  ASSERT_EQ(usuzumi("run hills.rom --size 160x96 --out soft").exit_code, 0);
  ASSERT_EQ(usuzumi("run hills.rom --size 160x96 --engine osmesa --out osmesa").exit_code, 0);
  const Ran ran = usuzumi("compare soft/frame-0000.png osmesa/frame-0000.png --max-diff 2 --max-pixels 20");
  EXPECT_EQ(ran.exit_code, 0) << ran.out;
}

TEST_F(RunCommand, QuotasAndPoliciesRule) {
  EXPECT_EQ(stats("--thin off")["frames"][0]["faces_thinned"], 800);
  EXPECT_LE(stats("--quota 10%")["frames"][0]["faces_thinned"].get<int>(), 80);
  EXPECT_LE(stats("--quota 123")["frames"][0]["faces_thinned"].get<int>(), 123);
  EXPECT_EQ(stats("--policy below-area:1")["frames"][0]["faces_thinned"], 800);
  EXPECT_EQ(stats("--policy 3=chosen:hills")["frames"][0]["faces_thinned"], 400);
  EXPECT_EQ(stats("--policy random:1%")["frames"][0]["faces_thinned"], 800);
  EXPECT_EQ(usuzumi("run --policy always hills.rom --size 160x96").exit_code, 0) << "a ROM may follow a policy";
}

TEST_F(RunCommand, StatisticsSayWhyAMeshIsKept) {
  const auto only = [&](const std::string& options, const std::string& expected) {
    const auto report = stats("--frames 2 " + options);
    for (const std::size_t frame : {0u, 1u}) {
      const auto& decisions = report["frames"][frame]["thinning"]["decisions"];
      EXPECT_EQ(decisions.size(), 10u);
      for (const auto& [key, count] : decisions.items()) EXPECT_EQ(count, key == expected ? 1 : 0) << options << key;
    }
  };
  only("", "collapsed");
  only("--thin off", "kept_thinning_off");
  only("--policy below-area:1", "kept_above_area");
  only("--policy random:1%", "kept_not_chosen");
  for (const auto& [level, expected] : std::map<int, std::string>{
           {0, "kept_level_unset"}, {1, "kept_by_level"}, {2, "deleted"}, {4, "points"}, {5, "lines"}}) {
    ASSERT_EQ(usuzumi("pack hills.obj -o hills.rom --default-level " + std::to_string(level)).exit_code, 0);
    only("", expected);
  }
  ASSERT_EQ(usuzumi("pack hills.obj -o hills.rom --default-level 2 --telltale hills").exit_code, 0);
  only("", "kept_telltale");
}

TEST_F(RunCommand, BareDrawingDataThinsToTheSameCount) {
  const Ran packed = usuzumi("pack hills.obj -o bare.rom --bare --default-level 3");
  ASSERT_EQ(packed.exit_code, 0) << packed.err;
  ASSERT_EQ(usuzumi("run bare.rom --size 160x96 --stats stats.json").exit_code, 0);
  const auto frame = json_file("stats.json")["frames"][0];
  EXPECT_EQ(frame["faces_in"], 800);
  EXPECT_EQ(frame["faces_thinned"], 400);
  // What pack says is in the ROM is what inspect finds there.
  const auto inspected = usuzumi("inspect bare.rom --json").json();
  EXPECT_EQ(inspected["faces"], 800);
  EXPECT_GT(inspected["vertices"], 441) << "a strip of more than one run repeats vertices";
  const std::string counts = ", " + inspected["vertices"].dump() + " vertices, 800 faces";
  EXPECT_NE(packed.out.find(counts), std::string::npos) << packed.out;
}

TEST_F(RunCommand, TakesCamerasFromAFile) {
  write("path.json", R"({"frames": [{"eye": [10, 30, 40], "target": [10, 0, 10]},
                                  {"eye": [10, 40, 40], "target": [10, 0, 10], "fov_y_deg": 60}]})");
  const auto report = stats("--frames 3 --camera path.json");
  EXPECT_NE(report["frames"][0]["crc32"], report["frames"][1]["crc32"]);
  EXPECT_EQ(report["frames"][1]["crc32"], report["frames"][2]["crc32"]) << "the last camera holds on";
}

TEST_F(RunCommand, RunsOnTheSmallBoardAtItsPanelsSize) {
  ASSERT_EQ(usuzumi("run hills.rom --board small --stats stats.json").exit_code, 0);
  const auto report = json_file("stats.json");
  EXPECT_EQ(report["width"], 480);
  EXPECT_EQ(report["height"], 272);
  EXPECT_LE(report["vram_bytes"].get<int>(), 1 << 20);
  EXPECT_LE(report["ram_peak_bytes"].get<int>(), 2 << 20);
}

TEST_F(RunCommand, DrawsInThePixelFormatThatIsAskedFor) {
  const auto pixels = [&](const std::string& options) {
    const Ran ran = usuzumi("run hills.rom --board small --background 112233 --stats stats.json " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return json_file("stats.json")["frames"][0]["crc32"];
  };
  const auto panel = pixels("");
  EXPECT_EQ(pixels("--format rgb565"), panel) << "the board's own";
  EXPECT_NE(pixels("--size 240x136 --format xrgb8888"), pixels("--size 240x136 --format rgb565"));
  expect_one_line_error(usuzumi("run hills.rom --format bgr565"), 2, "--format");
}

TEST_F(RunCommand, AnswersBadInputWithOneLine) {
  expect_one_line_error(usuzumi("run nothing.rom"), 3, "nothing.rom");
  expect_one_line_error(usuzumi("run hills.obj"), 3, "hills.obj");
  expect_one_line_error(usuzumi("run hills.rom --size 12"), 2, "WIDTHxHEIGHT");
  expect_one_line_error(usuzumi("run hills.rom --size 8000x10"), 2, "--size 8000x10");
  for (const char* number : {"0", "-18446744073709551615", "1000001"}) {
    expect_one_line_error(usuzumi(std::string("run hills.rom --frames ") + number), 2, "--frames");
    expect_one_line_error(usuzumi(std::string("run hills.rom --threads ") + number), 2, "--threads");
  }
  expect_one_line_error(usuzumi("run hills.rom --engine voodoo"), 2, "voodoo");
  expect_one_line_error(usuzumi("run hills.rom --quota 0"), 2, "--quota 0");
  expect_one_line_error(usuzumi("run hills.rom --policy never"), 2, "--policy never");
  expect_one_line_error(usuzumi("run hills.rom --policy chosen:valleys"), 2, "hills");
  expect_one_line_error(usuzumi("run hills.rom --policy random:half"), 2, "random");
  expect_one_line_error(usuzumi("run hills.rom --policy random:101%"), 2, "--policy random:101%: the share must be");
  expect_one_line_error(usuzumi("run hills.rom --policy random:50%:-1"), 2, "--policy random:50%:-1: SEED");
  expect_one_line_error(usuzumi("run hills.rom --policy below-area:-1"), 2, "--policy below-area:-1: PIXELS");
  expect_one_line_error(usuzumi("run hills.rom --thin off --quota 50%"), 2, "--thin off");
  expect_one_line_error(usuzumi("run hills.rom --orbit --camera path.json"), 2, "--orbit");
  expect_one_line_error(usuzumi("run hills.rom --camera nothing.json"), 3, "nothing.json");
  expect_one_line_error(usuzumi("run hills.rom --board small --size 1920x720"), 5, "VRAM");
  expect_one_line_error(usuzumi("run hills.rom --stats missing/stats.json"), 4, "missing");
  expect_one_line_error(usuzumi("run hills.rom --out /dev/null/pictures"), 4, "/dev/null/pictures");
  write("path.json", R"({"frames": [{"eye": [0, 0, 1], "target": [0, 0, 1]}]})");
  expect_one_line_error(usuzumi("run hills.rom --camera path.json"), 3, "frame 0");
  write("path.json", R"({"eyes": 3})");
  expect_one_line_error(usuzumi("run hills.rom --camera path.json"), 3, "eyes");
}

TEST_F(RunCommand, WritesOverNoneOfItsInputs) {
  write("path.json", R"({"eye": [10, 30, 40], "target": [10, 0, 10]})");
  std::filesystem::create_symlink("hills.rom", folder() / "link");
  const std::string rom = text("hills.rom"), camera = text("path.json");
  expect_one_line_error(usuzumi("run hills.rom --stats hills.rom"), 2, "--stats hills.rom");
  expect_one_line_error(usuzumi("run hills.rom --stats link"), 2, "--stats link");
  expect_one_line_error(usuzumi("run link --stats ./hills.rom"), 2, "--stats ./hills.rom");
  expect_one_line_error(usuzumi("run hills.rom --camera path.json --stats path.json"), 2, "--stats path.json");
  EXPECT_EQ(text("hills.rom"), rom);
  EXPECT_EQ(text("path.json"), camera);
}

TEST_F(RunCommand, RefusesOptionsThatContradictEachOther) {
  expect_one_line_error(usuzumi("run hills.rom --thin off --placement midpoint"), 2, "--placement");
  expect_one_line_error(usuzumi("run hills.rom --thin off --placement optimal"), 2, "--placement");
  expect_one_line_error(usuzumi("run hills.rom --policy 2=always --policy 2=random:50%"), 2,
                        "level 2 has its policy from --policy 2=always");
  expect_one_line_error(usuzumi("run hills.rom --policy always --policy 3=random:50%"), 2,
                        "level 3 has its policy from --policy always");
  EXPECT_EQ(usuzumi("run hills.rom --size 160x96 --policy 2=always --policy 3=random:50%").exit_code, 0);
}

TEST_F(RunCommand, SaysWhichOptionsHaveNoEffect) {
  write("three.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no body\nf 1 2 3\no lamp\nf 1 2 3\no rest\nf 1 2 3\n");
  ASSERT_EQ(usuzumi("pack three.obj -o three.rom --level body=1 --level lamp=2 --level rest=0").exit_code, 0);
  const auto notes = [&](const std::string& options) {
    const Ran ran = usuzumi("run --size 160x96 " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.err;
  };
  EXPECT_EQ(notes("three.rom --quota 50"), "note: --quota 50 has no effect: no mesh has level 3\n");
  EXPECT_EQ(notes("three.rom --placement midpoint"), "note: --placement midpoint has no effect: no mesh has level 3\n");
  EXPECT_EQ(notes("three.rom --policy 3=always"), "note: --policy 3=always has no effect: no mesh has level 3\n");
  EXPECT_EQ(notes("hills.rom --policy 2=always"), "note: --policy 2=always has no effect: no mesh has level 2\n");
  EXPECT_EQ(
      notes("three.rom --policy chosen:lamp,body"),
      "note: --policy chosen:lamp,body: choosing body has no effect: its level is 1 keep, the policy is for 2 or 3\n");
  EXPECT_EQ(notes("three.rom --policy chosen:lamp"), "");
  EXPECT_EQ(notes("hills.rom --quota 50 --placement midpoint --policy always"), "");
  EXPECT_EQ(notes("hills.rom --orbit"), "note: --orbit has no effect on one frame; give --frames\n");
  const std::string camera = R"({"eye": [10, 30, 40], "target": [10, 0, 10]})";
  write("path.json", R"({"frames": [)" + camera + "," + camera + "]}");
  EXPECT_EQ(notes("hills.rom --camera path.json"),
            "note: path.json: 2 cameras for 1 frame(s); give --frames 2 to use them all\n");
  EXPECT_EQ(notes("hills.rom --camera path.json --frames 2"), "");
}

TEST_F(RunCommand, TellsOfPicturesOfALongerRunAndLeavesThem) {
  EXPECT_EQ(usuzumi("run hills.rom --size 160x96 --orbit --frames 4 --out pictures").err, "");
  write("pictures/frame-first.png", "another's");
  const Ran ran = usuzumi("run hills.rom --size 160x96 --orbit --frames 2 --out pictures");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_EQ(
      ran.err,
      "note: pictures: 2 picture(s) of an earlier run remain, from frame-0002.png on; remove what is not wanted\n");
  EXPECT_TRUE(exists("pictures/frame-0003.png"));
  EXPECT_EQ(usuzumi("run hills.rom --size 160x96 --orbit --frames 4 --out pictures").err, "");
}

TEST_F(RunCommand, ChoosesByNameAsPackDoes) {
  write("front.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no Wheel\nf 1 2 3\no Body\nf 1 3 2\n");
  write("rear.obj", "v 1 0 0\nv 2 0 0\nv 1 1 0\no Wheel\nf 1 2 3\n");
  ASSERT_EQ(usuzumi("pack front.obj rear.obj -o wheels.rom --default-level 2").exit_code, 0);
  const auto left = [&](const std::string& pattern) {
    const Ran ran = usuzumi("run wheels.rom --size 160x96 --stats stats.json --policy chosen:" + pattern);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return json_file("stats.json")["frames"][0]["meshes_out"].get<int>();
  };
  EXPECT_EQ(left("Wheel"), 1);
  EXPECT_EQ(left("Wheel#1"), 2);
  EXPECT_EQ(left("Wheel#2"), 2);
  EXPECT_EQ(left("Wheel#1,Body"), 1);
  ASSERT_EQ(usuzumi("pack front.obj -o bare.rom --bare --default-level 2").exit_code, 0);
  expect_one_line_error(usuzumi("run bare.rom --policy chosen:Wheel"), 2, "bare drawing data have no names");
}

TEST_F(RunCommand, DrawsMeshesFromTheirLayers) {
  ASSERT_EQ(usuzumi("pack hills.obj -o layered.rom --default-level 3 --layers 100,60,36,21.6").exit_code, 0);
  const auto report = [&](const std::string& options) {
    const Ran ran = usuzumi("run --size 160x96 --stats stats.json " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    return json_file("stats.json");
  };
  // Half of 800 faces lie between 480 and 288: by replay exactly, by layers a little beyond layer 1.
  const auto exact = report("layered.rom");
  EXPECT_EQ(exact["layered_meshes"].size(), 1u);
  EXPECT_EQ(exact["frames"][0]["faces_thinned"], 400);
  EXPECT_EQ(exact["frames"][0]["thinning"]["meshes_layered"], 1);
  const auto between = report("layered.rom --lod quota --quota 50%");
  EXPECT_EQ(between["frames"][0]["faces_thinned"], 480);
  EXPECT_NEAR(between["frames"][0]["layers"][0].get<double>(), 1.387, 0.01) << "21.9 - 20 of 21.9 - 17.0";
  // 160 pixels' worth of faces is fewer than all; attention far away asks for fewer still.
  const auto layer_of = [&](const std::string& options) {
    return report(options)["frames"][0]["layers"][0].get<double>();
  };
  const double automatic = layer_of("layered.rom --lod auto");
  EXPECT_LT(automatic, layer_of("layered.rom --lod auto --attention 0,0"));
  const auto booted = report("hills.rom --boot-layers 100,60,36,21.6 --lod quota --quota 50%");
  EXPECT_EQ(booted["frames"][0]["layers"], between["frames"][0]["layers"]);
  EXPECT_EQ(booted["frames"][0]["crc32"], between["frames"][0]["crc32"]);
  EXPECT_TRUE(report("hills.rom")["frames"][0]["layers"].empty());
  const auto off = report("layered.rom --frames 2 --gpio 0:ignition=1,1:ignition=0");
  EXPECT_TRUE(off["frames"][0]["layers"][0].is_number());
  EXPECT_TRUE(off["frames"][1]["layers"][0].is_null()) << "nothing is drawn";
  EXPECT_EQ(usuzumi("run layered.rom --size 160x96 --boot-layers 100,50").err,
            "note: --boot-layers 100,50 has no effect: every mesh of level 3 has layers in the ROM\n");
  const std::string beyond = usuzumi("run layered.rom --size 160x96 --lod quota --quota 5%").out;
  EXPECT_NE(beyond.find("or the quota lies beyond their last layer"), std::string::npos) << beyond;
}

TEST_F(RunCommand, DrawsSolidsByTheMembersThatThresholdsAskFor) {
  write("scene.json", R"({"solids": [{"kind": "sphere", "diameter": 4},
                                     {"kind": "sphere", "diameter": 1, "position": [4, 0, 0]},
                                     {"kind": "cone", "diameter": 0.2, "height": 0.4, "position": [0, 3, 0]}]})");
  ASSERT_EQ(usuzumi("pack scene.json -o scene.rom").exit_code, 0);
  const auto solids = [&](const std::string& options) {
    const Ran ran = usuzumi("run scene.rom --size 160x96 --stats stats.json " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    return json_file("stats.json")["frames"][0];
  };
  const auto whole = solids("");
  EXPECT_EQ(whole["solids"]["high"], 3);
  EXPECT_NE(whole["thinning"]["cause"], "nothing drawn");
  EXPECT_EQ(whole["solids"]["faces"], 128 + 128 + 17) << "table 2";
  EXPECT_GT(whole["faces_drawn"].get<int>(), 128);
  // The large ball is some 35 pixels wide, the small one a quarter of that, the cone 2.
  const auto mixed = solids("--thresholds 20,5,4");
  EXPECT_EQ(mixed["solids"]["high"], 1);
  EXPECT_EQ(mixed["solids"]["medium"], 1);
  EXPECT_EQ(mixed["solids"]["low"], 0);
  EXPECT_EQ(mixed["solids"]["rough"], 1);
  EXPECT_EQ(mixed["solids"]["faces"], 128 + 50 + 1);
  EXPECT_NE(mixed["crc32"], whole["crc32"]);
  EXPECT_EQ(solids("--thresholds 2048,2048,2048")["solids"]["faces"], 3);
  EXPECT_EQ(solids("--thin off")["crc32"], whole["crc32"]);
  const auto low = solids("--thresholds 1024,1024,0");
  EXPECT_EQ(low["solids"]["low"], 3);
  EXPECT_LT(low["engine_cycles"].get<int>(), whole["engine_cycles"].get<int>());
  EXPECT_EQ(solids("--thresholds 1024,1024,0 --threads 2")["crc32"], low["crc32"]);

  // The button's third mode is the full picture.
  usuzumi("run scene.rom --size 160x96 --stats stats.json --thresholds 2048,2048,2048 --frames 9 "
          "--gpio 0:ignition=1,2:mode=1,3:mode=0,6:mode=1,7:mode=0");
  const auto frames = json_file("stats.json")["frames"];
  EXPECT_EQ(frames[0]["solids"]["rough"], 3);
  EXPECT_EQ(frames[8]["mode"], "full");
  EXPECT_EQ(frames[8]["solids"]["high"], 3);

  for (const char* wrong : {"1,2,3", "3,2", "3,2,1,0", "a,b,c", "3,2,-1", "", "nan,0,0"})
    expect_one_line_error(usuzumi(std::string("run scene.rom --thresholds=") + wrong), 2, "--thresholds");
  expect_one_line_error(usuzumi("run scene.rom --thin off --thresholds 3,2,1"), 2, "--thresholds");
  EXPECT_EQ(usuzumi("run hills.rom --size 160x96 --thresholds 3,2,1").err,
            "note: --thresholds 3,2,1 has no effect: there are no solids; give pack a scene file\n");
}

TEST_F(RunCommand, SaysWhereTheMembersOfSolidsHaveNoRoom) {
  std::string scene = R"({"solids": [)";
  for (int i = 0; i < 3000; ++i) scene += std::string(i > 0 ? "," : "") + R"({"kind": "sphere", "diameter": 1})";
  write("many.json", scene + "]}");
  ASSERT_EQ(usuzumi("pack many.json -o many.rom").exit_code, 0);
  expect_one_line_error(usuzumi("run many.rom --board small"), 5, "members of the solids");
}

TEST_F(RunCommand, RefusesLayersAndAttentionThatCannotBe) {
  expect_one_line_error(usuzumi("run hills.rom --boot-layers 100,60,80"), 2, "--boot-layers 100,60,80");
  expect_one_line_error(usuzumi("run hills.rom --boot-layers 60,30"), 2, "--boot-layers 60,30");
  expect_one_line_error(usuzumi("run hills.rom --attention 10,10"), 2, "--lod auto");
  for (const char* place : {"10", "160,10", "10,96", "-1,4", "a,b"})
    expect_one_line_error(
        usuzumi(std::string("run hills.rom --size 160x96 --lod auto --boot-layers 100,50 --attention=") + place), 2,
        "--attention");
  expect_one_line_error(usuzumi("run hills.rom --thin off --lod auto"), 2, "--lod");
  expect_one_line_error(usuzumi("run hills.rom --lod fast"), 2, "--lod");
  EXPECT_EQ(usuzumi("run hills.rom --size 160x96 --lod auto").err,
            "note: --lod auto has no effect: no mesh has layers; give pack --layers or run --boot-layers\n");
}

TEST_F(RunCommand, TakesNoEmptyValueForAnOptionLeftOut) {
  for (const char* option : {"--size", "--format", "--out", "--stats", "--camera", "--quota", "--policy",
                             "--background", "--gpio", "--fault", "--lod", "--attention", "--boot-layers"})
    expect_one_line_error(usuzumi(std::string("run hills.rom ") + option + " ''"), 2, option);
  expect_one_line_error(usuzumi("compare hills.rom hills.rom --diff ''"), 2, "--diff");
  expect_one_line_error(usuzumi("pack '' -o out.rom"), 2, "INPUT");
}

TEST_F(RunCommand, TakesNothingFromACameraFileThatItWouldNotUse) {
  const std::string camera = R"("eye": [10, 30, 40], "target": [10, 0, 10])";
  const std::pair<std::string, const char*> files[] = {
      {R"({"frames": [{)" + camera + R"(}], "loop": true})", "\"loop\""},
      {"{" + camera + R"(, "eye": [0, 0, 1]})", "\"eye\" stands twice"},
      {R"({"frames": [{)" + camera + R"(, "fov": 40}]})", "frame 0: \"fov\" is none of"},
      {R"({"frames": [{"target": [10, 0, 10]}]})", "frame 0: there is no \"eye\""},
      {R"({"frames": 3})", "must be a list"},
      {R"([1])", "must be an object"},
      {"{" + camera + R"(, "near": 1e999})", "too large"},
      {"{", "not JSON"},
  };
  for (const auto& [content, about] : files) {
    write("path.json", content);
    expect_one_line_error(usuzumi("run hills.rom --camera path.json"), 3, about);
  }
}

TEST_F(RunCommand, LooksForRoomForItsOutputsBeforeItDraws) {
  // Stopped by the test's time limit.
  const std::string a_long_run = "run hills.rom --size 160x96 --orbit --frames 1000000 ";
  expect_one_line_error(usuzumi(a_long_run + "--stats missing/stats.json"), 4, "missing");
  expect_one_line_error(usuzumi(a_long_run + "--out /dev/null/pictures"), 4, "choose another place");
  expect_one_line_error(usuzumi(a_long_run + "--out /proc"), 4, "/proc/frame-0000.png");
  EXPECT_EQ(usuzumi("run hills.rom --size 160x96 --out new --stats new/stats.json").exit_code, 0);
  EXPECT_TRUE(exists("new/stats.json"));
}

TEST_F(RunCommand, SaysWhatDidNotFitTheSmallBoard) {
  write_hills("big.obj", 200);  // 80,000 faces: 1.4 MB as they are, beyond 2 MiB with the simplifier's working space
  ASSERT_EQ(usuzumi("pack big.obj -o must.rom --default-level 1").exit_code, 0);
  ASSERT_EQ(usuzumi("pack big.obj -o may.rom --default-level 3").exit_code, 0);
  const Ran may = usuzumi("run may.rom --board small --stats stats.json");
  EXPECT_EQ(may.exit_code, 0) << may.err;
  const auto thinning = json_file("stats.json")["frames"][0]["thinning"];
  EXPECT_EQ(thinning["meshes_unthinned"].get<int>() + thinning["meshes_dropped"].get<int>(), 1);
  EXPECT_NE(may.out.find("RAM was short"), std::string::npos);
  write_hills("huge.obj", 330);  // 217,800 faces: no room for them at all
  ASSERT_EQ(usuzumi("pack huge.obj -o huge.rom --default-level 1").exit_code, 0);
  expect_one_line_error(usuzumi("run huge.rom --board small"), 5, "RAM");
}

TEST_F(RunCommand, HelpShowsAnExampleEverywhere) {
  for (const char* command : {"", "pack ", "inspect ", "thin ", "run ", "compare "}) {
    const Ran ran = usuzumi(std::string(command) + "--help");
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_NE(ran.out.find("Example"), std::string::npos) << command;
  }
  EXPECT_NE(usuzumi("--help").out.find("Exit codes"), std::string::npos);
  expect_one_line_error(usuzumi("paint"), 2, "paint");
  expect_one_line_error(usuzumi("run --frames 3"), 2, "see usuzumi run --help");
  expect_one_line_error(usuzumi("--frames 3"), 2, "see usuzumi --help");
  expect_one_line_error(usuzumi("inspect hills.obj"), 3, "hills.obj: neither a container nor sound bare drawing data");
  expect_one_line_error(usuzumi(""), 2, "A subcommand is required");
}

}  // namespace
}  // namespace usuzumi
