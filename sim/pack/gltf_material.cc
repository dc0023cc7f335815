#include "sim/pack/gltf_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/common/error.h"
#include "sim/pack/gltf_uri.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;
using firmware::format::AlphaMode;

double number_at(const tinygltf::Value& list, std::size_t i, double fallback) {
  if (!list.IsArray() || i >= list.ArrayLen()) return fallback;
  const tinygltf::Value& v = list.Get(static_cast<int>(i));
  return v.IsNumber() ? v.GetNumberAsDouble() : fallback;
}

int integer_of(const tinygltf::Value& object, const char* key, int fallback) {
  if (!object.Has(key) || !object.Get(key).IsNumber()) return fallback;
  const double d = object.Get(key).GetNumberAsDouble();
  return d >= 0 && d <= 1e9 ? static_cast<int>(d) : fallback;
}

/// KHR_texture_transform's own set of coordinates goes before the texture's.
TextureTransform read_transform(const tinygltf::Value& extension, int& set) {
  TextureTransform t;
  if (!extension.IsObject()) return t;
  for (std::size_t i = 0; i < 2; ++i) {
    if (extension.Has("offset")) t.offset[i] = number_at(extension.Get("offset"), i, 0);
    if (extension.Has("scale")) t.scale[i] = number_at(extension.Get("scale"), i, 1);
  }
  if (extension.Has("rotation") && extension.Get("rotation").IsNumber())
    t.rotation = extension.Get("rotation").GetNumberAsDouble();
  set = integer_of(extension, "texCoord", set);
  return t;
}

command::TextureWrap wrap_of(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE: return command::TextureWrap::kClamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT: return command::TextureWrap::kMirror;
    default: return command::TextureWrap::kRepeat;
  }
}

}  // namespace

TexCoord TextureTransform::operator()(double s, double t) const {
  const double x = s * scale[0], y = t * scale[1], cosine = std::cos(rotation), sine = std::sin(rotation);
  return {static_cast<float>(cosine * x + sine * y + offset[0]), static_cast<float>(cosine * y - sine * x + offset[1])};
}

GltfMaterials::GltfMaterials(const fs::path& path, const std::string& file, const tinygltf::Model& gltf, Model& model)
    : folder_(path.parent_path()), file_(file), gltf_(gltf), shelf_(model, file_) {}

void GltfMaterials::refuse(const std::string& why) const {
  throw Error(ExitCode::kBadInput, fmt::format("{}: {}; export it again", file_, why));
}

GltfMaterial GltfMaterials::read(int index, const std::string& what) {
  GltfMaterial out;
  if (index < 0) return out;
  if (static_cast<std::size_t>(index) >= gltf_.materials.size())
    refuse(fmt::format("{} uses material {}, which does not exist", what, index));
  const tinygltf::Material& source = gltf_.materials[static_cast<std::size_t>(index)];
  out.name = source.name;
  out.two_sided = source.doubleSided;
  const auto& pbr = source.pbrMetallicRoughness;
  const std::vector<double>& f = pbr.baseColorFactor;
  if (f.size() >= 3) out.factor = {f[0], f[1], f[2], f.size() > 3 ? f[3] : 1.0};
  TextureUse use{pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord, {}};
  const auto moved = pbr.baseColorTexture.extensions.find("KHR_texture_transform");
  if (moved != pbr.baseColorTexture.extensions.end()) use.transform = read_transform(moved->second, use.set);
  const auto older = source.extensions.find("KHR_materials_pbrSpecularGlossiness");
  if (older != source.extensions.end()) read_older(older->second, out, use);
  read_alpha(source, out.material);
  if (use.index != -1) read_texture(use, out);
  return out;
}

