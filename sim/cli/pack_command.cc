#include "sim/cli/pack_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "firmware/drawing_data/drawing_data.h"
#include "sim/cli/option_values.h"
#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/progress.h"
#include "sim/common/report_errors.h"
#include "sim/common/standard_streams.h"
#include "sim/machine/board.h"
#include "sim/pack/join_parts.h"
#include "sim/pack/layer_chains.h"
#include "sim/pack/layer_report.h"
#include "sim/pack/levels.h"
#include "sim/pack/load_model.h"
#include "sim/pack/method_settings.h"
#include "sim/pack/names.h"
#include "sim/pack/prepare_textures.h"
#include "sim/pack/rom_writer.h"
#include "sim/pack/scene_file.h"
#include "sim/pack/tag_values.h"
#include "sim/pack/textured.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

struct PackOptions {
  std::vector<std::string> inputs;
  std::string output;
  std::string board;
  std::vector<std::string> sidecars, levels, quotas, areas, telltales, methods, layers, joins;
  std::optional<std::uint32_t> default_level;
  std::string texels = "auto";
  bool mips = true;
  std::uint32_t texture_size = firmware::format::kMaxTextureSize;
  bool bare = false;
  unsigned time_limit_s = 300;
};

/// By the words of --texture-format.
std::map<std::string, TexelChoice> texel_choices() {
  return {{"auto", TexelChoice::kAuto},
          {"rgb565", TexelChoice::kRgb565},
          {"xrgb8888", TexelChoice::kXrgb8888},
          {"argb8888", TexelChoice::kArgb8888}};
}

std::vector<TagRule> option_rules(const PackOptions& options) {
  std::vector<TagRule> rules;
  for (const std::string& a : options.levels) rules.push_back(rule_from_option("--level", a, kLevelKey));
  for (const std::string& a : options.quotas) rules.push_back(rule_from_option("--quota", a, kQuotaKey));
  for (const std::string& a : options.areas) rules.push_back(rule_from_option("--area", a, kAreaKey));
  for (const std::string& a : options.methods) rules.push_back(rule_from_option("--method", a, kMethodKey));
  for (const std::string& a : options.layers) rules.push_back(layers_rule(a));
  for (const std::string& name : options.telltales) {
    TagRule rule{name, {}, "--telltale " + name};
    rule.tags.telltale = true;
    rules.push_back(std::move(rule));
  }
  return rules;
}

std::vector<TagRule> sidecar_rules(const PackOptions& options) {
  std::vector<TagRule> rules;
  for (const std::string& file : options.sidecars)
    for (TagRule& rule : read_sidecar(file)) rules.push_back(std::move(rule));
  return rules;
}

/// Whether the tags say more than a level.
bool beyond_level(Tags tags) {
  tags.level.reset();
  return tags.any();
}

/// The patent's layout has a level and nothing else: what it cannot keep must not be asked for.
void check_bare_can_keep(const std::vector<TagRule>& rules, ExitCode code) {
  for (const TagRule& rule : rules)
    if (beyond_level(rule.tags))
      throw Error(
          code,
          fmt::format("{}: --bare keeps levels only, no quota, area, telltale, method, settings, regions or layers; "
                      "leave --bare or this out",
                      rule.origin));
}

void note_what_bare_loses(Model& model) {
  const auto tagged =
      std::count_if(model.meshes.begin(), model.meshes.end(), [](const Mesh& mesh) { return beyond_level(mesh.tags); });
  const auto textured = std::count_if(model.meshes.begin(), model.meshes.end(),
                                      [](const Mesh& mesh) { return !mesh.texture_coordinates.empty(); });
  model.notes.push_back(
      "bare drawing data keep positions, faces (as one strip a mesh) and levels; names, normals, colours and sidedness "
      "are lost");
  if (tagged > 0)
    model.notes.push_back(fmt::format(
        "face quotas, area thresholds, telltale marks, methods or layers of {} meshes are lost as well", tagged));
  if (textured > 0) model.notes.push_back(fmt::format("the textures of {} meshes are lost as well", textured));
}

