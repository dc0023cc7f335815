#include "sim/cli/thin_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/simplify/simplify.h"
#include "sim/cli/mesh_writer.h"
#include "sim/cli/option_values.h"
#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/progress.h"
#include "sim/common/report_errors.h"
#include "sim/machine/host_stopwatch.h"
#include "sim/pack/load_model.h"
#include "sim/pack/rom_report.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

struct ThinOptions {
  fs::path input, output;
  std::string faces;
  std::string placement = "optimal";
  bool colours = false;
  bool json = false;
};

/// All meshes of a model as one surface: a vertex per place, or per place and colour.
class JoinedMesh {
 public:
  explicit JoinedMesh(bool with_colours) : with_colours_(with_colours) {}

  std::uint32_t vertex(Vec3 p, Rgba8 colour) {
    const Vec3 key{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};  // -0 becomes 0
    const auto [found, fresh] =
        numbers_.try_emplace({key, with_colours_ ? colour.bits : 0u}, static_cast<std::uint32_t>(positions.size()));
    if (fresh) {
      positions.push_back(key);
      if (with_colours_) colours.push_back(colour);
    }
    return found->second;
  }

  /// Faces that use a place twice have no area and are left out.
  void face(const std::uint32_t v[3]) {
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return;
    indices.insert(indices.end(), v, v + 3);
  }

  std::vector<Vec3> positions;
  std::vector<Rgba8> colours;
  std::vector<std::uint32_t> indices;

 private:
  struct Key {
    Vec3 place;
    std::uint32_t colour;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint32_t w[4];
      std::memcpy(w, &key.place, 12);
      w[3] = key.colour;
      std::uint64_t h = 0;
      for (std::uint32_t x : w) h = (h ^ x) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
      return static_cast<std::size_t>(h);
    }
  };
  bool with_colours_;
  std::unordered_map<Key, std::uint32_t, Hash> numbers_;
};

JoinedMesh join_rom(const std::vector<std::byte>& rom, const fs::path& path, bool with_colours) {
  const Progress progress("reading " + path.string());
  const auto data = firmware::DrawingData::open(rom);
  if (!data.ok()) throw Error(ExitCode::kBadInput, unsound_line(rom, path.string(), data.status()));
  JoinedMesh joined(with_colours);
  data->for_each_mesh([&](const firmware::MeshView& mesh) {
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      std::uint32_t v[3];
      mesh.face(f, v);
      for (std::uint32_t& i : v)
        i = joined.vertex(mesh.positions[i], mesh.colours.empty() ? mesh.base_colour : mesh.colours[i]);
      joined.face(v);
    }
  });
  return joined;
}

JoinedMesh join_model(const Model& model, bool with_colours) {
  const Progress progress("joining the meshes");
  JoinedMesh joined(with_colours);
  for (const Mesh& mesh : model.meshes)
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      std::uint32_t v[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = mesh.indices[3 * f + k];
        v[k] = joined.vertex(mesh.positions[i], mesh.colours.empty() ? mesh.base_colour : mesh.colours[i]);
      }
      joined.face(v);
    }
  return joined;
}

/// A container says so itself, whatever it is called; bare drawing data can only be told by the name.
bool is_rom(const fs::path& path) {
  std::uint32_t magic = 0;
  std::error_code none;
  if (fs::is_regular_file(path, none))
    std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(&magic), sizeof magic);
  const std::string extension = lower_extension(path);
  return magic == firmware::format::kMagic || extension == ".rom" || extension == ".bin";
}

JoinedMesh load_joined(const fs::path& path, bool with_colours) {
  if (is_rom(path)) return join_rom(read_file(path), path, with_colours);
  if (!is_model_file_name(path))
    throw Error(ExitCode::kBadInput,
                fmt::format("{}: neither a ROM image nor a model; the models read here are {}, bare "
                            "drawing data are called .rom or .bin",
                            path.string(), kModelExtensions));
  return join_model(load_model(path), with_colours);
}

std::uint32_t target_of(const FaceQuota& quota, std::uint64_t faces) {
  if (quota.kind == firmware::format::QuotaKind::kFaces) return quota.value;
  return static_cast<std::uint32_t>(faces * quota.value / 1'000'000);
}

/// The host's memory as the arena that a board would give: not touched where it is not used.
class HostArena {
 public:
  explicit HostArena(std::size_t bytes) : memory_(new std::byte[bytes]), arena({memory_.get(), bytes}) {}

 private:
  std::unique_ptr<std::byte[]> memory_;

