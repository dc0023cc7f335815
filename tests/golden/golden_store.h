// The goldens on disk: `manifest` with a CRC-32 for every picture and every thinned mesh, and PNGs beside it.
//
// A case (a scene or a run) has the line of its name, for the picture that has the PNG, and lines of names below it:
// "run-04-turn/frame-0" is a picture that was shown before that one, "run-04-turn/mesh-03" a mesh of the RAM copy.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/image/image.h"

namespace usuzumi::golden {

/// A picture, or a mesh of the RAM copy.
struct Entry {
  std::string name;
  std::uint32_t width = 0, height = 0;  // pixels; of a mesh its vertices and its indices
  std::uint32_t crc32 = 0;              // of the R, G, B bytes in scan order; of the bytes of the mesh's block
  std::string note;
  friend bool operator==(const Entry&, const Entry&) = default;
};

/// A board that a case is too big for, and what is too big.
struct Exclusion {
  std::string name;  // of the case
  std::string board;
  std::string reason;
  friend bool operator==(const Exclusion&, const Exclusion&) = default;
};

/// The case that a line belongs to: "run-04-turn" of "run-04-turn/frame-0".
inline std::string_view case_of(std::string_view name) { return name.substr(0, name.find('/')); }

class Store {
 public:
  /// The folder the sources keep their goldens in.
  static std::filesystem::path source_folder();

  /// Reads the folder's manifest; a folder without one is an empty store. Throws std::runtime_error, with file and
  /// line, on a line that cannot be read, a name that comes twice, or a board excluded from what is not there.
  explicit Store(std::filesystem::path folder);

  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<Exclusion>& exclusions() const { return exclusions_; }
  /// Of one case, in the manifest's order.
  std::vector<Entry> entries_of(std::string_view case_name) const;
  std::vector<Exclusion> exclusions_of(std::string_view case_name) const;
  /// nullptr where the manifest does not have the name. What another route to the same picture (the panel, say) must
  /// give by sim::picture_crc32() is find(scene)->crc32.
  const Entry* find(std::string_view name) const;

  std::filesystem::path picture_path(std::string_view case_name) const;
  /// Cases with a PNG in the folder, sorted.
  std::vector<std::string> pictures_on_disk() const;

  /// Writes the PNG of the case that the entries belong to, and replaces all of the case's lines. The manifest stays
  /// sorted by case and name.
  void put(const std::vector<Entry>& entries, const std::vector<Exclusion>& exclusions, const sim::Image& picture);
  /// Takes the case's lines and PNG away.
  void remove(std::string_view case_name);

 private:
  void add_line(const std::string& line, const std::string& where);
  void erase_lines(std::string_view case_name);
  void save() const;

  std::filesystem::path folder_;
  std::vector<Entry> entries_;
  std::vector<Exclusion> exclusions_;
};

}  // namespace usuzumi::golden
