// Whole files in and out. Output is written beside its final name and renamed, so that nothing half-written is left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace usuzumi::sim {

/// ".obj" of "Fish.OBJ".
std::string lower_extension(const std::filesystem::path& path);

/// All bytes of a regular file (or of a pipe). Throws Error kBadInput: missing, a folder, unreadable, above
/// `max_bytes`.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes = std::uint64_t{4} << 30);

/// Looks at an output's name before the work that leads to it: what write_file_atomically() would say only afterwards.
/// `option` is how the name was given ("--stats"), `inputs` are the files that the same command reads. Throws Error
/// kUsage where the output is one of them, also through a link, and kCannotWrite. Leaves no trace.
void check_output(const std::filesystem::path& path, std::string_view option,
                  std::span<const std::filesystem::path> inputs);

/// Writes `bytes` to a temporary file in the folder of `path` and renames it. On failure the temporary file is gone, an
/// existing file at `path` is as it was, and Error kCannotWrite says why. A device or pipe (/dev/stdout) is written
/// directly.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace usuzumi::sim
