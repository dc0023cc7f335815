#include "gfx_subsystem/engine_soft/soft_engine.h"

#include <algorithm>
#include <cmath>

namespace usuzumi::gfx {

using namespace soft;

namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::uint32_t kMaxJobs = 96;

/// Primitives after which the round's `job`-th job is closed. Small ones first, so that a small scene too is shared out
/// among threads; they double until a job's vertices just stay in the nearer caches, so that the table serves large
/// scenes. Found by measuring; no byte depends on it.
constexpr std::uint32_t primitives_in_job(std::uint32_t job) {
  const std::uint32_t doublings = job / 8;
  return doublings >= 4 ? 8192 : 512u << doublings;
}

TileGrid grid_of(std::uint32_t width, std::uint32_t height) {
  const auto tiles = [](std::uint32_t pixels) {
    return (static_cast<std::int32_t>(pixels) + kTileSize - 1) / kTileSize;
  };
  return {tiles(width), tiles(height)};
}

/// A pool in which every triangle fits: its record, a fresh block in every tile.
std::uint32_t minimum_slots(std::uint32_t tiles) { return tiles + kBigSlots + kBigTextureSlots; }

/// The tables' sizes for a given amount of memory.
struct Layout {
  std::uint32_t workers, vertices, draws, clears, items, jobs;

  Layout(std::size_t bytes, std::uint32_t tiles, std::uint32_t threads) {
    const auto share = [bytes](std::size_t parts, std::size_t element, std::size_t least, std::size_t most) {
      return static_cast<std::uint32_t>(std::clamp(bytes / parts / element, least, most));
    };
    workers = share(4, 2 * kTilePixels * sizeof(std::uint32_t), 1, threads);
    vertices = share(std::size_t{8} * workers, sizeof(Vertex), kMinVertexCapacity, 8192);
    draws = share(64, sizeof(DrawSetup), 1, kMaxDraws);
    clears = share(256, sizeof(ClearOperation), 1, 64);
    items = share(64, sizeof(WorkItem), 2, 1024);
    jobs = share(16, sizeof(Job) + tiles * sizeof(TileList), 1, kMaxJobs);
  }
};

std::uint32_t primitive_count(command::Topology topology, std::uint32_t vertices) {
  switch (topology) {
    case command::Topology::kPoints: return vertices;
    case command::Topology::kLines: return vertices / 2;
    default: return face_count(topology, vertices);
  }
}

std::uint32_t depth_value(command::DepthFormat format, float depth) {
  const double most = format == command::DepthFormat::kUnorm16 ? 65535.0 : 16777215.0;
  return static_cast<std::uint32_t>(std::floor(static_cast<double>(depth) * most + 0.5));
}

const Kernels* best_kernels() {
  const Kernels* best = nullptr;
  for (const Kernels* k : all_kernels())
    if (k->supported()) best = k;
  return best;
}

}  // namespace

SoftEngine::SoftEngine(const Config& config)
    : kernels_(config.kernels != nullptr ? config.kernels : best_kernels()),
      work_memory_(config.work_memory),
      runner_(config.runner),
      streaming_bytes_(config.streaming_bytes) {}

std::size_t SoftEngine::minimum_work_bytes(std::uint32_t width, std::uint32_t height) {
  const std::uint32_t tiles = grid_of(width, height).count();
  // The tables' least sizes; their shares of a memory this small are no larger than what the pool leaves.
  const std::size_t tables = kMinVertexCapacity * sizeof(Vertex) + sizeof(DrawSetup) + sizeof(ClearOperation) +
                             2 * sizeof(WorkItem) + sizeof(Job) + tiles * sizeof(TileList) + 7 * kCacheLine;
  const std::size_t buffers = 2 * kTilePixels * sizeof(std::uint32_t);
  // Shares: 1/8 vertices, 1/64 draws, 1/256 clears, 1/64 items, 1/16 jobs: less than a quarter; so 4/3 of the rest is
  // enough.
  return (tables + buffers + minimum_slots(tiles) * kSlotBytes) * 4 / 3 + kCacheLine;
}