 public:
  Arena arena;
};

template <class T>
std::span<T> copied_into(Arena& arena, const std::vector<T>& source) {
  const auto to = arena.allocate<T>(source.size());
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = source[i];
  return to;
}

int thin(const ThinOptions& options) {
  if (!is_mesh_file_name(options.output))
    throw Error(ExitCode::kUsage,
                fmt::format("-o {}: meshes are written as .ply or .obj; choose one of these extensions",
                            options.output.string()));
  if (options.colours && !keeps_colours(options.output))
    throw Error(ExitCode::kUsage, fmt::format("--colours: {} cannot hold them; write a .ply or leave --colours out",
                                              options.output.string()));
  const FaceQuota quota = quota_option("--faces", options.faces);
  check_output(options.output, "-o", std::array{options.input});
  const JoinedMesh joined = load_joined(options.input, options.colours);
  if (joined.indices.empty())
    throw Error(ExitCode::kBadInput, fmt::format("{}: the model has no faces to thin", options.input.string()));

  const auto vertices_in = static_cast<std::uint32_t>(joined.positions.size());
  const auto faces_in = static_cast<std::uint32_t>(joined.indices.size() / 3);
  constexpr std::size_t kSlack = 256;  // alignment of each array
  HostArena host(joined.positions.size() * sizeof(Vec3) + joined.colours.size() * sizeof(Rgba8) +
                 joined.indices.size() * 4 +
                 firmware::simplify_scratch_bytes(firmware::Method::kQem, vertices_in, faces_in, false) + kSlack);
  firmware::WorkingMesh mesh;
  mesh.positions = copied_into(host.arena, joined.positions);
  mesh.colours = copied_into(host.arena, joined.colours);
  mesh.indices = copied_into(host.arena, joined.indices);
  mesh.vertex_count = vertices_in;
  mesh.face_count = faces_in;

  const HostStopwatch stopwatch;
  const auto outcome = [&] {
    const Progress progress("thinning " + options.input.string());
    return firmware::simplify(
        mesh, {.target_faces = target_of(quota, faces_in), .placement = placement_option(options.placement)},
        host.arena);
  }();
  const double thin_ms = stopwatch.elapsed_ms();
  if (!outcome.ok())
    throw Error(ExitCode::kDevice, fmt::format("{}: {}", options.input.string(), outcome.status().message));

  write_mesh(options.output, {mesh.positions.first(mesh.vertex_count),
                              mesh.colours.first(mesh.colours.empty() ? 0 : mesh.vertex_count),
                              mesh.indices.first(std::size_t{3} * mesh.face_count)});
  const bool reached = outcome->stop == firmware::StopReason::kQuotaReached;
  if (options.json) {
    const nlohmann::ordered_json report{{"faces_in", faces_in},
                                        {"faces_out", mesh.face_count},
                                        {"vertices_in", vertices_in},
                                        {"vertices_out", mesh.vertex_count},
                                        {"thin_ms", thin_ms},
                                        {"ram_peak_bytes", host.arena.high_water()},
                                        {"max_error", outcome->max_error},
                                        {"quota_reached", reached}};
    fmt::print("{}\n", report.dump(2));
    return exit_status(ExitCode::kOk);
  }
  fmt::print("{}: {} faces -> {} faces, {} -> {} vertices, {:.1f} ms, {:.1f} MB of RAM, largest error {:.3g}\n",
             options.output.string(), faces_in, mesh.face_count, vertices_in, mesh.vertex_count, thin_ms,
             static_cast<double>(host.arena.high_water()) / 1e6, outcome->max_error);
  if (!reached)
    fmt::print(
        "The quota was not reached: every collapse left would turn a face over, make a sliver or break the surface.\n");
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
  command->add_option("--placement", options->placement, "Where a collapsed edge's vertex goes")
      ->check(CLI::IsMember({"optimal", "midpoint"}))
      ->capture_default_str();
  command->add_flag("--colours", options->colours, "Keep vertex colours (PLY), and the borders between them");
  command->add_flag("--json", options->json, "Report as JSON: faces, vertices, thin_ms, ram_peak_bytes, max_error");
  command->footer(
      "The model's meshes are joined and vertices at equal positions welded; the quota is over the whole.\n"
      "Example: usuzumi thin fish.obj -o fish-5.ply --faces 5%");
  command->callback([options, &exit_code] { report_errors(exit_code, [&] { return thin(*options); }); });
}

}  // namespace usuzumi::sim
