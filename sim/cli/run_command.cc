#include "sim/cli/run_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/device/turntable.h"
#include "firmware/scene/camera.h"
#include "sim/cli/camera_file.h"
#include "sim/cli/option_values.h"
#include "sim/cli/policy_option.h"
#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/progress.h"
#include "sim/common/report_errors.h"
#include "sim/common/standard_streams.h"
#include "sim/desk/desk.h"
#include "sim/desk/run_report.h"
#include "sim/desk/scripted_pins.h"
#include "sim/image/png.h"
#include "sim/pack/names.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMostFrames = 1'000'000;
constexpr std::uint32_t kMostThreads = 64;

struct RunOptions {
  std::string rom;
  std::string board = "host-sim";
  std::string size;
  std::string format;
  std::uint32_t frames = 1;
  bool orbit = false;
  std::string camera;
  std::string thin = "on";
  std::string quota;
  std::string placement;
  std::string lod = "off";
  std::string attention;
  std::string boot_layers;
  std::string thresholds;
  std::vector<std::string> policies;
  std::string engine = "soft";
  std::uint32_t threads = 1;
  std::string background = "202428";
  std::string gpio;
  std::string faults;
  std::string out;
  std::string stats;
};

DeskConfig desk_config(const RunOptions& options) {
  DeskConfig config;
  config.board = *find_board(options.board);
  if (!options.size.empty()) {
    const PictureSize size = size_option("--size", options.size);
    config.width = size.width;
    config.height = size.height;
  }
  if (!options.format.empty())
    config.board.pixel_format =
        options.format == "rgb565" ? command::PixelFormat::kRgb565 : command::PixelFormat::kXrgb8888;
  config.engine = options.engine == "osmesa" ? EngineKind::kOsmesa : EngineKind::kSoft;
  config.threads = options.threads;
  if (!options.boot_layers.empty())
    config.boot_layers_millionths = layers_option("--boot-layers", options.boot_layers);
  if (!options.gpio.empty()) config.pins = parse_frame_script("--gpio", options.gpio, kPinNames);
  if (!options.faults.empty()) config.fault_script = parse_frame_script("--fault", options.faults, kFaultNames);
  return config;
}

/// The camera of frame i: from a file (its last one holds on), a turn around the model, or the standard view.
class CameraPath {
 public:
  CameraPath(const RunOptions& options, const Desk& desk)
      : bounds_(firmware::bounds_of(desk.drawing_data())),
        aspect_(static_cast<float>(desk.width()) / static_cast<float>(desk.height())),
        frames_(options.orbit ? options.frames : 0) {
    if (!options.camera.empty()) cameras_ = read_camera_file(options.camera, bounds_);
  }

  firmware::Camera at(std::uint32_t frame) const {
    if (!cameras_.empty()) return cameras_[std::min<std::size_t>(frame, cameras_.size() - 1)];
    return firmware::turntable_camera(bounds_, frame, frames_, aspect_);
  }
  float aspect() const { return aspect_; }
  std::size_t cameras() const { return cameras_.size(); }  // of the file

 private:
  firmware::Bounds bounds_;
  float aspect_;
  std::uint32_t frames_;  // of a turn; 0: the camera stands
  std::vector<firmware::Camera> cameras_;
};

Rgba8 background_option(const std::string& value) {
  const bool hex = value.size() == 6 && value.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
  if (!hex)
    throw Error(ExitCode::kUsage, fmt::format("--background {}: must be RRGGBB in hexadecimal, e.g. 202428", value));
  const auto rgb = static_cast<std::uint32_t>(std::stoul(value, nullptr, 16));
  return rgba8(rgb >> 16, rgb >> 8 & 0xFF, rgb & 0xFF);
}

/// "960,360", a place on the picture.
firmware::Attention attention_option(const std::string& value, const Desk& desk) {
  const auto comma = value.find(',');
  if (comma != std::string::npos) {
    const auto x = parse_whole_number(std::string_view(value).substr(0, comma), desk.width() - 1);
    const auto y = parse_whole_number(std::string_view(value).substr(comma + 1), desk.height() - 1);
    if (x && y) return {true, static_cast<float>(*x), static_cast<float>(*y)};
  }
  throw Error(ExitCode::kUsage,
              fmt::format("--attention {}: must be X,Y in pixels from the top left corner, at most {},{}", value,
                          desk.width() - 1, desk.height() - 1));
}

firmware::LayerMode layer_mode(const std::string& lod) {
  if (lod == "quota") return firmware::LayerMode::kQuota;
  return lod == "auto" ? firmware::LayerMode::kAutomatic : firmware::LayerMode::kFaces;
}