ExecutionReport SoftEngine::do_execute(std::span<const std::uint32_t> list, BusMemory& memory) {
  counters_ = {};
  round_ = {};
  draw_count_ = clear_count_ = item_count_ = job_count_ = 0;
  ExecutionReport report;
  report.status = decode(list, memory, *this, counters_.command_words);
  finish_round();
  for (Worker& w : workers_) {
    counters_.pixels_tested += w.pixels_tested;
    counters_.texels_fetched += w.texels_fetched;
    counters_.pixels_blended += w.pixels_blended;
    w.pixels_tested = w.texels_fetched = w.pixels_blended = 0;
  }
  report.counters = counters_;
  return report;
}

Status SoftEngine::bind_target(const EngineState& s) {
  RoundTarget t;
  t.colour = s.colour_memory.data();
  t.colour_stride = s.colour_target.stride_bytes;
  t.width = static_cast<std::int32_t>(s.colour_target.width);
  t.height = static_cast<std::int32_t>(s.colour_target.height);
  t.rgb565 = s.colour_target.format == command::PixelFormat::kRgb565;
  t.depth = s.depth_memory.data();
  t.depth_stride = s.depth_target.stride_bytes;
  t.depth16 = s.depth_target.format == command::DepthFormat::kUnorm16;
  const auto lines = [](const std::byte* plane, std::uint32_t stride) {
    return (reinterpret_cast<std::uintptr_t>(plane) | stride) % kCacheLine == 0;
  };
  t.streaming = s.colour_memory.size() + s.depth_memory.size() >= streaming_bytes_ && !t.rgb565 && t.width % 16 == 0 &&
                lines(t.colour, t.colour_stride) && lines(t.depth, t.depth_stride);
  if (t == round_.target) return ok_status();
  finish_round();
  round_ = {};
  round_.grid = grid_of(s.colour_target.width, s.colour_target.height);
  if (!lay_out_memory()) {
    round_ = {};
    return {StatusCode::kResourceExhausted,
            "the engine's working memory is too small for this target; see minimum_work_bytes", 0};
  }
  round_.target = t;
  return ok_status();
}

bool SoftEngine::lay_out_memory() {
  const std::uint32_t tiles = round_.grid.count();
  const std::uint32_t threads =
      runner_ == nullptr ? 1 : std::clamp<std::uint32_t>(runner_->thread_count(), 1, kMaxWorkers);
  const Layout layout(work_memory_.size(), tiles, threads);
  Arena arena(work_memory_);
  bool fits = true;
  const auto take = [&]<class T>(std::span<T>& table, std::size_t count, std::size_t alignment = alignof(T)) {
    table = arena.allocate<T>(count, alignment);
    fits = fits && !table.empty();
    return table.data();
  };
  worker_count_ = layout.workers;
  for (std::uint32_t w = 0; w < worker_count_; ++w) {
    std::span<std::uint32_t> pixels;
    std::span<Vertex> vertices;
    workers_[w].colour = take(pixels, kTilePixels, kCacheLine);
    workers_[w].depth = take(pixels, kTilePixels, kCacheLine);
    workers_[w].vertices = take(vertices, layout.vertices, kCacheLine);
    workers_[w].vertex_capacity = layout.vertices;
  }
  take(draws_, layout.draws);
  take(clears_, layout.clears);
  take(items_, layout.items);
  take(jobs_, layout.jobs);
  take(lists_, std::size_t{layout.jobs} * tiles);
  const std::size_t padding = kCacheLine;
  if (!fits || arena.available() < minimum_slots(tiles) * std::size_t{kSlotBytes} + padding) return false;
  const auto slots =
      static_cast<std::uint32_t>(std::min<std::size_t>((arena.available() - padding) / kSlotBytes, kEntrySlotMask));
  pool_.reset(arena.allocate<Slot>(slots, kCacheLine).data(), slots);
  round_.draws = draws_.data();
  round_.clears = clears_.data();
  round_.items = items_.data();
  round_.jobs = jobs_.data();
  round_.pool = &pool_;
  for (std::uint32_t j = 0; j < layout.jobs; ++j) jobs_[j].lists = &lists_[std::size_t{j} * tiles];
  return true;
}

