// What the firmware did wrong at the registers, and what it asked of the model that the model does not do: counted
// apart, the first of them kept as text for whoever runs the machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gfx_subsystem/register_file.h"
#include "hal/bus.h"

namespace usuzumi::sim {

class GuestLog {
 public:
  static constexpr std::size_t kLinesKept = 64;

  /// One device's way into the log.
  class Device final : public gfx::RegisterLog {
   public:
    Device(GuestLog& log, const char* name, BusAddress base) : log_(log), name_(name), base_(base) {}

   private:
    void do_guest_mistake(gfx::GuestMistake mistake, const gfx::RegisterEvent& event) override;
    void do_unimplemented(const gfx::RegisterEvent& event) override;

    GuestLog& log_;
    const char* name_;
    BusAddress base_;
  };

  /// An access to an address where no device is.
  void unmapped(BusAddress address, bool is_write, std::uint32_t value);

  std::uint64_t mistakes() const { return mistakes_; }
  std::uint64_t unimplemented() const { return unimplemented_; }
  /// The first kLinesKept of both, in order: "display L0_ADDRESS (0xF0001040): write of 0x00000003: value not allowed".
  std::span<const std::string> lines() const { return lines_; }

 private:
  void keep(std::string line);

  std::uint64_t mistakes_ = 0;
  std::uint64_t unimplemented_ = 0;
  std::vector<std::string> lines_;
};

}  // namespace usuzumi::sim
