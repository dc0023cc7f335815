#include "tests/golden/golden_store.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "sim/image/png.h"

namespace usuzumi::golden {
namespace {

constexpr const char* kManifestName = "manifest";
constexpr const char* kHeader =
    "# The goldens of the software engine and of the whole device: every board and compiler must print these numbers.\n"
    "# Written by tests/golden/approve.sh; how and when: README.md.\n"
    "# picture: name, width, height, CRC-32 of the R, G, B bytes in scan order, what it proves\n"
    "# mesh:    name, vertices, indices, CRC-32 of its block in the RAM copy, what was done to it\n"
    "# board that a case is too big for: name, \"not on\", board, \":\", reason\n";
constexpr const char* kNotOn = "not on ";

std::string padded(std::string name) {
  name.resize(std::max<std::size_t>(name.size(), 28), ' ');
  return name;
}

std::string format_line(const Entry& entry) {
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, " %4u %4u %08x ", entry.width, entry.height, entry.crc32);
  return padded(entry.name) + numbers + entry.note;
}

std::string format_line(const Exclusion& exclusion) {
  return padded(exclusion.name) + " " + kNotOn + exclusion.board + ": " + exclusion.reason;
}

std::string trimmed(const std::string& text) { return text.substr(std::min(text.find_first_not_of(' '), text.size())); }

Entry parse_entry(const std::string& name, const std::string& rest, const std::string& where) {
  Entry entry;
  entry.name = name;
  std::istringstream in(rest);
  in >> entry.width >> entry.height >> std::hex >> entry.crc32;
  if (in.fail() || entry.width == 0)
    throw std::runtime_error(where + ": is not a name, width and height (or vertices and indices), CRC-32 and a note");
  std::getline(in, entry.note);
  entry.note = trimmed(entry.note);
  return entry;
}

Exclusion parse_exclusion(const std::string& name, const std::string& rest, const std::string& where) {
  const std::size_t colon = rest.find(": ");
  const std::size_t board = std::string_view(kNotOn).size();
  if (colon == std::string::npos || colon <= board || colon + 2 >= rest.size())
    throw std::runtime_error(where + ": is not a name, \"not on\", a board, a colon and the reason");
  return {name, rest.substr(board, colon - board), rest.substr(colon + 2)};
}

template <class Line>
std::vector<Line> of_case(const std::vector<Line>& lines, std::string_view case_name) {
  std::vector<Line> found;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(found),
               [&](const Line& line) { return case_of(line.name) == case_name; });
  return found;
}

}  // namespace

std::filesystem::path Store::source_folder() { return USUZUMI_GOLDEN_FOLDER; }

Store::Store(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::ifstream in(folder_ / kManifestName);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number)
    if (!line.empty() && line.front() != '#')
      add_line(line, (folder_ / kManifestName).string() + ":" + std::to_string(number));
}

void Store::add_line(const std::string& line, const std::string& where) {
  const std::string name = line.substr(0, line.find(' ')), rest = trimmed(line.substr(name.size()));
  if (rest.starts_with(kNotOn)) {
    Exclusion exclusion = parse_exclusion(name, rest, where);
    if (find(name) == nullptr) throw std::runtime_error(where + ": no picture of " + name + " above this line");
    for (const Exclusion& other : exclusions_)
      if (other.name == name && other.board == exclusion.board)
        throw std::runtime_error(where + ": " + name + " and " + exclusion.board + " come twice");
    exclusions_.push_back(std::move(exclusion));
    return;
  }
  Entry entry = parse_entry(name, rest, where);
  if (find(name) != nullptr) throw std::runtime_error(where + ": " + name + " is named twice");
  entries_.push_back(std::move(entry));
}

std::vector<Entry> Store::entries_of(std::string_view case_name) const { return of_case(entries_, case_name); }
std::vector<Exclusion> Store::exclusions_of(std::string_view case_name) const {
  return of_case(exclusions_, case_name);
}

const Entry* Store::find(std::string_view name) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == name; });
  return found == entries_.end() ? nullptr : &*found;
}

std::filesystem::path Store::picture_path(std::string_view case_name) const {
  return folder_ / (std::string(case_name) + ".png");
}

std::vector<std::string> Store::pictures_on_disk() const {
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder_))
    if (file.path().extension() == ".png") names.insert(file.path().stem().string());
  return {names.begin(), names.end()};
}

void Store::put(const std::vector<Entry>& entries, const std::vector<Exclusion>& exclusions,
                const sim::Image& picture) {
  const std::string case_name(case_of(entries.front().name));
  sim::write_png(picture_path(case_name), picture);
  erase_lines(case_name);
  entries_.insert(entries_.end(), entries.begin(), entries.end());
  exclusions_.insert(exclusions_.end(), exclusions.begin(), exclusions.end());
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::pair(case_of(a.name), a.name) < std::pair(case_of(b.name), b.name);
  });
  save();
}

void Store::remove(std::string_view case_name) {
  std::filesystem::remove(picture_path(case_name));
  erase_lines(case_name);
  save();
}

void Store::erase_lines(std::string_view case_name) {
  std::erase_if(entries_, [&](const Entry& e) { return case_of(e.name) == case_name; });
  std::erase_if(exclusions_, [&](const Exclusion& e) { return e.name == case_name; });
}

void Store::save() const {
  const auto path = folder_ / kManifestName, unfinished = folder_ / "manifest.new";
  {
    std::ofstream out(unfinished);
    out << kHeader;
    for (const Entry& entry : entries_) {
      out << format_line(entry) << '\n';
      for (const Exclusion& exclusion : exclusions_)
        if (exclusion.name == entry.name) out << format_line(exclusion) << '\n';
    }
    if (!out.flush()) throw std::runtime_error(unfinished.string() + ": cannot be written");
  }
  std::filesystem::rename(unfinished, path);
}

}  // namespace usuzumi::golden