firmware::ThinningSettings thinning_settings(const RunOptions& options, const PolicyOptions& policies,
                                             const Desk& desk) {
  firmware::ThinningSettings settings;
  settings.enabled = options.thin == "on";
  settings.placement = placement_option(options.placement);
  if (!options.quota.empty()) {
    const FaceQuota quota = quota_option("--quota", options.quota);
    settings.quota = {quota.kind, quota.value};
  }
  settings.layers.mode = layer_mode(options.lod);
  if (!options.attention.empty()) settings.layers.attention = attention_option(options.attention, desk);
  policies.apply(settings);
  return settings;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(ExitCode::kCannotWrite,
                fmt::format("{}: cannot make the folder: {}; choose another place", folder.string(), error.message()));
}

fs::path picture_path(const RunOptions& options, std::uint32_t frame) {
  return fs::path(options.out) / fmt::format("frame-{:04}.png", frame);
}

/// Nothing is deleted that this run did not make, but a film made of the folder would be of two runs.
void note_older_pictures(const RunOptions& options) {
  constexpr std::string_view kStart = "frame-", kEnd = ".png";
  std::size_t older = 0;
  std::error_code none;  // a folder that may be written but not listed has nothing to tell
  for (const auto& entry : fs::directory_iterator(options.out, none)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kStart) || !name.ends_with(kEnd)) continue;
    const std::string_view number =
        std::string_view(name).substr(kStart.size(), name.size() - kStart.size() - kEnd.size());
    if (parse_whole_number(number, kMostFrames).value_or(0) >= options.frames) ++older;
  }
  if (older > 0)
    print_note(fmt::format("{}: {} picture(s) of an earlier run remain, from {} on; remove what is not wanted",
                           options.out, older, picture_path(options, options.frames).filename().string()));
}

void prepare_outputs(const RunOptions& options) {
  const std::array<fs::path, 2> inputs{options.rom, options.camera};
  if (!options.out.empty()) {
    make_folder(options.out);
    check_output(picture_path(options, 0), "--out", inputs);
  }
  if (!options.stats.empty()) check_output(options.stats, "--stats", inputs);  // it may lie in the new folder
}

void check_combinations(const RunOptions& options) {
  if (options.orbit && !options.camera.empty())
    throw Error(ExitCode::kUsage, "--orbit and --camera exclude each other: choose one");
  if (options.thin == "off" && (!options.quota.empty() || !options.policies.empty() || !options.placement.empty() ||
                                options.lod != "off" || !options.boot_layers.empty() || !options.thresholds.empty()))
    throw Error(ExitCode::kUsage,
                "--thin off leaves nothing for --quota, --policy, --placement, --lod, --boot-layers or --thresholds to "
                "do: drop one of them");
  if (!options.attention.empty() && options.lod != "auto")
    throw Error(ExitCode::kUsage, "--attention is for layers that follow it: give --lod auto");
  if (options.engine == "osmesa" && options.threads != 1)
    throw Error(ExitCode::kUsage, "--threads is for the soft engine: OSMesa takes its number from LP_NUM_THREADS");
}

/// Events that no frame of this run sees, and an ignition that stays off.
void note_idle_scripts(const RunOptions& options, const DeskConfig& config) {
  const auto note_late = [&](const char* option, const std::vector<FrameEvent>& events) {
    if (!events.empty() && events.back().frame >= options.frames)
      print_note(fmt::format("{}: frame {} is not drawn; give --frames {} or more", option, events.back().frame,
                             std::uint64_t{events.back().frame} + 1));
  };
  note_late("--fault", config.fault_script);
  if (!config.pins) return;
  note_late("--gpio", *config.pins);
  const bool ever_on = std::any_of(config.pins->begin(), config.pins->end(),
                                   [](const FrameEvent& e) { return e.name == "ignition" && e.level; });
  if (!ever_on) print_note("--gpio: the ignition is never on, so the panel stays dark; begin with 0:ignition=1");
}

/// Where VRAM is short the device draws in smaller formats than its board's.
void note_reduced_formats(const Desk& desk, const BoardDescription& board) {
  const firmware::VramLayout& vram = desk.vram();
  const bool pixels = vram.scanout.format != board.pixel_format, depth = vram.depth_format != board.depth_format;
  if (pixels || depth)
    print_note(fmt::format("VRAM is short: drawn {}with 16 bits of depth; choose a larger --board or a smaller --size",
                           pixels ? "in RGB565, " : ""));
}

