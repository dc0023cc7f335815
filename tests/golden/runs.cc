#include "tests/golden/runs.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "hal/crc32.h"
#include "sim/pack/layer_chains.h"
#include "sim/pack/load_model.h"
#include "sim/pack/prepare_textures.h"
#include "sim/pack/rom_writer.h"
#include "sim/pack/scene_file.h"
#include "tests/support/desk_request.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/scene_meshes.h"
#include "tests/support/test_meshes.h"

namespace usuzumi::golden {
namespace {

using firmware::format::QuotaKind;
using testing::TestMesh;

constexpr std::size_t kKiB = 1024, kMiB = 1024 * kKiB;

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

/// The same kinds of meshes in sizes that 320 KiB of RAM thin.
testing::RomImage small_assembly_rom() {
  testing::Mesh dome = testing::icosphere(3);
  for (const Vec3& p : dome.positions) dome.normals.push_back(pack_normal(p));
  std::vector<TestMesh> meshes = assembly();
  meshes[1] = with_quota(placed(dome, 0.4f, {-0.4f, 0.3f, 0.5f}, 3, rgba8(230, 140, 40)), QuotaKind::kFaces, 300);
  meshes[2] = placed(scenes::torus(0.35f, 0.12f, 24, 12), 1, {0.5f, 0.3f, 0.4f}, 3, {});
  for (std::size_t i = 6; i < meshes.size(); ++i) meshes[i].area_threshold_px = -1;  // bolts go however large
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

constexpr std::uint32_t kEarthLayers[] = {1'000'000, 600'000, 360'000, 216'000};

/// The sphere of US 6,396,952's example with its map, small enough for every board.
testing::RomImage earth_rom(firmware::Method method, bool with_layers = false) {
  sim::Model model = sim::load_model(USUZUMI_EARTH);
  sim::prepare_textures(model, 128);
  for (sim::Mesh& mesh : model.meshes) {
    mesh.tags.level = 3;
    mesh.tags.method = method;
    if (with_layers) mesh.tags.layers = {std::begin(kEarthLayers), std::end(kEarthLayers)};
  }
  if (with_layers) sim::make_layer_chains(model);
  return testing::RomImage::of(sim::write_container(model, {.texels = sim::TexelChoice::kRgb565}));
}

/// Steps of 60 % as the patent's example takes them.
DeviceRun globe(const char* name, const char* note, firmware::Method method) {
  DeviceRun run{name, note, with_ram(sim::host_sim(), 320 * kKiB), 240, 160, [method] { return earth_rom(method); }, {},
                {0.3, 0.3, 0.3}, {}};
  run.quotas_millionths = {600'000, 360'000, 216'000};
  return run;
}

/// Between layers, as a quota falls.
DeviceRun middle_layers() {
  DeviceRun run = globe("run-12-middle-layers", "the globe between its layers, made by pack", firmware::Method::kQem);
  run.rom = [] { return earth_rom(firmware::Method::kQem, true); };
  run.thinning.layers.mode = firmware::LayerMode::kQuota;
  run.quotas_millionths = {900'000, 500'000, 270'000};
  return run;
}

/// Any number of faces by replay.
DeviceRun boot_layers() {
  DeviceRun run = globe("run-13-boot-layers", "the globe's collapses replayed; its layers are made at boot",
                        firmware::Method::kHalfEdge);
  run.quotas_millionths = {300'000, 800'000, 450'000};
  run.boot_layers_millionths = {std::begin(kEarthLayers), std::end(kEarthLayers)};
  return run;
}

/// By all members, then by one table of the paper's after another.
DeviceRun solids() {
  DeviceRun run{"run-14-solids", "a cat of 63 solids by their four members", with_ram(sim::host_sim(), 320 * kKiB),
                240, 160,
                [] { return testing::RomImage::of(sim::write_container(sim::read_scene_file(USUZUMI_CAT).model)); },
                {}, {0.3, 0.7, -0.4}, {}};
  run.thresholds = {{1, 0, 0}, {1024, 1024, 0}, {24, 16, 8}};
  return run;
}

firmware::ThinningSettings one_budget(std::uint32_t faces) {
  firmware::ThinningSettings settings;
  settings.quota = {QuotaKind::kFaces, faces};
  settings.placement = firmware::Placement::kMidpoint;
  return settings;
}

/// The plate and the dome are collapsed, the ring is not; half of the bolts go.
firmware::ThinningSettings chosen_and_random() {
  static constexpr std::uint32_t kPlateAndDome[] = {0, 1};
  firmware::ThinningSettings settings;
  settings.collapse_policy.kind = firmware::PolicyKind::kChosen;
  settings.collapse_policy.chosen = kPlateAndDome;
  settings.delete_policy.kind = firmware::PolicyKind::kRandom;
  settings.delete_policy.random_millionths = 500'000;
  settings.delete_policy.seed = 7;
  return settings;
}

/// "NAME/what-7" with as many digits as asked for.
std::string below(const DeviceRun& run, const char* what, std::size_t number, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "/%s-%0*zu", what, digits, number);
  return run.name + std::string(text);
}

Entry frame_entry(const DeviceRun& run, std::size_t frame, bool last, const sim::Image& picture) {
  return {last ? run.name : below(run, "frame", frame, 1), picture.width, picture.height, sim::picture_crc32(picture),
          last ? run.note : "shown before it"};
}

const char* what_was_done(const firmware::MeshState& state, const firmware::CopyMesh& mesh) {
  if (mesh.layered) return mesh.vertices_in_rom ? "from layers, vertices in ROM" : "from layers";
  if (state.build.outcome == firmware::BuildOutcome::kUnthinned) return "copied for want of RAM to thin it in";
  switch (state.decision.action) {
    case firmware::Action::kCollapse: 
      if (!state.build.collapsed) return "copied, within its quota";
      return mesh.vertices_in_rom ? "collapsed, vertices in ROM" : "collapsed";
    case firmware::Action::kPoint: return "one point";
    case firmware::Action::kLine: return "one line";
    case firmware::Action::kKeep:
    case firmware::Action::kDelete: break;
  }
  return "copied";
}

void append_meshes(const DeviceRun& run, const firmware::Thinning& thinning, std::vector<Entry>& entries) {
  const firmware::RamCopy& copy = thinning.copy();
  for (std::uint32_t n = 0; n < copy.mesh_max(); ++n) {
    if (!copy.present(n)) continue;
    const firmware::CopyMesh& mesh = copy.mesh(n);
    const firmware::MeshState& state = thinning.state(n);
    const std::string faces = std::to_string(mesh.faces) + " of " + std::to_string(state.faces) + " faces";
    entries.push_back({below(run, "mesh", n, 2), mesh.vertex_count, mesh.index_count,
                       crc32(kCrc32Start, {copy.block(n), copy.block_bytes(n)}),
                       what_was_done(state, mesh) + (", " + faces)});
  }
}

const char* const kBallTooLarge = "takes 384 KiB of RAM, most of it to thin the ball; the board thins in 320";

}  // namespace

std::span<const DeviceRun> all_runs() {
  static const std::vector<DeviceRun> runs{
      {"run-01-levels",
       "a container of every level, thinned as its authors say",
       with_ram(sim::host_sim(), kMiB),
       240,
       160,
       assembly_rom,
       {},
       {0.3},
       {{"cortex-m7", kBallTooLarge}}},
      {"run-02-bare",
       "the same shapes in bare drawing data, 16 bits a pixel",
       sim::small_board(),
       240,
       136,
       bare_assembly_rom,
       {},
       {0.3},
       {{"cortex-m7", "takes 1330 KiB of RAM for strips of single faces; the board thins in 320"}}},
      {"run-03-budget",
       "one budget over the level-3 meshes, midpoint placement",
       with_ram(sim::host_sim(), kMiB),
       240,
       160,
       assembly_rom,
       one_budget(600),
       {0.3},
       {{"cortex-m7", kBallTooLarge}}},
      {"run-04-turn",
       "bolts come and go as the camera turns",
       with_ram(sim::host_sim(), kMiB),
       240,
       160,
       assembly_rom,
       {},
       {-0.5, 0.1, 0.7},
       {{"cortex-m7", kBallTooLarge}}},
      {"run-05-short-of-ram",
       "quotas halved for want of RAM",
       with_ram(sim::host_sim(), 100'000),
       240,
       160,
       crowd_rom,
       {},
       {0.3},
       {}},
      {"run-06-wide",
       "a cluster's whole width",
       with_ram(sim::host_sim(), kMiB),
       1920,
       720,
       assembly_rom,
       {},
       {0.3},
       {{"cortex-m7", "two pictures and depth of 1920x720 take 15.8 MiB of VRAM; the board has 4"},
        {"cortex-a9", "two pictures and depth of 1920x720 take 15.8 MiB of VRAM; the board gives 8"}}},
      {"run-07-small-cluster",
       "a small cluster's panel in 16 bits, turning; chosen and random meshes thinned within 320 KiB",
       with_ram(sim::small_board(), 320 * kKiB),
       480,
       272,
       small_assembly_rom,
       chosen_and_random(),
       {0.3, 0.9},
       {}},
      globe("run-08-globe-qem", "a globe with a map, 60 % of its faces three times over, by quadric error",
            firmware::Method::kQem),
      globe("run-09-globe-edge-removal", "the same by edge removal", firmware::Method::kEdgeRemoval),
      globe("run-10-globe-half-edge", "the same by half-edge collapse", firmware::Method::kHalfEdge),
      globe("run-11-globe-vertex-deletion", "the same by vertex deletion", firmware::Method::kVertexDeletion),
      middle_layers(),
      boot_layers(),
      solids(),
  };
  return runs;
}

RunPicture draw_run(const DeviceRun& run, std::size_t first_frame, std::uint32_t threads) {
  sim::DeskConfig config;
  config.board = run.board;
  config.width = run.width;
  config.height = run.height;
  config.threads = threads;
  config.boot_layers_millionths = run.boot_layers_millionths;
  const testing::RomImage rom = run.rom();
  sim::Desk desk(config, rom.bytes(), run.name);
  RunPicture result;
  for (std::size_t frame = first_frame; frame < run.azimuths_rad.size(); ++frame) {
    firmware::FrameRequest request = testing::request_for(desk, run.azimuths_rad[frame]);
    request.thinning = run.thinning;
    if (!run.quotas_millionths.empty())
      request.thinning.quota = {QuotaKind::kMillionths, run.quotas_millionths[frame]};
    if (!run.thresholds.empty()) request.solids.thresholds = run.thresholds[frame];
    const auto shown = desk.draw(request);
    const bool last = frame + 1 == run.azimuths_rad.size();
    result.entries.push_back(frame_entry(run, frame, last, shown.picture));
    if (!last) continue;
    result.picture = shown.picture;
    result.signature_crc = shown.record.crc32;
    result.thinning = shown.record.firmware.thinning;
    result.solids = shown.record.firmware.solids;
  }
  append_meshes(run, desk.device().thinning(), result.entries);
  std::sort(result.entries.begin(), result.entries.end(),
            [](const Entry& a, const Entry& b) { return a.name < b.name; });
  result.vram_crc = sim::picture_crc32(desk.picture_in_vram());
  result.memory = desk.memory();
  return result;
}

}  // namespace usuzumi::golden
