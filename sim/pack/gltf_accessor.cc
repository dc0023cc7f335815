#include "sim/pack/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <span>

#include "firmware/drawing_data/format.h"
#include "sim/common/error.h"

namespace usuzumi::sim {
namespace {

/// More elements than drawing data have bytes for; an accessor that is all zeros needs no buffer and could claim any
/// number.
constexpr std::size_t kMostElements = firmware::format::kMaxFileBytes / 4;

/// Where in memory an array of elements lies; its whole extent has been checked.
struct Strided {
  const unsigned char* data = nullptr;
  std::size_t stride = 0;
};

class Checked {
 public:
  Checked(const tinygltf::Model& model, const std::string& where, const std::string& what)
      : model_(model), where_(where), what_(what) {}

  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ExitCode::kBadInput, fmt::format("{}: {}: {}; export it again", where_, what_, why));
  }

  const tinygltf::Accessor& accessor(int index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size())
      refuse(fmt::format("accessor {} does not exist", index));
    const tinygltf::Accessor& a = model_.accessors[static_cast<std::size_t>(index)];
    if (a.count > kMostElements) refuse(fmt::format("accessor {} claims {} elements", index, a.count));
    if (component_bytes(a.componentType) == 0) refuse(fmt::format("accessor {} has an unknown component type", index));
    return a;
  }

  /// `count` elements of `element_bytes`, `byte_offset` into buffer view `view`.
  Strided view(int view, std::size_t byte_offset, std::size_t count, std::size_t element_bytes) const {
    if (view < 0 || static_cast<std::size_t>(view) >= model_.bufferViews.size())
      refuse(fmt::format("buffer view {} does not exist", view));
    const tinygltf::BufferView& v = model_.bufferViews[static_cast<std::size_t>(view)];
    if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= model_.buffers.size())
      refuse(fmt::format("buffer {} does not exist", v.buffer));
    const std::vector<unsigned char>& data = model_.buffers[static_cast<std::size_t>(v.buffer)].data;
    if (v.byteOffset > data.size() || v.byteLength > data.size() - v.byteOffset)
      refuse(fmt::format("buffer view {} runs past the end of its buffer of {} bytes", view, data.size()));
    const std::size_t stride = v.byteStride != 0 ? v.byteStride : element_bytes;
    if (stride < element_bytes || stride > 4096)
      refuse(fmt::format("buffer view {} has a stride of {} bytes", view, stride));
    // count <= kMostElements and stride <= 4096, so the product cannot wrap.
    const std::size_t extent = count == 0 ? 0 : (count - 1) * stride + element_bytes;
    if (byte_offset > v.byteLength || extent > v.byteLength - byte_offset)
      refuse(fmt::format("{} elements run past the end of buffer view {} of {} bytes", count, view, v.byteLength));
    return {data.data() + v.byteOffset + byte_offset, stride};
  }

  static std::size_t component_bytes(int type) {
    switch (type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 1;
      case TINYGLTF_COMPONENT_TYPE_SHORT:
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 2;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      case TINYGLTF_COMPONENT_TYPE_FLOAT: return 4;
      default: return 0;  // INT and DOUBLE are no component types of glTF 2.0
    }
  }

 private:
  const tinygltf::Model& model_;
  const std::string& where_;
  const std::string& what_;
};

std::size_t components_of(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR: return 1;
    case TINYGLTF_TYPE_VEC2: return 2;
    case TINYGLTF_TYPE_VEC3: return 3;
    case TINYGLTF_TYPE_VEC4: return 4;
    default: return 0;
  }
}

template <class T>
T load(const unsigned char* at) {
  T v;
  std::memcpy(&v, at, sizeof v);
  return v;
}

float float_component(const unsigned char* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const float v = load<std::int8_t>(at);
      return normalized ? std::max(v / 127.0f, -1.0f) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return normalized ? static_cast<float>(*at) / 255.0f : *at;
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const float v = load<std::int16_t>(at);
      return normalized ? std::max(v / 32767.0f, -1.0f) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const float v = load<std::uint16_t>(at);
      return normalized ? v / 65535.0f : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return static_cast<float>(load<std::uint32_t>(at));
    default: return load<float>(at);
  }
}

std::uint32_t unsigned_component(const unsigned char* at, int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? *at
         : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? load<std::uint16_t>(at)
                                                          : load<std::uint32_t>(at);
}

bool is_unsigned(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Visits every element's bytes: first those of the buffer view (all zeros where there is none: then nothing is
/// visited), then the sparse substitutes (section 3.6.2.3).
void visit_elements(const Checked& check, const tinygltf::Accessor& a, std::size_t element_bytes,
                    const std::function<void(std::size_t, const unsigned char*)>& visit) {
  if (a.bufferView >= 0) {
    const Strided elements = check.view(a.bufferView, a.byteOffset, a.count, element_bytes);
    for (std::size_t i = 0; i < a.count; ++i) visit(i, elements.data + i * elements.stride);
  }
  if (!a.sparse.isSparse) return;
  const auto& s = a.sparse;
  if (s.count < 0 || static_cast<std::size_t>(s.count) > a.count || s.indices.byteOffset < 0 ||
      s.values.byteOffset < 0 || !is_unsigned(s.indices.componentType))
    check.refuse("its sparse part contradicts itself");
  const auto count = static_cast<std::size_t>(s.count);
  const std::size_t index_bytes = Checked::component_bytes(s.indices.componentType);
  const Strided indices =
      check.view(s.indices.bufferView, static_cast<std::size_t>(s.indices.byteOffset), count, index_bytes);
  const Strided values =
      check.view(s.values.bufferView, static_cast<std::size_t>(s.values.byteOffset), count, element_bytes);
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t i = unsigned_component(indices.data + k * indices.stride, s.indices.componentType);
    if (i >= a.count) check.refuse(fmt::format("its sparse part replaces element {} of {}", i, a.count));
    visit(i, values.data + k * values.stride);
  }
}

}  // namespace

Elements AccessorReader::floats(int index, std::size_t least, std::size_t most, const std::string& what) const {
  const Checked check(model_, where_, what);
  const tinygltf::Accessor& a = check.accessor(index);
  Elements out;
  out.components = components_of(a.type);
  if (out.components < least || out.components > most)
    check.refuse(fmt::format("accessor {} has the wrong number of components", index));
  out.values.assign(a.count * out.components, 0.0f);
  const std::size_t component = Checked::component_bytes(a.componentType);
  visit_elements(check, a, component * out.components, [&](std::size_t i, const unsigned char* at) {
    for (std::size_t k = 0; k < out.components; ++k)
      out.values[i * out.components + k] = float_component(at + k * component, a.componentType, a.normalized);
  });
  return out;
}

std::vector<std::uint32_t> AccessorReader::indices(int index, const std::string& what) const {
  const Checked check(model_, where_, what);
  const tinygltf::Accessor& a = check.accessor(index);
  if (a.type != TINYGLTF_TYPE_SCALAR || !is_unsigned(a.componentType))
    check.refuse(fmt::format("accessor {} holds no indices", index));
  std::vector<std::uint32_t> out(a.count);
  visit_elements(check, a, Checked::component_bytes(a.componentType),
                 [&](std::size_t i, const unsigned char* at) { out[i] = unsigned_component(at, a.componentType); });
  return out;
}

}  // namespace usuzumi::sim
