#include "tests/golden/bundle_writer.h"

#include <bit>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "hal/crc32.h"
#include "tests/golden/player/bundle.h"
#include "tests/support/desk_request.h"
#include "tests/support/scene_memory.h"

namespace usuzumi::golden {
namespace {

using namespace bundle;

static_assert(kDataBase == scenes::SceneMemory::kRamBase && kVramBase == scenes::SceneMemory::kVramBase,
              "lists are recorded with the addresses that the player gives them");

class Writer {
 public:
  explicit Writer(std::size_t cases) : bytes_(sizeof(Header) + cases * sizeof(CaseRecord)) {}

  Block put(std::span<const std::byte> data) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    const Block block{static_cast<std::uint32_t>(bytes_.size()), static_cast<std::uint32_t>(data.size())};
    bytes_.insert(bytes_.end(), data.begin(), data.end());
    return block;
  }
  template <class T>
  Block put_all(const std::vector<T>& items) {
    static_assert(std::is_trivially_copyable_v<T>);
    return put(std::as_bytes(std::span(items)));
  }
  Block put_text(std::string_view text, std::uint32_t most) {
    if (text.empty() || text.size() > most)
      throw std::runtime_error("\"" + std::string(text) + "\": must have 1 to " + std::to_string(most) + " bytes");
    return put(std::as_bytes(std::span(text)));
  }
  void put_case(const CaseRecord& record) {
    std::memcpy(&bytes_[sizeof(Header) + cases_++ * sizeof record], &record, sizeof record);
  }

  std::vector<std::byte> finish() {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    const auto rest = std::span(bytes_).subspan(sizeof(Header));
    const Header header{kMagic, kVersion, static_cast<std::uint32_t>(bytes_.size()), crc32(kCrc32Start, rest), cases_};
    std::memcpy(bytes_.data(), &header, sizeof header);
    return std::move(bytes_);
  }

 private:
  std::vector<std::byte> bytes_;
  std::uint32_t cases_ = 0;
};

PlaneRecord plane_record(const scenes::Plane& plane) {
  return plane.row_bytes == 0 ? PlaneRecord{}
                              : PlaneRecord{static_cast<std::uint32_t>(plane.offset), plane.stride, plane.row_bytes};
}

void put_scene(Writer& out, const scenes::Scene& scene) {
  const scenes::SceneRecording recording = scenes::record_scene(scene);
  std::vector<Block> lists;
  for (const auto& list : recording.lists) lists.push_back(out.put_all(list));
  SceneRecord record{};
  record.width = scene.target.width;
  record.height = scene.target.height;
  record.pixel_format = static_cast<std::uint32_t>(scene.target.format);
  record.background_pixel = recording.background_pixel;
  record.vram_bytes = static_cast<std::uint32_t>(recording.vram_bytes);
  record.colour = plane_record(recording.colour);
  record.depth = plane_record(recording.depth);
  record.data = out.put_all(recording.ram);
  record.lists = out.put_all(lists);
  const Block name = out.put_text(scene.name, kNameMax);
  out.put_case({name, out.put({}), static_cast<std::uint32_t>(Kind::kScene), out.put_all(std::vector{record})});
}

PolicyRecord policy_record(Writer& out, const firmware::Policy& policy) {
  return {static_cast<std::uint32_t>(policy.kind), std::bit_cast<std::uint32_t>(policy.area_threshold_px),
          policy.random_millionths, policy.seed, out.put(std::as_bytes(policy.chosen))};
}

RunRecord run_record(Writer& out, const DeviceRun& run) {
  std::vector<double> angles{testing::kElevationRad};
  angles.insert(angles.end(), run.azimuths_rad.begin(), run.azimuths_rad.end());
  RunRecord record{};
  record.width = run.width;
  record.height = run.height;
  record.pixel_format = static_cast<std::uint32_t>(run.board.pixel_format);
  record.depth_format = static_cast<std::uint32_t>(run.board.depth_format);
  record.ram_bytes = static_cast<std::uint32_t>(run.board.ram_bytes);
  record.background = testing::kRequestBackground.bits;
  record.thinning_enabled = run.thinning.enabled ? 1 : 0;
  record.placement = static_cast<std::uint32_t>(run.thinning.placement);
  record.quota_kind = static_cast<std::uint32_t>(run.thinning.quota.kind);
  record.quota = run.thinning.quota.value;
  record.delete_policy = policy_record(out, run.thinning.delete_policy);
  record.collapse_policy = policy_record(out, run.thinning.collapse_policy);
  record.layer_mode = static_cast<std::uint32_t>(run.thinning.layers.mode);
  record.quotas = out.put_all(run.quotas_millionths);
  record.boot_layers = out.put_all(run.boot_layers_millionths);
  record.thresholds = out.put_all(run.thresholds);
  record.angles = out.put_all(angles);
  record.rom = out.put(run.rom().bytes());
  return record;
}

void put_run(Writer& out, const DeviceRun& run) {
  std::vector<ExclusionRecord> exclusions;
  for (const NotOn& limit : run.not_on)
    exclusions.push_back({out.put_text(limit.board, kBoardMax), out.put_text(limit.reason, kReasonMax)});
  const Block name = out.put_text(run.name, kNameMax);
  const RunRecord record = run_record(out, run);
  const Block boards = out.put_all(exclusions);
  out.put_case({name, boards, static_cast<std::uint32_t>(Kind::kRun), out.put_all(std::vector{record})});
}

}  // namespace

std::vector<std::byte> write_bundle(std::span<const scenes::Scene> scenes, std::span<const DeviceRun> runs) {
  Writer out(scenes.size() + runs.size());
  for (const scenes::Scene& scene : scenes) put_scene(out, scene);
  for (const DeviceRun& run : runs) put_run(out, run);
  return out.finish();
}

}  // namespace usuzumi::golden
