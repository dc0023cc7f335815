// Writes the bundle of all golden cases: usuzumi_golden_record FILE
#include <cstdio>
#include <exception>

#include "sim/common/files.h"
#include "tests/golden/bundle_writer.h"

int main(int argc, char** argv) {
  using namespace usuzumi;
  if (argc != 2) {
    std::fprintf(stderr, "usuzumi_golden_record FILE: writes the golden cases, without answers, for the player\n");
    return 2;
  }
  try {
    const auto bundle = golden::write_bundle(scenes::all_scenes(), golden::all_runs());
    sim::write_file_atomically(argv[1], bundle);
    std::printf("%s: %zu cases in %zu bytes\n", argv[1], scenes::all_scenes().size() + golden::all_runs().size(),
                bundle.size());
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 4;
  }
}
