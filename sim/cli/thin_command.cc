#include "sim/cli/thin_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/simplify/simplify.h"
#include "sim/cli/joined_mesh.h"
#include "sim/cli/mesh_writer.h"
#include "sim/cli/option_values.h"
#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/progress.h"
#include "sim/common/report_errors.h"
#include "sim/common/standard_streams.h"
#include "sim/machine/host_stopwatch.h"
#include "sim/pack/host_arena.h"
#include "sim/pack/load_model.h"
#include "sim/pack/method_settings.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

struct ThinOptions {
  fs::path input, output;
  std::string faces;
  std::string method = "qem";
  std::vector<std::string> settings;
  std::string placement;  // empty: the method's default
  bool colours = false;
  bool textures = false;
  bool json = false;
};

std::uint32_t target_of(const FaceQuota& quota, std::uint64_t faces) {
  if (quota.kind == firmware::format::QuotaKind::kFaces) return quota.value;
  return static_cast<std::uint32_t>(faces * quota.value / 1'000'000);
}

template <class T>
std::span<T> copied_into(Arena& arena, const std::vector<T>& source) {
  const auto to = arena.allocate<T>(source.size());
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = source[i];
  return to;
}

constexpr std::array<std::string_view, 2> kQemPlacements{"optimal", "midpoint"};

/// What the method's options say. Throws Error kUsage.
firmware::SimplifyOptions simplify_options(const ThinOptions& options) {
  firmware::SimplifyOptions out;
  out.method = method_of(options.method).value_or(firmware::Method::kQem);  // the parser has checked it
  MethodSettings settings;
  for (const std::string& argument : options.settings) {
    const auto equals = argument.find('=');
    if (equals == std::string::npos)
      throw Error(ExitCode::kUsage, fmt::format("--setting {}: wants NAME=VALUE", argument));
    const std::string wrong = set_setting(settings, argument.substr(0, equals), argument.substr(equals + 1));
    if (!wrong.empty()) throw Error(ExitCode::kUsage, fmt::format("--setting {}: {}", argument, wrong));
  }
  if (out.method == firmware::Method::kQem && !options.placement.empty()) {
    if (std::find(kQemPlacements.begin(), kQemPlacements.end(), options.placement) == kQemPlacements.end())
      throw Error(ExitCode::kUsage, fmt::format("--placement {}: must be one of {} with method qem", options.placement,
                                                fmt::join(kQemPlacements, ", ")));
    out.placement = placement_option(options.placement);
  } else if (!options.placement.empty()) {
    const std::string wrong = set_setting(settings, "placement", options.placement);
    if (!wrong.empty())
      throw Error(ExitCode::kUsage,
                  fmt::format("--placement {}: {} with method {}", options.placement, wrong, options.method));
  }
  const std::string misplaced = misplaced_setting(out.method, settings);
  if (!misplaced.empty())
    throw Error(ExitCode::kUsage, fmt::format("--method {}: {}; leave it out", options.method, misplaced));
  out.edge_removal = edge_removal_settings(settings);
  out.vertex_deletion = vertex_deletion_settings(settings);
  return out;
}

void check_options(const ThinOptions& options) {
  if (!is_mesh_file_name(options.output))
    throw Error(ExitCode::kUsage,
                fmt::format("-o {}: meshes are written as .ply or .obj; choose one of these extensions",
                            options.output.string()));
  if (options.colours && !keeps_colours(options.output))
    throw Error(ExitCode::kUsage, fmt::format("--colours: {} cannot hold them; write a .ply or leave --colours out",
                                              options.output.string()));
  check_output(options.output, "-o", std::array{options.input});
}

