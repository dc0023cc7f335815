#include <map>
#include <set>
#include <utility>
#include <vector>

#include "sim/image/png.h"
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

/// Two squares along x with a red and a blue texture, each in its own coordinates, so that a seam runs between them.
void write_textured(const std::filesystem::path& folder) {
  sim::write_png(folder / "red.png", sim::Image(2, 2, 0xFF0000));
  sim::write_png(folder / "blue.png", sim::Image(2, 2, 0x0000FF));
  std::ofstream(folder / "board.mtl") << "newmtl a\nKd 1 1 1\nmap_Kd red.png\nnewmtl b\nKd 1 1 1\nmap_Kd blue.png\n";
  std::ofstream obj(folder / "board.obj");
  obj << "mtllib board.mtl\no board\n";
  constexpr int kCells = 8;
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= 2 * kCells; ++i) obj << "v " << i << " " << j << " " << (i * j) % 3 * 0.1 << "\n";
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i) obj << "vt " << i / 8.0 << " " << j / 8.0 << "\n";
  for (int side = 0; side < 2; ++side) {
    obj << "usemtl " << (side == 0 ? "a" : "b") << "\n";
    for (int j = 0; j < kCells; ++j)
      for (int i = 0; i < kCells; ++i) {
        const int v = j * (2 * kCells + 1) + i + side * kCells + 1, up = v + 2 * kCells + 1;
        const int t = j * (kCells + 1) + i + 1, t_up = t + kCells + 1;
        obj << "f " << v << "/" << t << " " << v + 1 << "/" << t + 1 << " " << up + 1 << "/" << t_up + 1 << "\n"
            << "f " << v << "/" << t << " " << up + 1 << "/" << t_up + 1 << " " << up << "/" << t_up << "\n";
      }
  }
}

/// x and s of the corners of faces by material, from an OBJ that has a texture coordinate per vertex.
std::map<std::string, std::vector<std::pair<double, double>>> corners_by_material(const std::string& obj) {
  std::vector<double> x, s;
  std::map<std::string, std::vector<std::pair<double, double>>> out;
  std::string material;
  std::istringstream lines(obj);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    double number = 0;
    if (word == "usemtl") words >> material;
    if (word == "v" && words >> number) x.push_back(number);
    if (word == "vt" && words >> number) s.push_back(number);
    if (word != "f") continue;
    for (std::string corner; words >> corner;) {
      const auto slash = corner.find('/');
      out[material].emplace_back(x.at(std::stoul(corner) - 1), s.at(std::stoul(corner.substr(slash + 1)) - 1));
    }
  }
  return out;
}

