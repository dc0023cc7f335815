// Work that may crash or never end, done in a process of its own.
//
// The model importers are large and read whatever people give them. A crash, a hang or a grab for all memory inside one
// of them must cost the user one error line, not the program.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace usuzumi::sim {

/// Runs `work` in a forked child and returns its bytes. An Error thrown by `work` is thrown here; other exceptions,
/// signals, exhausted memory (8 GiB) and the time limit become an Error kBadInput about `what` (a file name). What the
/// child prints is dropped. A progress bar is shown meanwhile.
std::vector<std::byte> run_isolated(const std::string& what, std::chrono::seconds time_limit,
                                    const std::function<std::vector<std::byte>()>& work);

}  // namespace usuzumi::sim
