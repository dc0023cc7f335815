// Builds drawing data for tests word by word, independently of the packer: what the format page says, and nothing else.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "firmware/drawing_data/format.h"
#include "hal/crc32.h"
#include "hal/vec.h"

namespace usuzumi::testing {

/// ROM bytes that begin at a multiple of 4.
class RomImage {
 public:
  void word(std::uint32_t value) { words_.push_back(value); }
  void number(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    word(bits);
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(4 * words_.size()); }
  std::uint32_t& operator[](std::size_t byte_offset) { return words_[byte_offset / 4]; }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(words_)); }
  std::span<std::byte> writable() { return std::as_writable_bytes(std::span(words_)); }

 private:
  std::vector<std::uint32_t> words_;
};

struct TestMesh {
  std::uint32_t level = 1;
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;  // empty: the topology below
  firmware::format::Topology topology = firmware::format::Topology::kStrip;
  std::vector<PackedNormal> normals;
  std::vector<Rgba8> colours;
  Rgba8 base_colour{};
  std::string name;
  firmware::format::QuotaKind quota_kind = firmware::format::QuotaKind::kNone;
  std::uint32_t quota = 0;
  float area_threshold_px = -1;
  std::uint32_t flags = 0;
};

inline void append_records(RomImage& rom, const std::vector<TestMesh>& meshes,
                           std::vector<std::uint32_t>* offsets = nullptr) {
  rom.word(static_cast<std::uint32_t>(meshes.size()));
  for (const TestMesh& mesh : meshes) {
    if (offsets != nullptr) offsets->push_back(rom.size());
    rom.word(static_cast<std::uint32_t>(mesh.positions.size()));
    rom.word(mesh.level);
    for (const Vec3& p : mesh.positions) {
      rom.number(p.x);
      rom.number(p.y);
      rom.number(p.z);
    }
  }
}

inline RomImage bare_rom(const std::vector<TestMesh>& meshes) {
  RomImage rom;
  append_records(rom, meshes);
  return rom;
}

/// Puts the header's CRC right after a test has changed a word.
inline void seal(RomImage& rom) { rom[20] = crc32(kCrc32Start, rom.bytes().subspan(24)); }

inline RomImage container_rom(const std::vector<TestMesh>& meshes) {
  using namespace firmware::format;
  constexpr std::uint32_t kSections = 6;
  RomImage rom;
  for (std::uint32_t w : {kMagic, kByteOrderMark, 0x00010000u, 0u, 0u, 0u, kSections, 0u}) rom.word(w);
  for (std::uint32_t i = 0; i < 4 * kSections; ++i) rom.word(0);
  std::uint32_t section = 0;
  const auto begin_section = [&](SectionType type) {
    rom[32 + 16 * section] = static_cast<std::uint32_t>(type);
    rom[36 + 16 * section] = rom.size();
  };
  const auto end_section = [&] {
    rom[40 + 16 * section] = rom.size() - rom[36 + 16 * section];
    ++section;
  };
  std::vector<std::uint32_t> records, indices, normals, colours, names;
  begin_section(SectionType::kRecords);
  append_records(rom, meshes, &records);
  end_section();
  begin_section(SectionType::kIndices);
  for (const TestMesh& mesh : meshes) {
    indices.push_back(rom.size());
    for (std::uint32_t i : mesh.indices) rom.word(i);
  }
  end_section();
  begin_section(SectionType::kNormals);
  for (const TestMesh& mesh : meshes) {
    normals.push_back(rom.size());
    for (PackedNormal n : mesh.normals) rom.word(n.bits);
  }
  end_section();
  begin_section(SectionType::kColours);
  for (const TestMesh& mesh : meshes) {
    colours.push_back(rom.size());
    for (Rgba8 c : mesh.colours) rom.word(c.bits);
  }
  end_section();
  begin_section(SectionType::kNames);
  for (const TestMesh& mesh : meshes) {
    names.push_back(rom.size());
    std::string padded = mesh.name;
    padded.resize((padded.size() + 3) / 4 * 4);
    for (std::size_t i = 0; i < padded.size(); i += 4) {
      std::uint32_t w;
      std::memcpy(&w, padded.data() + i, 4);
      rom.word(w);
    }
  }
  end_section();
  begin_section(SectionType::kMeshes);
  for (std::size_t n = 0; n < meshes.size(); ++n) {
    const TestMesh& mesh = meshes[n];
    const bool indexed = !mesh.indices.empty();
    rom.word(records[n]);
    rom.word(static_cast<std::uint32_t>(indexed ? Topology::kIndexed : mesh.topology));
    rom.word(indexed ? indices[n] : kAbsent);
    rom.word(static_cast<std::uint32_t>(mesh.indices.size()));
    rom.word(indexed ? 4 : 0);
    rom.word(mesh.normals.empty() ? kAbsent : normals[n]);
    rom.word(mesh.colours.empty() ? kAbsent : colours[n]);
    rom.word(mesh.base_colour.bits);
    rom.word(static_cast<std::uint32_t>(mesh.quota_kind));
    rom.word(mesh.quota);
    rom.number(mesh.area_threshold_px);
    rom.word(0);
    rom.word(mesh.flags);
    rom.word(mesh.name.empty() ? kAbsent : names[n]);
    rom.word(static_cast<std::uint32_t>(mesh.name.size()));
    rom.word(kAbsent);
    rom.word(kAbsent);
    for (int i = 0; i < 3; ++i) rom.word(0);
  }
  end_section();
  rom[16] = rom.size();
  seal(rom);
  return rom;
}

}  // namespace usuzumi::testing