/// Why no layers were made at boot, or empty where some were.
std::string why_no_boot_layers(const Desk& desk) {
  const firmware::DrawingData& data = desk.drawing_data();
  const auto layered = desk.layered_meshes();
  const auto in_rom = [&](std::uint32_t n) { return !data.mesh(n).layers.empty(); };
  if (!std::all_of(layered.begin(), layered.end(), in_rom)) return {};
  bool any_collapse = false, any_without = false;
  for (std::uint32_t n = 0; n < data.mesh_max(); ++n) {
    if (data.mesh(n).level != firmware::Level::kCollapse) continue;
    any_collapse = true;
    any_without = any_without || !in_rom(n);
  }
  if (!any_collapse) return "no mesh has level 3";
  return any_without ? "RAM has no room for layers, or meshes have no normals; pack --layers makes them beforehand"
                     : "every mesh of level 3 has layers in the ROM";
}

void note_missing_layers(const RunOptions& options, const Desk& desk) {
  if (!options.boot_layers.empty()) {
    const std::string why = why_no_boot_layers(desk);
    if (!why.empty()) print_note(fmt::format("--boot-layers {} has no effect: {}", options.boot_layers, why));
  } else if (options.lod != "off" && desk.layered_meshes().empty()) {
    print_note(fmt::format("--lod {} has no effect: no mesh has layers; give pack --layers or run --boot-layers",
                           options.lod));
  }
}

/// Says which options are in order but change nothing, so that nobody waits for what they should do.
void note_what_has_no_effect(const RunOptions& options, const Desk& desk, const PolicyOptions& policies,
                             const CameraPath& path) {
  for (const std::string& note : policies.notes()) print_note(note);
  const auto meshes = named_meshes(desk.drawing_data());
  const bool any_collapse = std::any_of(meshes.begin(), meshes.end(),
                                        [](const NamedMesh& mesh) { return mesh.level == firmware::Level::kCollapse; });
  for (const auto& [option, value] : {std::pair{"--quota", options.quota}, {"--placement", options.placement}})
    if (!any_collapse && !value.empty())
      print_note(fmt::format("{} {} has no effect: no mesh has level 3", option, value));
  note_missing_layers(options, desk);
  if (!options.thresholds.empty() && desk.drawing_data().solids().solids.empty())
    print_note(fmt::format("--thresholds {} has no effect: there are no solids; give pack a scene file",
                           options.thresholds));
  if (options.orbit && options.frames == 1) print_note("--orbit has no effect on one frame; give --frames");
  if (path.cameras() > options.frames)
    print_note(fmt::format("{}: {} cameras for {} frame(s); give --frames {} to use them all", options.camera,
                           path.cameras(), options.frames, path.cameras()));
}

