#include "sim/common/strict_json.h"

#include <fmt/format.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "sim/common/error.h"
#include "sim/common/files.h"

namespace usuzumi::sim {

using json = nlohmann::ordered_json;

constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;  // arbitrary, far above what people write

json read_strict_json(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::vector<std::set<std::string>> names;
  auto watch = [&](int, json::parse_event_t event, json& parsed) -> bool {
    if (event == json::parse_event_t::object_start) names.emplace_back();
    if (event == json::parse_event_t::object_end) names.pop_back();
    if (event == json::parse_event_t::key && !names.back().insert(parsed.get<std::string>()).second)
      throw Error(ExitCode::kBadInput,
                  fmt::format("{}: \"{}\" stands twice in one object; remove one", file, parsed.get<std::string>()));
    return true;
  };
  const auto bytes = read_file(path, kMostBytes);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  try {
    return json::parse(text, text + bytes.size(), watch);
  } catch (const json::parse_error& e) {
    throw Error(ExitCode::kBadInput, fmt::format("{}: not JSON: error at byte {}; mend the file", file, e.byte));
  } catch (const json::out_of_range&) {
    throw Error(ExitCode::kBadInput, fmt::format("{}: a number in it is too large; mend the file", file));
  }
}

}  // namespace usuzumi::sim
