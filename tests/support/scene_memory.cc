#include "tests/support/scene_memory.h"

namespace usuzumi::scenes {
namespace {

template <class Byte, class Memory>
std::span<Byte> window(Memory& memory, BusAddress base, BusAddress address, std::size_t size) {
  if (address < base || address - base >= memory.size() || size > memory.size() - (address - base)) return {};
  return std::span<Byte>(memory).subspan(address - base, size);
}

}  // namespace

std::span<const std::byte> SceneMemory::do_read_window(BusAddress address, std::size_t size) const {
  auto found = window<const std::byte>(vram_, kVramBase, address, size);
  return found.data() != nullptr ? found : window<const std::byte>(ram_, kRamBase, address, size);
}

std::span<std::byte> SceneMemory::do_write_window(BusAddress address, std::size_t size) {
  auto found = window<std::byte>(vram_, kVramBase, address, size);
  return found.data() != nullptr ? found : window<std::byte>(ram_, kRamBase, address, size);
}

}  // namespace usuzumi::scenes