std::vector<fs::path> paths(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

/// Counted in the ROM, not in the model: a bare mesh repeats vertices to stay one strip.
void print_summary(const PackOptions& options, const firmware::DrawingData& data) {
  std::size_t vertices = 0, faces = 0;
  data.for_each_mesh([&](const firmware::MeshView& mesh) {
    vertices += mesh.positions.size();
    faces += mesh.proper_face_count();
  });
  const LayerTotals layers = layer_totals(data);
  const std::size_t solids = data.solids().solids.size();
  fmt::print("{}: {}, {} meshes, {} vertices, {} faces{}, {} bytes{}\n", options.output,
             options.bare ? "bare drawing data" : "container", data.mesh_max(), vertices, faces,
             solids == 0 ? "" : fmt::format(", {} solids", solids), data.bytes().size(),
             layers.meshes == 0 ? "" : fmt::format(", {} of them layers of {} meshes", layers.bytes, layers.meshes));
}

/// As the firmware will find it in `rom`.
firmware::DrawingData checked(const std::vector<std::byte>& rom) {
  const auto opened = firmware::DrawingData::open(rom);
  if (!opened.ok())
    throw std::logic_error(
        fmt::format("the ROM just made is unsound: {} {}", opened.status().message, opened.status().where));
  return *opened;
}

/// The last that happens to the model: chains of layers are of the order of vertices and faces that goes into ROM.
void prepare(Model& model, const PackOptions& options) {
  prepare_textures(model, options.texture_size);
  make_layer_chains(model);
}

/// Model files, and scene files with the models that they name, which are added to `read`.
Model load_inputs(const std::vector<fs::path>& inputs, const LoadOptions& options, std::vector<fs::path>& read) {
  Model all;
  std::vector<fs::path> models;
  fs::path scene_before;
  for (const fs::path& input : inputs) {
    if (!is_scene_file_name(input)) {
      models.push_back(input);
      continue;
    }
    if (!scene_before.empty())
      throw Error(ExitCode::kUsage, fmt::format("{} and {} are two scene files; put their solids into one",
                                                scene_before.string(), input.string()));
    scene_before = input;
    SceneFile scene = read_scene_file(input);
    append_model(all, std::move(scene.model));
    models.insert(models.end(), scene.models.begin(), scene.models.end());
    read.insert(read.end(), scene.models.begin(), scene.models.end());
  }
  append_model(all, load_models(models, options));
  return all;
}

int pack(const PackOptions& options) {
  const std::vector<TagRule> from_options = option_rules(options), from_sidecars = sidecar_rules(options);
  const std::vector<fs::path> inputs = paths(options.inputs);
  std::vector<fs::path> read = inputs;
  read.insert(read.end(), options.sidecars.begin(), options.sidecars.end());
  check_output(options.output, "-o", read);
  if (options.bare && !options.board.empty())
    throw Error(ExitCode::kUsage, "--bare has no room for the name of a board; leave --bare or --board out");
  if (options.bare) {
    check_bare_can_keep(from_options, ExitCode::kUsage);
    check_bare_can_keep(from_sidecars, ExitCode::kBadInput);
  }
  Model model = load_inputs(inputs, {std::chrono::seconds(options.time_limit_s)}, read);
  check_output(options.output, "-o", read);
  if (options.bare && !model.solids.empty())
    throw Error(ExitCode::kUsage, "--bare has no room for solids; leave --bare or the scene file out");
  check_output(options.output, "-o", paths(model.part_files));
  join_parts(model, options.joins);
  apply_tags(model, {from_options, from_sidecars, options.default_level});
  if (options.bare) note_what_bare_loses(model);
  else prepare(model, options);

  std::optional<Progress> writing(std::in_place, "writing " + options.output);
  const std::vector<std::byte> rom =
      options.bare ? write_bare(model)
                   : write_container(model, {options.board, texel_choices().at(options.texels), options.mips});
  const firmware::DrawingData data = checked(rom);
  write_file_atomically(options.output, rom);
  writing.reset();
  print_notes(model.notes);
  if (!options.board.empty() && find_board(options.board) == nullptr)
    print_note(fmt::format("--board {} is no board that usuzumi run knows; right if it is your own", options.board));
  print_summary(options, data);
  return exit_status(ExitCode::kOk);
}

constexpr const char* kFooter =
    R"(Here the name of the node that places the mesh is found as well; the ROM keeps the mesh's name alone.

Levels: 0 unset, 1 keep, 2 delete, 3 collapse, 4 point, 5 line. Precedence: options, sidecar, the node's
extras, the mesh's extras, --default-level; of several rules from one place that fit a mesh the last wins.

Examples:
  usuzumi pack car.glb -o car.rom --default-level 1 --level 'Wheel*=3' --quota 'Wheel*=25%' --area 'Wheel*=400'
  usuzumi pack earth.glb -o earth.rom --default-level 3 --layers 100,60,36,21.6
  usuzumi pack car.glb -o car.rom --sidecar levels.json
where levels.json is
  {"meshes": {"Wheel*": {"thinning_level": 3, "face_quota": "25%", "area_threshold_px": 400, "telltale": false},
              "Body": {"thinning_level": 3, "method": "edge-removal",
                       "method_settings": {"a": 1, "b": 0.1, "placement": "automatic"},
                       "regions": [{"group": "rim", "locked": true}, {"material": "logo", "value": 5}],
                       "layers": [100, 60, 36, 21.6]}}}
The README has all settings of methods. A texture that is missing or broken is told of, and its meshes are packed
without it.)";

}  // namespace

