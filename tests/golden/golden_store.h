// The goldens on disk: manifest.txt with a CRC-32 per scene, and a PNG per scene beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/image/image.h"

namespace usuzumi::golden {

struct Entry {
  std::string scene;
  std::uint32_t width = 0, height = 0;
  std::uint32_t crc32 = 0;  // of the R, G, B bytes in scan order
  std::string note;
};

class Store {
 public:
  /// The folder the sources keep their goldens in.
  static std::filesystem::path source_folder();

  /// Reads the folder's manifest; a folder without one is an empty store. Throws std::runtime_error, with file and
  /// line, on a line that cannot be read or a scene named twice.
  explicit Store(std::filesystem::path folder);

  const std::vector<Entry>& entries() const { return entries_; }
  /// nullptr where the manifest does not name the scene. What another route to the same picture (the panel, say) must
  /// give by sim::picture_crc32() is find(scene)->crc32.
  const Entry* find(std::string_view scene) const;

  std::filesystem::path picture_path(std::string_view scene) const;
  /// Scenes with a PNG in the folder, sorted.
  std::vector<std::string> pictures_on_disk() const;

  /// Writes the picture's PNG and its entry into the manifest, which stays sorted by scene.
  void put(const Entry& entry, const sim::Image& picture);
  /// Takes the scene's entry and PNG away.
  void remove(std::string_view scene);

 private:
  void save() const;

  std::filesystem::path folder_;
  std::vector<Entry> entries_;
};

}  // namespace usuzumi::golden