/// The older way to say it, by extension KHR_materials_pbrSpecularGlossiness.
void GltfMaterials::read_older(const tinygltf::Value& older, GltfMaterial& out, TextureUse& use) const {
  if (!older.IsObject()) return;
  if (older.Has("diffuseFactor")) {
    const tinygltf::Value& d = older.Get("diffuseFactor");
    out.factor = {number_at(d, 0, 1), number_at(d, 1, 1), number_at(d, 2, 1), number_at(d, 3, 1)};
  }
  if (!older.Has("diffuseTexture") || !older.Get("diffuseTexture").IsObject()) return;
  const tinygltf::Value& texture = older.Get("diffuseTexture");
  use = {integer_of(texture, "index", -1), integer_of(texture, "texCoord", 0), {}};
  if (texture.Has("extensions") && texture.Get("extensions").Has("KHR_texture_transform"))
    use.transform = read_transform(texture.Get("extensions").Get("KHR_texture_transform"), use.set);
}

void GltfMaterials::read_alpha(const tinygltf::Material& source, Material& out) const {
  if (source.alphaMode == "BLEND") out.alpha_mode = AlphaMode::kBlend;
  if (source.alphaMode != "MASK") return;
  out.alpha_mode = AlphaMode::kMask;
  // Section 3.9.4: alpha at the cutoff is drawn; above 1 nothing would be, which one byte cannot say.
  const double reference = std::ceil(source.alphaCutoff * 255 - 1e-6);
  out.alpha_reference = static_cast<std::uint32_t>(std::clamp(reference, 0.0, 255.0));
}

void GltfMaterials::read_texture(const TextureUse& use, GltfMaterial& out) {
  if (use.index < 0 || static_cast<std::size_t>(use.index) >= gltf_.textures.size())
    refuse(fmt::format("material '{}' uses texture {}, which does not exist", out.name, use.index));
  const tinygltf::Texture& texture = gltf_.textures[static_cast<std::size_t>(use.index)];
  out.coordinates = fmt::format("TEXCOORD_{}", use.set);
  out.transform = use.transform;
  if (texture.source < 0) {
    shelf_.refuse(fmt::format("texture {}", use.index), fmt::format("texture {} has no PNG or JPEG image", use.index),
                  "export it again with PNG or JPEG images");
    return;
  }
  out.material.texture = read_image(texture.source);
  if (out.material.texture) read_sampler(texture.sampler, out.material);
}

std::optional<std::uint32_t> GltfMaterials::read_image(int index) {
  if (static_cast<std::size_t>(index) >= gltf_.images.size()) refuse(fmt::format("image {} does not exist", index));
  const tinygltf::Image& image = gltf_.images[static_cast<std::size_t>(index)];
  const std::string key = fmt::format("image {}", index), name = image.name.empty() ? key : image.name;
  if (image.bufferView < 0 && !image.uri.empty()) return shelf_.from_file(folder_ / decoded_uri(image.uri));
  if (image.bufferView < 0) return shelf_.from_bytes(key, name, std::as_bytes(std::span(image.image)));
  // The loader has looked up the view and its buffer, but not their extents.
  const tinygltf::BufferView& view = gltf_.bufferViews[static_cast<std::size_t>(image.bufferView)];
  const std::vector<unsigned char>& data = gltf_.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    refuse(fmt::format("{} runs past the end of its buffer of {} bytes", key, data.size()));
  return shelf_.from_bytes(key, name, std::as_bytes(std::span(data)).subspan(view.byteOffset, view.byteLength));
}

/// Sections 5.26 and 3.8.4.1. Where a filter is not given, it is the reader's choice: bilinear. Magnifying decides,
/// since the device has one filter for both and blurred edges of a pixel picture would be seen first.
void GltfMaterials::read_sampler(int index, Material& out) const {
  if (index < 0) return;
  if (static_cast<std::size_t>(index) >= gltf_.samplers.size()) refuse(fmt::format("sampler {} does not exist", index));
  const tinygltf::Sampler& sampler = gltf_.samplers[static_cast<std::size_t>(index)];
  if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) out.filter = command::TextureFilter::kNearest;
  out.wrap_s = wrap_of(sampler.wrapS);
  out.wrap_t = wrap_of(sampler.wrapT);
}

}  // namespace usuzumi::sim
