// A check of .off files before assimp sees them: it allocates what the header claims.
#pragma once

#include <filesystem>

namespace usuzumi::sim {

/// Throws Error kBadInput where the header of the text .off file `path` claims more vertices or faces than the file has
/// bytes for. Says nothing about anything else that may be wrong with it.
void check_off_counts(const std::filesystem::path& path);

}  // namespace usuzumi::sim
