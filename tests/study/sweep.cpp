// usuzumi_study_sweep: a quota that falls from all faces to the last layer's, by every method on models whose textures
// have seams, as a Markdown table. What stands there is the largest change of a block of 8 x 8 pixels between two
// frames (0 to 255): drawn in middle layers / where layers are switched, and their ratio.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "sim/pack/levels.h"
#include "sim/pack/method_settings.h"
#include "tests/study/layer_sweep.h"
#include "tests/study/subjects.h"

int main(int argc, char** argv) {
  using namespace usuzumi;
  using namespace usuzumi::study;
  CLI::App app("What changes between two frames while a quota falls, as a Markdown table", "usuzumi_study_sweep");
  std::uint32_t pixels = 192;
  int frames = 300, views = 1;
  std::string only, layers = "100,60,36,21.6,5";
  bool geometric = false;
  app.add_option("--size", pixels, "Pixels of the panel each way, 16 to 1024")
      ->check(CLI::Range(16, 1024))
      ->capture_default_str();
  app.add_option("--frames", frames, "Frames of the sweep, 2 to 100,000")
      ->check(CLI::Range(2, 100'000))
      ->capture_default_str();
  app.add_option("--views", views, "Directions around the model, 1 to 360: the largest changes of any")
      ->check(CLI::Range(1, 360))
      ->capture_default_str();
  app.add_option("--layers", layers, "Per cent of the faces, falling from 100")->capture_default_str();
  app.add_flag("--geometric", geometric, "The quota falls by the same share in every frame, not by as many faces");
  app.add_option("--subject", only, "This one alone");
  CLI11_PARSE(app, argc, argv);
  try {
    const std::vector<std::uint32_t> millionths = sim::layers_rule(layers).tags.layers.value();
    const testing::QuotaSweep sweep{frames, millionths, geometric};
    fmt::print("| subject |");
    for (const auto name : sim::kMethodNames) fmt::print(" {} |", name);
    fmt::print("\n|---|---|---|---|---|\n");
    for (const Subject& subject : subjects()) {
      if (!only.empty() && only != subject.name) continue;
      fmt::print("| {} |", subject.name);
      for (std::uint32_t m = 0; m < firmware::kMethodCount; ++m) {
        const testing::SweepChange change =
            sweep_layers(subject.model, static_cast<firmware::Method>(m), sweep, {pixels, pixels}, views);
        fmt::print(" {:.1f} / {:.1f} = {:.2f} |", change.middle, change.switched, change.middle / change.switched);
        std::fflush(stdout);
      }
      fmt::print("\n");
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "usuzumi_study_sweep: %s\n", error.what());
    return 1;
  }
  return 0;
}
