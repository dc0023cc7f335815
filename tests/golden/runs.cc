#include "tests/golden/runs.h"

#include "tests/support/desk_request.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/scene_meshes.h"
#include "tests/support/test_meshes.h"

namespace usuzumi::golden {
namespace {

using firmware::format::QuotaKind;
using testing::TestMesh;

/// Any of the tests' indexed meshes, scaled and moved.
template <class Mesh>
TestMesh placed(const Mesh& mesh, float scale, Vec3 at, std::uint32_t level, Rgba8 colour) {
  TestMesh placed;
  placed.level = level;
  for (const Vec3& p : mesh.positions) placed.positions.push_back(p * scale + at);
  placed.indices = mesh.indices;
  placed.normals = mesh.normals;
  placed.colours = mesh.colours;
  placed.base_colour = colour;
  return placed;
}

TestMesh with_quota(TestMesh mesh, QuotaKind kind, std::uint32_t quota) {
  mesh.quota_kind = kind;
  mesh.quota = quota;
  return mesh;
}

TestMesh plate() {
  TestMesh plate = testing::hills(24, 3);
  plate.base_colour = rgba8(70, 110, 80);
  plate.flags = firmware::format::kFlagTwoSided;
  return with_quota(plate, QuotaKind::kMillionths, 200'000);
}

testing::Mesh ball() {
  testing::Mesh ball = testing::icosphere(4);
  for (const Vec3& p : ball.positions) ball.normals.push_back(pack_normal(p));
  return ball;
}

/// Bolts cover 30 to 65 pixels in these runs, and from 50 on they stay.
TestMesh bolt(Vec3 at) {
  TestMesh bolt = placed(testing::with_flat_normals(testing::cube(2)), 0.05f, at, 2, rgba8(200, 200, 210));
  bolt.area_threshold_px = 50;
  return bolt;
}

/// A plate with bolts, a dome, a ring and a box: every level, with and without normals and colours.
std::vector<TestMesh> assembly() {
  std::vector<TestMesh> meshes{
      plate(),
      with_quota(placed(ball(), 0.4f, {-0.4f, 0.3f, 0.5f}, 3, rgba8(230, 140, 40)), QuotaKind::kFaces, 300),
      with_quota(placed(scenes::torus(0.35f, 0.12f, 40, 20), 1, {0.5f, 0.3f, 0.4f}, 3, {}), QuotaKind::kNone, 0),
      placed(testing::with_flat_normals(testing::cube(2)), 0.2f, {0.3f, -0.7f, 0.2f}, 1, rgba8(60, 90, 200)),
      placed(testing::cube(2), 0.1f, {-0.5f, -0.6f, 0.5f}, 4, rgba8(255, 60, 60)),
      placed(testing::grid(1, 20), 0.04f, {-0.1f, -0.9f, 0.5f}, 5, rgba8(255, 255, 120))};
  for (int i = 0; i < 6; ++i) {
    const float along = -0.9f + 0.34f * static_cast<float>(i);
    meshes.push_back(bolt({along, 0.85f, 0.2f}));
    meshes.push_back(bolt({along, -0.95f, 0.4f}));
  }
  meshes.back().flags = firmware::format::kFlagTelltale;
  return meshes;
}

/// Many small level-3 meshes, so that their copies fill the RAM and not the room to work in, and bolts that stay.
testing::RomImage crowd_rom() {
  testing::Mesh bead = testing::icosphere(2);
  for (const Vec3& p : bead.positions) bead.normals.push_back(pack_normal(p));
  std::vector<TestMesh> meshes;
  for (int i = 0; i < 40; ++i) {
    const Vec3 at{0.25f * static_cast<float>(i % 8) - 0.9f, 0.25f * static_cast<float>(i / 8) - 0.5f, 0};
    meshes.push_back(placed(bead, 0.11f, at, 3, rgba8(230, 140, 40)));
  }
  for (int i = 0; i < 8; ++i) {
    meshes.push_back(bolt({0.25f * static_cast<float>(i) - 0.95f, 0.8f, 0}));
    meshes.back().area_threshold_px = 0;
  }
  meshes.push_back(
      placed(testing::with_flat_normals(testing::cube(2)), 0.1f, {-0.1f, -0.9f, 0}, 1, rgba8(60, 90, 200)));
  return testing::container_rom(meshes);
}

testing::RomImage assembly_rom() { return testing::container_rom(assembly()); }

testing::RomImage bare_assembly_rom() {
  std::vector<TestMesh> strips;
  for (const TestMesh& mesh : assembly()) strips.push_back(testing::as_strip(mesh));
  return testing::bare_rom(strips);
}

sim::BoardDescription with_ram(sim::BoardDescription board, std::size_t bytes) {
  board.ram_bytes = bytes;
  return board;
}

firmware::ThinningSettings one_budget(std::uint32_t faces) {
  firmware::ThinningSettings settings;
  settings.quota = {QuotaKind::kFaces, faces};
  settings.placement = firmware::Placement::kMidpoint;
  return settings;
}

}  // namespace

std::span<const DeviceRun> all_runs() {
  static const std::vector<DeviceRun> runs{
      {"run-01-levels",
       "a container of every level, thinned as its authors say",
       sim::host_sim(),
       240,
       160,
       assembly_rom,
       {},
       {0.3}},
      {"run-02-bare",
       "the same shapes in bare drawing data, 16 bits a pixel",
       sim::small_board(),
       240,
       136,
       bare_assembly_rom,
       {},
       {0.3}},
      {"run-03-budget",
       "one budget over the level-3 meshes, midpoint placement",
       sim::host_sim(),
       240,
       160,
       assembly_rom,
       one_budget(600),
       {0.3}},
      {"run-04-turn",
       "bolts come and go as the camera turns",
       sim::host_sim(),
       240,
       160,
       assembly_rom,
       {},
       {-0.5, 0.1, 0.7}},
      {"run-05-short-of-ram",
       "quotas halved for want of RAM",
       with_ram(sim::host_sim(), 100'000),
       240,
       160,
       crowd_rom,
       {},
       {0.3}},
  };
  return runs;
}

RunPicture draw_run(const DeviceRun& run, std::span<const double> azimuths_rad, std::uint32_t threads) {
  sim::DeskConfig config;
  config.board = run.board;
  config.width = run.width;
  config.height = run.height;
  config.threads = threads;
  const testing::RomImage rom = run.rom();
  sim::Desk desk(config, rom.bytes(), run.name);
  RunPicture result;
  for (const double azimuth : azimuths_rad) {
    firmware::FrameRequest request = testing::request_for(desk, azimuth);
    request.thinning = run.thinning;
    const auto shown = desk.draw(request);
    result.picture = shown.picture;
    result.signature_crc = shown.record.crc32;
    result.thinning = shown.record.firmware.thinning;
  }
  result.vram_crc = sim::picture_crc32(desk.picture_in_vram());
  return result;
}

}  // namespace usuzumi::golden