/// What is known once the input has been read.
void check_outputs(const ThinOptions& options, const JoinedMesh& joined) {
  if (joined.indices.empty())
    throw Error(ExitCode::kBadInput, fmt::format("{}: the model has no faces to thin", options.input.string()));
  check_output(options.output, "-o", joined.files);
  print_notes(joined.notes);
  if (!options.textures) return;
  if (joined.looks.empty()) print_note(fmt::format("{}: it has no textures for --textures", options.input.string()));
  std::set<std::uint32_t> textures;
  for (const Look& look : joined.looks)
    if (look.texture) textures.insert(*look.texture);
  if (textures.size() > 1 && keeps_colours(options.output))
    throw Error(ExitCode::kUsage,
                fmt::format("--textures: the model has {} and a .ply holds one; write an .obj", textures.size()));
  for (const fs::path& file : files_beside(options.output, joined.looks)) check_output(file, "-o", joined.files);
}

/// The mesh in the arena's memory, as the firmware has it.
firmware::WorkingMesh working_mesh(Arena& arena, const JoinedMesh& joined) {
  firmware::WorkingMesh mesh;
  mesh.positions = copied_into(arena, joined.positions);
  mesh.colours = copied_into(arena, joined.colours);
  mesh.texture_coordinates = copied_into(arena, joined.texture_coordinates);
  mesh.edge_values = copied_into(arena, joined.edge_values);
  if (joined.groups.size() > 1) mesh.groups = copied_into(arena, joined.groups);
  mesh.indices = copied_into(arena, joined.indices);
  mesh.vertex_count = static_cast<std::uint32_t>(joined.positions.size());
  mesh.face_count = static_cast<std::uint32_t>(joined.indices.size() / 3);
  return mesh;
}

std::size_t bytes_of(const JoinedMesh& joined, firmware::Method method) {
  constexpr std::size_t kSlack = 512;  // alignment of each array
  const auto vertices = static_cast<std::uint32_t>(joined.positions.size());
  const auto faces = static_cast<std::uint32_t>(joined.indices.size() / 3);
  return joined.positions.size() * sizeof(Vec3) + joined.colours.size() * sizeof(Rgba8) +
         joined.texture_coordinates.size() * sizeof(TexCoord) + joined.edge_values.size() * sizeof(float) +
         joined.groups.size() * sizeof(firmware::MaterialGroup) + joined.indices.size() * 4 +
         firmware::simplify_scratch_bytes(method, vertices, faces, !joined.texture_coordinates.empty()) + kSlack;
}

void write_thinned(const ThinOptions& options, const JoinedMesh& joined, const firmware::WorkingMesh& mesh) {
  const auto first = [&](const auto& all) { return all.first(all.empty() ? 0 : mesh.vertex_count); };
  const firmware::MaterialGroup whole{mesh.face_count, mesh.vertex_count};
  MeshToWrite out;
  out.positions = first(mesh.positions);
  out.colours = first(mesh.colours);
  out.texture_coordinates = first(mesh.texture_coordinates);
  out.indices = mesh.indices.first(std::size_t{3} * mesh.face_count);
  out.groups = mesh.groups.empty() ? std::span(&whole, 1) : std::span<const firmware::MaterialGroup>(mesh.groups);
  out.looks = joined.looks;
  out.textures = joined.textures;
  write_mesh(options.output, out);
}

struct ThinReport {
  std::uint32_t faces_in = 0, vertices_in = 0;
  double thin_ms = 0;
  std::size_t ram_bytes = 0;
};

