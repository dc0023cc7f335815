// The textures of a model while it is imported: each image is read once, however many materials use it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// An image that is missing or broken costs one note, which names it and says what to do; the meshes that use it are
/// packed without texture.
class TextureShelf {
 public:
  /// Fills textures, notes and part_files of `model`; `model_file` begins the notes. Both must outlive the shelf.
  TextureShelf(Model& model, const std::string& model_file) : model_(model), model_file_(model_file) {}

  /// The texture's number, or nullopt.
  std::optional<std::uint32_t> from_file(const std::filesystem::path& path);
  /// Of an image inside the model file; `key` tells it from the others.
  std::optional<std::uint32_t> from_bytes(const std::string& key, const std::string& name,
                                          std::span<const std::byte> bytes);
  /// An image of which only a fault is known ("is missing"); said once for each key.
  std::optional<std::uint32_t> refuse(const std::string& key, const std::string& what, const std::string& advice);

  /// A note, said once for each key.
  void note(const std::string& key, const std::string& line);

 private:
  std::optional<std::uint32_t> add(const std::string& key, const std::string& name, const std::string& what,
                                   std::span<const std::byte> bytes);

  Model& model_;
  const std::string& model_file_;
  std::map<std::string, std::optional<std::uint32_t>> known_;
};

}  // namespace usuzumi::sim
