// usuzumi_study_seams: every thinning method on models whose textures have seams, as a Markdown table.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/image/png.h"
#include "sim/pack/method_settings.h"
#include "tests/study/contact_sheet.h"
#include "tests/study/seam_checks.h"
#include "tests/study/subjects.h"
#include "tests/study/thin_model.h"
#include "tests/study/views.h"

namespace usuzumi::study {
namespace {

namespace fs = std::filesystem;

constexpr double kShares[] = {0.5, 0.2, 0.05};

class Study {
 public:
  Study(std::uint32_t pixels, const fs::path& out) : size_{pixels, pixels}, out_(out) {}

  void run(const Subject& subject) {
    const sim::Model& model = subject.model;
    const ThinnedModel whole = unthinned(model);
    const firmware::Bounds bounds = bounds_of(model);
    cameras_ = cameras_around(bounds, view_directions(), 1);
    full_ = draw(model, cameras_, size_);
    save(subject.name + "-full", full_);
    images_ = surface_of(model, whole, Paint::kImages);
    parts_ = surface_of(model, whole, Paint::kParts);
    for (const double share : kShares)
      for (std::uint32_t m = 0; m < firmware::kMethodCount; ++m)
        measure(subject, static_cast<firmware::Method>(m), share);
  }

 private:
  void measure(const Subject& subject, firmware::Method method, double share) {
    const ThinnedModel thinned = thin_model(subject.model, method, share);
    const std::vector<sim::Image> pictures = draw(thinned.model, cameras_, size_);
    save(fmt::format("{}-{}-{}", subject.name, sim::method_name(method), share * 100), pictures);
    const testing::Mesh images = surface_of(subject.model, thinned, Paint::kImages);
    const testing::Mesh parts = surface_of(subject.model, thinned, Paint::kParts);
    const std::size_t seams = count_seam_vertices(images_), left = count_seam_vertices(images);
    const bool missed = thinned.faces > thinned.target_faces;
    fmt::print("| {} | {:.0f} % | {} | {}{} | {:.2f} | {} of {} | {} | {} |\n", subject.name, share * 100,
               sim::method_name(method), thinned.faces,
               missed ? fmt::format(" ({} asked)", thinned.target_faces) : std::string(),
               colour_difference(full_, pictures).mean(), seams - left, seams, count_holes(parts_, parts),
               count_flipped(parts_, parts));
    std::fflush(stdout);
  }

  void save(const std::string& name, const std::vector<sim::Image>& pictures) const {
    if (!out_.empty()) sim::write_png(out_ / (name + ".png"), contact_sheet(pictures, 7));
  }

  PictureSize size_;
  fs::path out_;
  std::vector<firmware::Camera> cameras_;
  std::vector<sim::Image> full_;
  testing::Mesh images_, parts_;
};

}  // namespace
}  // namespace usuzumi::study

int main(int argc, char** argv) {
  using namespace usuzumi::study;
  CLI::App app("What thinning does to textures with seams, as a Markdown table", "usuzumi_study_seams");
  std::uint32_t pixels = 256;
  std::filesystem::path out;
  std::string only;
  app.add_option("--size", pixels, "Pixels of a rendering each way, 16 to 2048")
      ->check(CLI::Range(16, 2048))
      ->capture_default_str();
  app.add_option("--out", out, "A folder for the renderings, which must exist")->check(CLI::ExistingDirectory);
  app.add_option("--subject", only, "This one alone");
  CLI11_PARSE(app, argc, argv);
  try {
    fmt::print("| subject | faces | method | reached | texture error | seam vertices lost | holes | flipped |\n");
    fmt::print("|---|---|---|---|---|---|---|---|\n");
    Study study(pixels, out);
    for (const Subject& subject : subjects())
      if (only.empty() || only == subject.name) study.run(subject);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "usuzumi_study_seams: %s\n", error.what());
    return 1;
  }
  return 0;
}