void print_report(const ThinOptions& options, const ThinReport& report, const firmware::WorkingMesh& mesh,
                  const firmware::SimplifyOutcome& outcome) {
  const bool reached = outcome.stop == firmware::StopReason::kQuotaReached;
  if (options.json) {
    const nlohmann::ordered_json json{
        {"method", options.method},           {"faces_in", report.faces_in},       {"faces_out", mesh.face_count},
        {"vertices_in", report.vertices_in},  {"vertices_out", mesh.vertex_count}, {"thin_ms", report.thin_ms},
        {"ram_peak_bytes", report.ram_bytes}, {"max_error", outcome.max_error},    {"quota_reached", reached}};
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("{}: {} faces -> {} faces, {} -> {} vertices, {:.1f} ms, {:.1f} MB of RAM, largest error {:.3g}\n",
             options.output.string(), report.faces_in, mesh.face_count, report.vertices_in, mesh.vertex_count,
             report.thin_ms, static_cast<double>(report.ram_bytes) / 1e6, outcome.max_error);
  if (!reached)
    fmt::print(
        "The quota was not reached: every {} left would turn a face over, make a sliver or break the surface{}.\n",
        options.method == "vertex-deletion" ? "deletion" : "collapse",
        options.method == "qem" ? "" : ", or is beyond the method's limits");
}

int thin(const ThinOptions& options) {
  check_options(options);
  const FaceQuota quota = quota_option("--faces", options.faces);
  firmware::SimplifyOptions simplify_with = simplify_options(options);
  const JoinedMesh joined = load_joined(options.input, {options.colours, options.textures});
  check_outputs(options, joined);

  HostArena host(bytes_of(joined, simplify_with.method));
  firmware::WorkingMesh mesh = working_mesh(host.arena, joined);
  ThinReport report{mesh.face_count, mesh.vertex_count, 0, 0};
  simplify_with.target_faces = target_of(quota, mesh.face_count);
  const HostStopwatch stopwatch;
  const auto outcome = [&] {
    const Progress progress("thinning " + options.input.string());
    return firmware::simplify(mesh, simplify_with, host.arena);
  }();
  report.thin_ms = stopwatch.elapsed_ms();
  report.ram_bytes = host.arena.high_water();
  if (!outcome.ok())
    throw Error(ExitCode::kDevice, fmt::format("{}: {}", options.input.string(), outcome.status().message));
  write_thinned(options, joined, mesh);
  print_report(options, report, mesh, *outcome);
  return exit_status(ExitCode::kOk);
}

}  // namespace

void add_thin_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ThinOptions>();
  CLI::App* command =
      app.add_subcommand("thin", "Thin one model by the firmware's own level-3 method and write it as a mesh");
  command
      ->add_option("MODEL", options->input,
                   fmt::format("A model ({}), a ROM image, or bare drawing data (.rom .bin)", kModelExtensions))
      ->required();
  command->add_option("-o,--output", options->output, "Mesh to write: .ply or .obj")->required();
  command->add_option("--faces", options->faces, "Faces to keep over the whole model: a count, or a share like 25%")
      ->required();
  command->add_option("--method", options->method, "How: qem, edge-removal, half-edge or vertex-deletion")
      ->check(CLI::IsMember(std::vector<std::string>(kMethodNames.begin(), kMethodNames.end())))
      ->capture_default_str();
  command
      ->add_option("--setting", options->settings,
                   "A setting of the method, by the names that a sidecar's method_settings has; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  command->add_option(
      "--placement", options->placement,
      "Where a collapsed edge's vertex goes: optimal (the default) or midpoint with qem; automatic (the "
      "default), equal-volume, least-volume, keep-an-end or midpoint with edge-removal");
  command->add_flag("--colours", options->colours, "Keep vertex colours (PLY), and the borders between them");
  command->add_flag(
      "--textures", options->textures,
      "Keep textures, materials and seams: beside an .obj its .mtl and .png files, beside a .ply one .png");
  command->add_flag("--json", options->json,
                    "Report as JSON: method, faces, vertices, thin_ms, ram_peak_bytes, max_error");
  command->footer(
      "The model's meshes are joined and vertices at equal positions welded; the quota is over the whole.\n"
      "Edge values and locks count where a ROM image has them.\n"
      "Examples:\n"
      "  usuzumi thin fish.obj -o fish-5.ply --faces 5%\n"
      "  usuzumi thin earth.glb -o earth-20.obj --faces 20% --textures --method edge-removal --setting b=0.5\n"
      "  usuzumi thin plate.glb -o plate-10.obj --faces 10% --method vertex-deletion --setting preset=flat");
  command->callback([options, &exit_code] { report_errors(exit_code, [&] { return thin(*options); }); });
}

}  // namespace usuzumi::sim
