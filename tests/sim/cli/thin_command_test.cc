#include "tests/sim/cli/command.h"

namespace usuzumi {
namespace {

using testing::expect_one_line_error;
using testing::Ran;
using ThinCommand = testing::CommandTest;

TEST_F(ThinCommand, ReachesACountAndAShareAndReportsThem) {
  write_hills("hills.obj", 20);
  for (const auto& [faces, most] : {std::pair{"100", 100u}, std::pair{"25%", 200u}}) {
    const Ran ran = usuzumi(std::string("thin hills.obj -o out.ply --json --faces ") + faces);
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const auto report = ran.json();
    EXPECT_EQ(report["faces_in"], 800u);
    EXPECT_EQ(report["vertices_in"], 441u);
    EXPECT_LE(report["faces_out"].get<unsigned>(), most);
    EXPECT_GE(report["faces_out"].get<unsigned>(), most - 2);
    EXPECT_GT(report["thin_ms"].get<double>(), 0);
    EXPECT_GT(report["ram_peak_bytes"].get<double>(), 441 * 12 + 800 * 12);
    EXPECT_GT(report["max_error"].get<double>(), 0);
    EXPECT_LT(report["vertices_out"].get<unsigned>(), 441u);
  }
}

TEST_F(ThinCommand, WritesWhatItReportsInBothFormats) {
  write_hills("hills.obj", 10);
  const auto report = usuzumi("thin hills.obj -o out.obj --faces 50 --json").json();
  const std::string obj = text("out.obj");
  const auto lines = [&](const char* start) {
    std::size_t n = 0;
    std::istringstream s(obj);
    for (std::string line; std::getline(s, line);) n += line.starts_with(start) ? 1u : 0u;
    return n;
  };
  EXPECT_EQ(lines("v "), report["vertices_out"].get<std::size_t>());
  EXPECT_EQ(lines("f "), report["faces_out"].get<std::size_t>());
  ASSERT_EQ(usuzumi("thin hills.obj -o out.ply --faces 50").exit_code, 0);
  const std::string ply = text("out.ply");
  EXPECT_NE(ply.find("element face " + std::to_string(report["faces_out"].get<int>()) + "\n"), std::string::npos);
  const auto header = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.size() - header,
            report["vertices_out"].get<std::size_t>() * 12 + report["faces_out"].get<std::size_t>() * 13);
  // What was written can be thinned again, and nothing is left to do.
  const auto again = usuzumi("thin out.ply -o again.ply --faces 50 --json").json();
  EXPECT_EQ(again["faces_in"], report["faces_out"]);
  EXPECT_EQ(again["faces_out"], report["faces_out"]);
}

TEST_F(ThinCommand, JoinsTheMeshesOfARomAndWeldsEqualPositions) {
  write("two.obj", "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 4 6 5\n");
  ASSERT_EQ(usuzumi("pack two.obj -o two.rom").exit_code, 0);
  for (const char* input : {"two.obj", "two.rom"}) {
    const auto report = usuzumi(std::string("thin ") + input + " -o out.ply --faces 2 --json").json();
    EXPECT_EQ(report["faces_in"], 2u) << input;
    EXPECT_EQ(report["vertices_in"], 4u) << input;
  }
}

TEST_F(ThinCommand, MidpointPlacesVerticesBetweenTwoOld) {
  write("plate.obj", "v 0 0 0\nv 1 0 0\nv 0 3 0\nv 5 3 0\nf 1 2 3\nf 2 4 3\n");
  ASSERT_EQ(usuzumi("thin plate.obj -o out.obj --faces 1 --placement midpoint").exit_code, 0);
  EXPECT_NE(text("out.obj").find("v 0.5 0 0\n"), std::string::npos) << text("out.obj");
}

TEST_F(ThinCommand, SaysWhenAQuotaCannotBeReached) {
  write("tetrahedron.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const Ran ran = usuzumi("thin tetrahedron.obj -o out.ply --faces 2");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.out.find("4 faces -> 4 faces"), std::string::npos);
  EXPECT_NE(ran.out.find("quota was not reached"), std::string::npos);
}

TEST_F(ThinCommand, RefusesColoursWhereTheFileHasNoPlaceForThem) {
  write_hills("hills.obj", 4);
  expect_one_line_error(usuzumi("thin hills.obj -o out.obj --faces 5 --colours"), 2, "--colours: out.obj");
  EXPECT_EQ(usuzumi("thin hills.obj -o out.ply --faces 5 --colours").exit_code, 0);
}

TEST_F(ThinCommand, KnowsARomByWhatIsInItAndABareOneByItsName) {
  write_hills("hills.OBJ", 4);
  ASSERT_EQ(usuzumi("pack hills.OBJ -o picture.data").exit_code, 0);
  ASSERT_EQ(usuzumi("pack hills.OBJ -o misleading.obj").exit_code, 0);
  ASSERT_EQ(usuzumi("pack hills.OBJ -o BARE.ROM --bare").exit_code, 0);
  for (const char* rom : {"picture.data", "misleading.obj", "BARE.ROM", "hills.OBJ"}) {
    const Ran ran = usuzumi(std::string("thin ") + rom + " -o out.PLY --faces 5 --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["faces_in"], 32) << rom;
  }
  EXPECT_TRUE(text("out.PLY").starts_with("ply\n"));
  write("notes.txt", "nothing to draw");
  expect_one_line_error(usuzumi("thin notes.txt -o out.ply --faces 5"), 3, ".rom");
  expect_one_line_error(usuzumi("thin . -o out.ply --faces 5"), 3, "neither a ROM image nor a model");
}

TEST_F(ThinCommand, WritesNotOverItsInput) {
  write_hills("hills.obj", 4);
  const std::string before = text("hills.obj");
  expect_one_line_error(usuzumi("thin hills.obj -o hills.obj --faces 5"), 2, "-o hills.obj");
  EXPECT_EQ(text("hills.obj"), before);
}

TEST_F(ThinCommand, AnswersBadInputWithOneLine) {
  write_hills("hills.obj", 4);
  expect_one_line_error(usuzumi("thin nothing.obj -o out.ply --faces 5"), 3, "nothing.obj");
  expect_one_line_error(usuzumi("thin hills.obj -o out.stl --faces 5"), 2, ".ply or .obj");
  expect_one_line_error(usuzumi("thin hills.obj -o out.ply --faces many"), 2, "--faces many");
  expect_one_line_error(usuzumi("thin hills.obj -o out.ply --faces 0"), 2, "--faces 0");
  expect_one_line_error(usuzumi("thin hills.obj -o out.ply"), 2, "--faces");
  expect_one_line_error(usuzumi("thin hills.obj -o missing/out.ply --faces 5"), 4, "missing");
  write("broken.rom", "USZ1 and then nothing of use........");
  expect_one_line_error(usuzumi("thin broken.rom -o out.ply --faces 5"), 3, "broken.rom");
  EXPECT_EQ(files(), 2u) << "no output of a failed command is left";
}

}  // namespace
}  // namespace usuzumi