TEST_F(ThinCommand, KeepsTexturesMaterialsAndTheSeamBetweenThem) {
  write_textured(folder());
  const Ran ran = usuzumi("thin board.obj -o thinned.obj --faces 25% --textures --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["faces_in"], 256);
  EXPECT_LE(ran.json()["faces_out"].get<int>(), 64);
  EXPECT_EQ(ran.json()["vertices_in"], 162) << "the seam's nine places have two vertices each";
  const auto corners = corners_by_material(text("thinned.obj"));
  ASSERT_EQ(corners.size(), 2u);
  // The first look covers x from 0 to 8, the second from 8 to 16, both with s from 0 to 1.
  for (const auto& [material, all] : corners)
    for (const auto& [x, s] : all) EXPECT_NEAR(s, material == "look-1" ? x / 8 : x / 8 - 1, 0.02) << material;
  EXPECT_EQ(sim::read_png(folder() / "thinned-1.png"), sim::Image(2, 2, 0xFF0000));
  EXPECT_EQ(sim::read_png(folder() / "thinned-2.png"), sim::Image(2, 2, 0x0000FF));
  EXPECT_NE(text("thinned.mtl").find("newmtl look-2\nKd 1 1 1\nmap_Kd thinned-2.png\n"), std::string::npos);
  // It can be packed again, and the ROM be thinned as well as the file.
  const Ran packed = usuzumi("pack thinned.obj -o thinned.rom --default-level 1");
  ASSERT_EQ(packed.exit_code, 0) << packed.err;
  ASSERT_EQ(usuzumi("thin thinned.rom -o again.obj --faces 100% --textures").exit_code, 0);
  EXPECT_EQ(corners_by_material(text("again.obj")).size(), 2u);
  EXPECT_EQ(sim::read_png(folder() / "again-2.png"), sim::Image(2, 2, 0x0000FF));
}

TEST_F(ThinCommand, WritesOneTextureIntoPlyAndRefusesMore) {
  write_textured(folder());
  expect_one_line_error(usuzumi("thin board.obj -o out.ply --faces 25% --textures"), 2, "a .ply holds one");
  EXPECT_FALSE(exists("out.ply"));
  write("board.mtl", "newmtl a\nKd 1 1 1\nmap_Kd red.png\nnewmtl b\nKd 1 1 1\nmap_Kd red.png\n");
  ASSERT_EQ(usuzumi("thin board.obj -o out.ply --faces 25% --textures").exit_code, 0);
  const std::string ply = text("out.ply");
  EXPECT_NE(ply.find("comment TextureFile out-1.png\n"), std::string::npos);
  EXPECT_NE(ply.find("property float s\nproperty float t\n"), std::string::npos);
  ASSERT_EQ(usuzumi("pack out.ply -o out.rom --default-level 1").exit_code, 0);
  const auto rom = usuzumi("inspect out.rom --json").json();
  EXPECT_EQ(rom["textures"][0]["name"], "out-1.png");
  EXPECT_EQ(rom["meshes"][0]["texture_coordinates"], true);
}

TEST_F(ThinCommand, WritesTexturesOverNoInput) {
  write_textured(folder());
  std::filesystem::rename(folder() / "red.png", folder() / "out-1.png");
  write("board.mtl", "newmtl a\nmap_Kd out-1.png\nnewmtl b\nmap_Kd blue.png\n");
  const std::string before = text("out-1.png");
  expect_one_line_error(usuzumi("thin board.obj -o out.obj --faces 25% --textures"), 2, "out-1.png");
  EXPECT_EQ(text("out-1.png"), before);
  EXPECT_FALSE(exists("out.obj"));
}

TEST_F(ThinCommand, TellsWhatBecameOfMissingTextures) {
  write_textured(folder());
  std::filesystem::remove(folder() / "red.png");
  const Ran ran = usuzumi("thin board.obj -o out.obj --faces 25% --textures");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.err.find("red.png is missing"), std::string::npos) << ran.err;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_EQ(sim::read_png(folder() / "out-1.png"), sim::Image(2, 2, 0x0000FF));
  EXPECT_FALSE(exists("out-2.png"));
  EXPECT_EQ(usuzumi("thin board.obj -o out.obj --faces 25%").err, "") << "nobody asked for textures";
}

TEST_F(ThinCommand, VertexDeletionKeepsTheVerticesOfEdgesOfThreeFaces) {
  constexpr int kCells = 6;
  {
    std::ofstream obj(folder() / "fins.obj");
    for (int fin = 0; fin < 3; ++fin)
      for (int j = 0; j <= kCells; ++j)
        for (int i = 0; i <= kCells; ++i)
          obj << "v " << (fin == 1 ? 0 : i * (1 - fin)) << " " << (fin == 1 ? i : 0) << " " << j << "\n";
    for (int fin = 0; fin < 3; ++fin)
      for (int j = 0; j < kCells; ++j)
        for (int i = 0; i < kCells; ++i) {
          const int v = (fin * (kCells + 1) + j) * (kCells + 1) + i + 1, up = v + kCells + 1;
          obj << "f " << v << " " << v + 1 << " " << up + 1 << "\nf " << v << " " << up + 1 << " " << up << "\n";
        }
  }
  const auto on_the_axis = [&] {
    std::set<std::string> vertices;
    std::istringstream lines(text("out.obj"));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("v 0 0 ")) vertices.insert(line);
    return vertices.size();
  };
  const Ran ran = usuzumi("thin fins.obj -o out.obj --faces 30% --method vertex-deletion --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_LT(ran.json()["faces_out"].get<int>(), 3 * 2 * kCells * kCells / 2) << "the fins themselves are thinned";
  EXPECT_EQ(on_the_axis(), kCells + 1u) << "three faces meet along it";
}

