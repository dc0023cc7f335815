#include "tests/golden/player/player.h"

#include "boards/common/text_line.h"
#include "tests/golden/player/cases.h"

namespace usuzumi::golden {
namespace {

using boards::TextLine;

Status play_case(const Bundle& bundle, std::uint32_t n, const Bundle::Heading& heading, std::string_view board,
                 const PlayerMemory& memory, ResultSink& out) {
  const auto exclusion = bundle.exclusion(n, board);
  if (!exclusion.ok()) return exclusion.status();
  if (!exclusion->empty()) {
    out.line(TextLine().text(heading.name).text(" not on ").text(board).text(": ").text(*exclusion));
    return ok_status();
  }
  return heading.kind == bundle::Kind::kScene ? play_scene(bundle, n, heading.name, memory, out)
                                             : play_run(bundle, n, heading.name, memory, out);
}

}  // namespace

Status play(std::span<const std::byte> bundle_bytes, const PlayerMemory& memory, std::string_view board,
            LineSink& out) {
  const auto bundle = Bundle::open(bundle_bytes);
  TextLine begin, end;
  begin.text("# golden: ");
  if (!bundle.ok()) {
    out.line(begin.text(bundle.status().message).text(" ").number(bundle.status().where).finish());
    return bundle.status();
  }
  out.line(begin.number(bundle->case_count()).text(" cases on ").text(board).finish());
  ResultSink results(out);
  Status first = ok_status();
  for (std::uint32_t n = 0; n < bundle->case_count(); ++n) {
    const auto heading = bundle->heading(n);
    const Status status = heading.ok() ? play_case(*bundle, n, *heading, board, memory, results) : heading.status();
    if (status.ok()) continue;
    results.line(TextLine().text(heading.ok() ? heading->name : "a case").text(" failed: ").text(status.message)
                     .text(" ").number(status.where));
    if (first.ok()) first = status;
  }
  out.line(end.text("# golden: done, ").number(results.count()).text(" lines").finish());
  return first;
}

}  // namespace usuzumi::golden