void add_pack_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PackOptions>();
  CLI::App* command = app.add_subcommand("pack", "Turn 3D models into a ROM image of drawing data");
  command
      ->add_option("INPUT", options->inputs,
                   fmt::format("Model files: {}; or a scene file of solids and models: .json", kModelExtensions))
      ->required();
  command->add_option("-o,--output", options->output, "ROM image to write")->required();
  // Each takes one argument, so that an INPUT may follow; each may be repeated.
  auto repeated = [&](const char* name, std::vector<std::string>& values, const char* help) {
    return command->add_option(name, values, help)->allow_extra_args(false);
  };
  repeated("--sidecar", options->sidecars, "JSON file with thinning properties by mesh name")->type_name("FILE.json");
  repeated("--level", options->levels, "Thinning level of a mesh, 0 to 5")->type_name("NAME=LEVEL");
  repeated("--quota", options->quotas, "Faces to keep at level 3: a count or a share")->type_name("NAME=N|P%");
  repeated("--area", options->areas, "Area on screen up to which levels 2 to 5 act, in pixels")->type_name("NAME=PX");
  repeated("--method", options->methods, "How level 3 thins: qem, edge-removal, half-edge or vertex-deletion")
      ->type_name("NAME=METHOD");
  repeated("--layers", options->layers,
           "Layers of a mesh, or of every mesh of level 3, in per cent of its faces, like 100,60,36,21.6; every step "
           "between them goes into ROM, and the device need not search for it")
      ->type_name("[NAME=]LIST");
  repeated("--join", options->joins, "Keep the materials of a mesh together, so that no crack opens between them")
      ->type_name("NAME");
  repeated("--telltale", options->telltales, "Never drop this mesh, whatever memory or policy say")->type_name("NAME");
  command->add_option("--default-level", options->default_level, "Level of the meshes that have none")
      ->transform(whole_number(0, firmware::kLevelCount - 1));
  command
      ->add_option("--texture-format", options->texels,
                   "Texels in ROM: auto loses nothing (xrgb8888, argb8888 where alpha is used); rgb565 takes half, "
                   "dithered; textures whose alpha is used are argb8888 always")
      ->check(CLI::IsMember(texel_choices()))
      ->capture_default_str();
  command->add_flag("--mips,!--no-mips", options->mips,
                    "Smaller levels of each texture too, against glitter, for a third more ROM; they are the default");
  command
      ->add_option("--texture-size", options->texture_size, "Halve larger textures until they are no larger, in texels")
      ->transform(whole_number(1, firmware::format::kMaxTextureSize))
      ->capture_default_str();
  command->add_option("--board", options->board, "The only board that will take the ROM; without it any does")
      ->check([](const std::string& name) { return name.empty() ? std::string("must not be empty") : std::string(); });
  command->add_flag("--bare", options->bare, "Write the patent's layout alone: strips of positions, and levels");
  command->add_option("--time-limit", options->time_limit_s, "Seconds after which reading a file is given up")
      ->transform(whole_number(1, 86400))
      ->capture_default_str();
  command->footer(fmt::format("{}\n{}", kNamesHelp, kFooter));
  command->callback([options, &exit_code] { report_errors(exit_code, [&] { return pack(*options); }); });
}

}  // namespace usuzumi::sim
