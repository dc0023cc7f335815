#include "sim/pack/texture_shelf.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/pack/picture_file.h"
#include "sim/pack/text.h"

namespace usuzumi::sim {

namespace fs = std::filesystem;

std::optional<std::uint32_t> TextureShelf::from_file(const fs::path& path) {
  const std::string key = "file " + path.lexically_normal().string(), what = "texture " + path.string();
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  std::error_code none;
  if (!fs::is_regular_file(path, none))
    return refuse(key, what + " is missing", "put it beside the model and pack again");
  model_.part_files.push_back(path.string());
  try {
    return add(key, path.filename().string(), what, read_file(path));
  } catch (const Error& e) {
    return refuse(key, fmt::format("{} cannot be read ({})", what, e.what()), "make it readable and pack again");
  }
}

std::optional<std::uint32_t> TextureShelf::from_bytes(const std::string& key, const std::string& name,
                                                      std::span<const std::byte> bytes) {
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  return add(key, name, fmt::format("the texture '{}' inside it", one_line(name)), bytes);
}

std::optional<std::uint32_t> TextureShelf::refuse(const std::string& key, const std::string& what,
                                                  const std::string& advice) {
  note(key, fmt::format("{}: {}; its meshes are packed without texture: {}", model_file_, what, advice));
  return std::nullopt;
}

void TextureShelf::note(const std::string& key, const std::string& line) {
  if (known_.try_emplace(key, std::nullopt).second) model_.notes.push_back(line);
}

std::optional<std::uint32_t> TextureShelf::add(const std::string& key, const std::string& name, const std::string& what,
                                               std::span<const std::byte> bytes) {
  std::string fault;
  std::optional<Picture> picture = decode_picture(bytes, fault);
  if (!picture) return refuse(key, what + ' ' + one_line(fault), "save it as PNG or JPEG and pack again");
  picture->name = name;
  const auto number = static_cast<std::uint32_t>(model_.textures.size());
  model_.textures.push_back(*std::move(picture));
  known_[key] = number;
  return number;
}

}  // namespace usuzumi::sim
