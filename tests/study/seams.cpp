// usuzumi_study_seams: every thinning method on models whose textures have seams, as a Markdown table. For each share
// of the faces: the mean colour difference (0 to 255) of pictures from 26 directions to those of the whole model, and
// the seam vertices lost; for all three together: holes and flipped faces.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
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
    for (std::uint32_t m = 0; m < firmware::kMethodCount; ++m) {
      const auto method = static_cast<firmware::Method>(m);
      const std::string_view name = sim::method_name(method);
      const std::string heading = fmt::format("{}: {} faces, {} seam vertices", subject.name, whole.faces,
                                              count_seam_vertices(images_));
      fmt::print("| {} | {} |", m == 0 ? heading : std::string(), name);
      std::size_t holes = 0, flipped = 0;
      for (const double share : kShares) {
        const ThinnedModel thinned = thin_model(model, method, share);
        const testing::Mesh parts = surface_of(model, thinned, Paint::kParts);
        holes += count_holes(parts_, parts);
        flipped += count_flipped(parts_, parts);
        print_share(model, thinned, fmt::format("{}-{}-{}", subject.name, name, share * 100));
      }
      fmt::print(" {} | {} |\n", holes, flipped);
      std::fflush(stdout);
    }
  }

 private:
  void print_share(const sim::Model& model, const ThinnedModel& thinned, const std::string& name) const {
    const std::vector<sim::Image> pictures = draw(thinned.model, cameras_, size_);
    save(name, pictures);
    const std::size_t lost =
        count_seam_vertices(images_) - count_seam_vertices(surface_of(model, thinned, Paint::kImages));
    fmt::print(" {:.2f}, {} lost", colour_difference(full_, pictures).mean(), lost);
    if (thinned.faces > thinned.target_faces)
      fmt::print(", {} faces for {}", thinned.faces, thinned.target_faces);
    fmt::print(" |");
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
    fmt::print("| subject | method | 50 % | 20 % | 5 % | holes | flipped |\n");
    fmt::print("|---|---|---|---|---|---|---|\n");
    Study study(pixels, out);
    for (const Subject& subject : subjects())
      if (only.empty() || only == subject.name) study.run(subject);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "usuzumi_study_seams: %s\n", error.what());
    return 1;
  }
  return 0;
}
