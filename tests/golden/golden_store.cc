#include "tests/golden/golden_store.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "sim/image/png.h"

namespace usuzumi::golden {
namespace {

constexpr const char* kManifestName = "manifest.txt";
constexpr const char* kHeader =
    "# The golden pictures of the software engine. Written by tests/golden/approve.sh; how and when: README.md.\n"
    "# scene, width, height, CRC-32 of the R, G, B bytes in scan order, what the scene proves\n";

std::string format_line(const Entry& entry) {
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, " %4u %4u %08x ", entry.width, entry.height, entry.crc32);
  std::string line = entry.scene;
  line.resize(std::max<std::size_t>(line.size(), 24), ' ');
  return line + numbers + entry.note;
}

Entry parse_line(const std::string& line, const std::string& where) {
  Entry entry;
  std::istringstream in(line);
  in >> entry.scene >> entry.width >> entry.height >> std::hex >> entry.crc32;
  if (in.fail() || entry.width == 0 || entry.height == 0)
    throw std::runtime_error(where + ": is not a scene, its width and height, its CRC-32 and a note");
  std::getline(in, entry.note);
  entry.note.erase(0, entry.note.find_first_not_of(' '));
  return entry;
}

}  // namespace

std::filesystem::path Store::source_folder() { return USUZUMI_GOLDEN_FOLDER; }

Store::Store(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::ifstream in(folder_ / kManifestName);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    const std::string where = (folder_ / kManifestName).string() + ":" + std::to_string(number);
    Entry entry = parse_line(line, where);
    if (find(entry.scene) != nullptr) throw std::runtime_error(where + ": scene " + entry.scene + " is named twice");
    entries_.push_back(std::move(entry));
  }
}

const Entry* Store::find(std::string_view scene) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.scene == scene; });
  return found == entries_.end() ? nullptr : &*found;
}

std::filesystem::path Store::picture_path(std::string_view scene) const {
  return folder_ / (std::string(scene) + ".png");
}

std::vector<std::string> Store::pictures_on_disk() const {
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder_))
    if (file.path().extension() == ".png") names.insert(file.path().stem().string());
  return {names.begin(), names.end()};
}

void Store::put(const Entry& entry, const sim::Image& picture) {
  sim::write_png(picture_path(entry.scene), picture);
  std::erase_if(entries_, [&](const Entry& e) { return e.scene == entry.scene; });
  entries_.push_back(entry);
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.scene < b.scene; });
  save();
}

void Store::remove(std::string_view scene) {
  std::filesystem::remove(picture_path(scene));
  std::erase_if(entries_, [&](const Entry& e) { return e.scene == scene; });
  save();
}

void Store::save() const {
  const auto path = folder_ / kManifestName, unfinished = folder_ / "manifest.txt.new";
  {
    std::ofstream out(unfinished);
    out << kHeader;
    for (const Entry& entry : entries_) out << format_line(entry) << '\n';
    if (!out.flush()) throw std::runtime_error(unfinished.string() + ": cannot be written");
  }
  std::filesystem::rename(unfinished, path);
}

}  // namespace usuzumi::golden