Status SoftEngine::clear(const EngineState& s, const command::Clear& c) {
  if (Status status = bind_target(s); !status.ok()) return status;
  counters_.pixels_cleared += std::uint64_t{s.scissor.width} * s.scissor.height;
  if (c.planes == 0 || s.scissor.width == 0 || s.scissor.height == 0) return ok_status();
  if (clear_count_ == clears_.size() || item_count_ == items_.size()) finish_round();
  ClearOperation& op = clears_[clear_count_];
  op.rect = {static_cast<std::int32_t>(s.scissor.x), static_cast<std::int32_t>(s.scissor.y),
             static_cast<std::int32_t>(s.scissor.x + s.scissor.width),
             static_cast<std::int32_t>(s.scissor.y + s.scissor.height)};
  op.colour = (c.planes & command::kClearColour) != 0;
  op.depth = (c.planes & command::kClearDepth) != 0;
  op.pixel = pack_pixel(s.colour_target.format, c.colour);
  op.depth_value = op.depth ? depth_value(s.depth_target.format, c.depth) : 0;
  round_.uses_depth |= op.depth;
  append_item({true, clear_count_++, 0, 0});
  return ok_status();
}

Status SoftEngine::draw(const EngineState& s, const DrawCall& call) {
  const std::uint32_t primitives = primitive_count(call.draw.topology, call.draw.count);
  counters_.vertices_transformed += std::uint64_t{call.max_vertex} - call.min_vertex + 1;
  counters_.primitives_in += primitives;
  counters_.faces_in += face_count(call.draw.topology, call.draw.count);
  if (Status status = bind_target(s); !status.ok()) return status;
  if (primitives == 0) return ok_status();
  if (draw_count_ == draws_.size()) finish_round();
  draws_[draw_count_] = prepare_draw(s, call);
  round_.uses_depth |= s.raster.depth_test != 0;
  add_draw_items(draw_count_++, primitives);
  return ok_status();
}

void SoftEngine::add_draw_items(std::uint32_t draw, std::uint32_t primitives) {
  for (std::uint32_t first = 0; first < primitives;) {
    if (item_count_ == items_.size() || (job_count_ == jobs_.size() && open_job_room_ == 0)) {
      // The tables begin anew; the draw goes on in the next round.
      const DrawSetup setup = draws_[draw];
      const bool uses_depth = round_.uses_depth;
      finish_round();
      round_.uses_depth = uses_depth;
      draws_[0] = setup;
      draw = 0;
      draw_count_ = 1;
    }
    const std::uint32_t room = open_job_room_ > 0 ? open_job_room_ : primitives_in_job(job_count_);
    const std::uint32_t count = std::min(primitives - first, room);
    append_item({false, draw, first, count});
    first += count;
  }
}

/// The item table has room.
void SoftEngine::append_item(const WorkItem& item) {
  items_[item_count_] = item;
  if (open_job_room_ == 0 && job_count_ < jobs_.size()) {
    open_job_room_ = primitives_in_job(job_count_);
    Job& job = jobs_[job_count_++];
    job = {{item_count_, 0, 0}, item_count_, false, 0, job.lists};
  }
  ++item_count_;
  jobs_[job_count_ - 1].end_item = item_count_;
  open_job_room_ -= item.count;
}