TEST_F(ThinCommand, EveryMethodThinsAndSaysWhichItWas) {
  write_textured(folder());
  std::set<std::string> results;
  for (const char* method : {"qem", "edge-removal", "half-edge", "vertex-deletion"}) {
    const Ran ran = usuzumi(std::string("thin board.obj -o out.obj --faces 30% --textures --json --method ") + method);
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["method"], method);
    EXPECT_LT(ran.json()["faces_out"].get<int>(), 256) << method;
    results.insert(text("out.obj"));
  }
  EXPECT_EQ(results.size(), 4u) << "two methods did the same";
}

TEST_F(ThinCommand, SettingsAndPlacementReachTheMethod) {
  write_hills("hills.obj", 12);
  const auto thinned = [&](const std::string& options) {
    const Ran ran = usuzumi("thin hills.obj -o out.obj --faces 40% " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return text("out.obj");
  };
  const std::string plain = thinned("--method edge-removal");
  EXPECT_EQ(thinned("--method edge-removal --placement automatic --setting a=1 --setting b=0.1"), plain)
      << "these are the defaults";
  EXPECT_NE(thinned("--method edge-removal --setting a=0 --setting b=5"), plain);
  EXPECT_NE(thinned("--method edge-removal --placement midpoint"), plain);
  EXPECT_NE(thinned("--method vertex-deletion --setting preset=flat"), thinned("--method vertex-deletion"));
  EXPECT_NE(thinned("--placement midpoint"), thinned(""));
}

TEST_F(ThinCommand, EdgesThatARomLocksStay) {
  write_hills("hills.obj", 6);
  write("lock.json", R"({"meshes": {"hills": {"thinning_level": 3, "method": "edge-removal",
                         "regions": [{"group": "hills", "locked": true}]}}})");
  ASSERT_EQ(usuzumi("pack hills.obj -o hills.rom --sidecar lock.json").exit_code, 0);
  EXPECT_EQ(usuzumi("thin hills.rom -o out.obj --faces 10 --method edge-removal --json").json()["faces_out"], 72);
  EXPECT_LT(usuzumi("thin hills.rom -o out.obj --faces 10 --json").json()["faces_out"].get<int>(), 72);
}

TEST_F(ThinCommand, MethodsAndSettingsThatDoNotExistAreOneLine) {
  write_hills("hills.obj", 4);
  const auto refused = [&](const std::string& options, const std::string& about) {
    expect_one_line_error(usuzumi("thin hills.obj -o out.obj --faces 5 " + options), 2, about);
  };
  refused("--method quadric", "--method: quadric not in {qem,edge-removal,half-edge,vertex-deletion}");
  refused("--method edge-removal --setting c=1", "c is not a setting");
  refused("--method edge-removal --setting a", "wants NAME=VALUE");
  refused("--method edge-removal --setting a=-1", "0 or more");
  refused("--method edge-removal --setting preset=flat", "of method vertex-deletion");
  refused("--method vertex-deletion --setting preset=round", "flat, curved, bounded");
  refused("--method edge-removal --placement optimal", "automatic");
  refused("--placement automatic", "optimal, midpoint");
  EXPECT_FALSE(exists("out.obj"));
}

}  // namespace
}  // namespace usuzumi
