#include "sim/machine/guest_log.h"

#include <fmt/format.h>

#include <utility>

namespace usuzumi::sim {
namespace {

std::string describe(const char* device, const char* name, BusAddress address, bool is_write, std::uint32_t value,
                     const char* what) {
  const std::string where = fmt::format("{}{}{} (0x{:08X})", device, *name != '\0' ? " " : "", name, address);
  return is_write ? fmt::format("{}: write of 0x{:08X}: {}", where, value, what)
                  : fmt::format("{}: read: {}", where, what);
}

}  // namespace

void GuestLog::Device::do_guest_mistake(gfx::GuestMistake mistake, const gfx::RegisterEvent& event) {
  ++log_.mistakes_;
  log_.keep(
      describe(name_, event.name, base_ + event.offset, event.is_write, event.value, gfx::guest_mistake_name(mistake)));
}

void GuestLog::Device::do_unimplemented(const gfx::RegisterEvent& event) {
  ++log_.unimplemented_;
  log_.keep(describe(name_, event.name, base_ + event.offset, event.is_write, event.value, "not modelled"));
}

void GuestLog::unmapped(BusAddress address, bool is_write, std::uint32_t value) {
  ++mistakes_;
  keep(describe("bus", "", address, is_write, value, "no register here"));
}

void GuestLog::keep(std::string line) {
  if (lines_.size() < kLinesKept) lines_.push_back(std::move(line));
}

}  // namespace usuzumi::sim