int run(const RunOptions& options) {
  check_combinations(options);
  const Rgba8 background = background_option(options.background);
  const DeskConfig config = desk_config(options);
  std::optional<Progress> booting(std::in_place, "booting with " + options.rom);
  const auto rom = read_file(options.rom);
  Desk desk(config, rom, options.rom);
  booting.reset();
  const PolicyOptions policies(options.policies, desk.drawing_data());
  const firmware::ThinningSettings thinning = thinning_settings(options, policies, desk);
  firmware::SolidSettings solids;
  if (!options.thresholds.empty()) solids.thresholds = thresholds_option("--thresholds", options.thresholds);
  const CameraPath path(options, desk);
  prepare_outputs(options);
  note_idle_scripts(options, config);
  note_reduced_formats(desk, config.board);
  note_what_has_no_effect(options, desk, policies, path);
  if (!options.out.empty()) note_older_pictures(options);

  std::vector<FrameRecord> records;
  {
    Progress progress("drawing", options.frames);
    for (std::uint32_t i = 0; i < options.frames; ++i, progress.step()) {
      firmware::FrameRequest request = firmware::lit_request(path.at(i), path.aspect(), background);
      request.thinning = thinning;
      request.solids = solids;
      const Desk::Shown shown = desk.draw(request);
      records.push_back(shown.record);
      if (!options.out.empty()) write_png(picture_path(options, i), shown.picture);
    }
  }
  RunSummary summary{options.rom, options.board, options.engine, desk.width(), desk.height(), desk.memory(), {}};
  const auto meshes = named_meshes(desk.drawing_data());
  for (const std::uint32_t n : desk.layered_meshes()) summary.layered_meshes.push_back(meshes[n].name);
  if (!options.stats.empty()) write_file_atomically(options.stats, run_report_json(summary, records));
  if (options.stats != "/dev/stdout") fmt::print("{}", run_report_text(summary, records));
  return exit_status(ExitCode::kOk);
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  std::vector<std::string> board_names;
  for (const BoardDescription& board : boards()) board_names.emplace_back(board.name);
  CLI::App* command = app.add_subcommand("run", "Boot the device with a ROM and record what its panel shows");
  command->add_option("ROM", options->rom, "ROM image: container or bare drawing data")->required();
  command->add_option("--board", options->board, "The device's memories and clocks")
      ->check(CLI::IsMember(board_names))
      ->capture_default_str();
  command->add_option("--size", options->size, "Picture, WIDTHxHEIGHT in pixels; without it the board's panel");
  command->add_option("--format", options->format, "Pixels; without it the board's")
      ->check(CLI::IsMember({"xrgb8888", "rgb565"}));
  command->add_option("--frames", options->frames, "Frames to draw")
      ->transform(whole_number(1, kMostFrames))
      ->capture_default_str();
  command->add_flag("--orbit", options->orbit, "Turn once around the model over the frames");
  command->add_option("--camera", options->camera,
                      "JSON: {\"frames\": [{\"eye\": [x,y,z], \"target\": [x,y,z], \"up\": …, \"fov_y_deg\": 40, "
                      "\"near\": …, \"far\": …}, …]}");
  command->add_option("--thin", options->thin, "Thin as the authors allowed, or draw all that fits")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  command->add_option("--quota", options->quota,
                      "Faces for level-3 meshes instead of the authors' quotas: N over all of them, or P% of each");
  command->add_option("--placement", options->placement, "Where a collapsed edge's vertex goes with qem")
      ->check(CLI::IsMember({"optimal", "midpoint"}))
      ->default_str("optimal");
  command
      ->add_option("--lod", options->lod,
                   "Meshes with layers: off, with exactly the faces of their quota; quota, between two layers as the "
                   "quota falls, so that nothing jumps when it changes; auto, in the layer that size, place and speed "
                   "on the screen ask for, the quota being the coarsest")
      ->check(CLI::IsMember({"off", "quota", "auto"}))
      ->capture_default_str();
  command
      ->add_option("--attention", options->attention,
                   "Where the viewer looks, pixels from the top left corner: --lod auto then thins more what is far "
                   "from it")
      ->type_name("X,Y");
  command
      ->add_option("--boot-layers", options->boot_layers,
                   "Layers that the device makes as it boots, for level-3 meshes without any in ROM; per cent of their "
                   "faces, falling from 100")
      ->type_name("100,60,36,…");
  command
      ->add_option("--thresholds", options->thresholds,
                   "Sizes on the screen in pixels above which solids are drawn by their high, medium and low member; "
                   "smaller ones by their rough one")
      ->type_name("HIGH,MEDIUM,LOW")
      ->default_str("1,0,0");
  command
      ->add_option("--policy", options->policies,
                   "Which level-2 and level-3 meshes are thinned: always, below-area:PIXELS, chosen:NAME[,NAME…], "
                   "random:SHARE%[:SEED]; "
                   "with 2= or 3= before it for one level, so that each may have its own")
      ->allow_extra_args(false);  // so that a ROM may follow
  command->add_option("--engine", options->engine, "3D engine")
      ->check(CLI::IsMember({"soft", "osmesa"}))
      ->capture_default_str();
  command
      ->add_option("--threads", options->threads, "Host threads of the soft engine; the pictures do not depend on it")
      ->transform(whole_number(1, kMostThreads))
      ->capture_default_str();
  command->add_option("--background", options->background, "Colour behind the model, RRGGBB")->capture_default_str();
  command->add_option("--gpio", options->gpio,
                      "Pins by frame, FRAME:NAME=0|1,…: ignition, mode (a button: full, thinned, budget); low until "
                      "set. Without it the ignition is on")
      ->type_name("0:ignition=1,…");
  command->add_option("--fault", options->faults,
                      "Faults by frame, likewise: engine-hang, slow-bus. The device then shows its safe picture and "
                      "the run goes on")
      ->type_name("60:engine-hang=1,…");
  command->add_option("--out", options->out,
                      "Folder for a PNG per frame, frame-0000.png and so on, as the panel showed it; "
                      "pictures of an earlier, longer run stay and are told of");
  command->add_option("--stats", options->stats, "JSON file: CRC-32, faces, cycles and times of each frame");
  command->footer(fmt::format(
      "{}\n\nExample: usuzumi run car.rom --size 800x480 --frames 60 --orbit --out pictures --stats stats.json",
      kNamesHelp));
  command->callback([options, &exit_code] { report_errors(exit_code, [&] { return run(*options); }); });
}

}  // namespace usuzumi::sim