void SoftEngine::finish_round() {
  std::uint32_t first_left = draw_count_ == 0 ? job_count_ : 0;  // jobs before are done
  if (draw_count_ == 0 && clear_count_ != 0) run_clears();
  bool alone = false;            // only the first job left may use the pool
  while (first_left < job_count_) {
    round_.jobs = &jobs_[first_left];
    phase_jobs_ = alone ? 1 : job_count_ - first_left;
    JobPosition start[kMaxJobs];
    for (std::uint32_t j = 0; j < phase_jobs_; ++j) start[j] = round_.jobs[j].next;
    const std::uint32_t complete = run_geometry();
    // The first incomplete job has binned the head of its work. What later ones have binned is dropped and done again.
    const std::uint32_t usable = std::min(complete + 1, phase_jobs_);
    for (std::uint32_t j = usable; j < phase_jobs_; ++j) round_.jobs[j].next = start[j];
    alone = complete == 0 && round_.jobs[0].next == start[0];
    for (std::uint32_t j = 0; j < usable; ++j) counters_.faces_drawn += round_.jobs[j].faces_drawn;
    run_tiles(usable);
    first_left += complete;
  }
  round_.jobs = jobs_.data();
  round_.uses_depth = false;
  draw_count_ = clear_count_ = item_count_ = job_count_ = 0;
  open_job_room_ = 0;
}

/// Runs the phase's jobs; how many of them, from the first on, are complete.
std::uint32_t SoftEngine::run_geometry() {
  pool_.reuse();
  exhausted_.store(false, std::memory_order_relaxed);
  next_job_.store(0, std::memory_order_relaxed);
  for (std::uint32_t j = 0; j < phase_jobs_; ++j) {
    round_.jobs[j].complete = false;
    round_.jobs[j].faces_drawn = 0;
  }
  run_workers<&SoftEngine::run_geometry_worker>(phase_jobs_ == 1);
  std::uint32_t complete = 0;
  while (complete < phase_jobs_ && round_.jobs[complete].complete) ++complete;
  return complete;
}

void SoftEngine::run_geometry_worker(std::uint32_t worker) {
  const std::uint32_t tiles = round_.grid.count();
  while (!exhausted_.load(std::memory_order_relaxed)) {
    const std::uint32_t j = next_job_.fetch_add(1, std::memory_order_relaxed);
    if (j >= phase_jobs_) return;
    Job& job = round_.jobs[j];
    std::fill_n(job.lists, tiles, TileList{});
    kernels_->run_geometry(round_, job, workers_[worker]);
    if (!job.complete) exhausted_.store(true, std::memory_order_relaxed);
  }
}

void SoftEngine::run_tiles(std::uint32_t jobs) {
  phase_jobs_ = jobs;
  share_out(round_.grid.count());
  run_workers<&SoftEngine::run_tile_worker>(false);
}

void SoftEngine::run_tile_worker(std::uint32_t worker) {
  for (std::uint32_t w = 0; w < worker_count_; ++w) {  // its own share, then what the others have left
    Share& share = shares_[(worker + w) % worker_count_];
    for (;;) {
      const std::uint32_t part = share.next.fetch_add(1, std::memory_order_relaxed);
      if (part >= share.end) break;
      if (draw_count_ == 0) kernels_->run_clears(round_, part);
      else kernels_->run_tile(round_, workers_[worker], part, phase_jobs_);
    }
  }
}

void SoftEngine::run_clears() {
  round_.clear_count = clear_count_;
  share_out(static_cast<std::uint32_t>(round_.grid.rows));
  run_workers<&SoftEngine::run_tile_worker>(false);
}

/// Every worker begins at a place of its own, the same in every frame: a tile is then mostly stored by the core whose
/// caches hold its lines.
void SoftEngine::share_out(std::uint32_t parts) {
  for (std::uint32_t w = 0; w < worker_count_; ++w) {
    shares_[w].next.store(parts * w / worker_count_, std::memory_order_relaxed);
    shares_[w].end = parts * (w + 1) / worker_count_;
  }
}

template <void (SoftEngine::*work)(std::uint32_t)>
void SoftEngine::run_workers(bool alone) {
  if (worker_count_ > 1 && !alone)
    runner_->run(
        worker_count_, [](void* engine, std::uint32_t w) { (static_cast<SoftEngine*>(engine)->*work)(w); }, this);
  else
    (this->*work)(0);
}

}  // namespace usuzumi::gfx
