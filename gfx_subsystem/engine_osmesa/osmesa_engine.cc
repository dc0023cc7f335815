#include "gfx_subsystem/engine_osmesa/osmesa_engine.h"

#include <optional>

#include "gfx_subsystem/engine/state.h"
#include "gfx_subsystem/engine_osmesa/face_counter.h"
#include "gfx_subsystem/engine_osmesa/gl_context.h"
#include "gfx_subsystem/engine_osmesa/gl_pipeline.h"
#include "gfx_subsystem/engine_osmesa/gl_surface.h"

namespace usuzumi::gfx {
namespace {

using namespace command;

bool covers_target(const EngineState& state) {
  const auto &s = state.scissor;
  return s.width == state.colour_target.width && s.height == state.colour_target.height;
}

std::uint64_t primitive_count(const Draw& draw) {
  switch (draw.topology) {
    case Topology::kPoints: return draw.count;
    case Topology::kLines: return draw.count / 2;
    default: return face_count(draw.topology, draw.count);
  }
}

// Draws what the decoder has proven sound, and counts.
class GlSink final : public CommandSink {
 public:
  GlSink(GlSurface& surface, GlPipeline& pipeline, EngineCounters& counters)
      : surface_(surface), pipeline_(pipeline), counters_(counters) {}

  Status clear(const EngineState& state, const Clear& clear) override {
    Status status = surface_.select(state);
    if (!status.ok()) return status;
    if ((clear.planes & kClearColour) != 0) surface_.prepare_colour(covers_target(state));
    if ((clear.planes & kClearDepth) != 0) surface_.prepare_depth(covers_target(state));
    pipeline_.clear(state, clear);
    if (clear.planes != 0) counters_.pixels_cleared += std::uint64_t{state.scissor.width} * state.scissor.height;
    return ok_status();
  }

  Status draw(const EngineState& state, const DrawCall& call) override {
    Status status = surface_.select(state);
    if (!status.ok()) return status;
    surface_.prepare_colour(false);
    if (state.raster.depth_test != 0) surface_.prepare_depth(false);
    counters_.vertices_transformed += std::uint64_t{call.max_vertex} - call.min_vertex + 1;
    counters_.primitives_in += primitive_count(call.draw);
    counters_.faces_in += face_count(call.draw.topology, call.draw.count);
    counters_.faces_drawn += count_faces_drawn(state, call);
    const std::uint64_t pixels = pipeline_.draw(state, call);
    counters_.pixels_tested += pixels;
    if (!state.texels.empty())
      counters_.texels_fetched += pixels * (state.texture.filter == TextureFilter::kBilinear ? 4 : 1);
    if (state.fragment.blend == BlendMode::kAlpha) counters_.pixels_blended += pixels;
    return ok_status();
  }

 private:
  GlSurface& surface_;
  GlPipeline& pipeline_;
  EngineCounters& counters_;
};

// The first error since the last call; all are taken off OpenGL's record.
Status take_gl_error() {
  const GLenum first = glGetError();
  for (GLenum e = first; e != GL_NO_ERROR; e = glGetError()) {
  }
  if (first == GL_NO_ERROR) return ok_status();
  if (first == GL_OUT_OF_MEMORY) return {StatusCode::kResourceExhausted, "OSMesa is out of memory", 0};
  return {StatusCode::kUnavailable, "OSMesa refused a call of the list's drawing", 0};
}

}  // namespace

class OsmesaEngine::Implementation {
 public:
  explicit Implementation(std::uint32_t threads) : context_(threads), status_(context_.status()) {
    if (!status_.ok()) return;
    const GlContext::Current current(context_);
    pipeline_.emplace();
    surface_.emplace();
    status_ = pipeline_->start();
  }

  ~Implementation() {
    if (!context_.status().ok()) return;
    const GlContext::Current current(context_);
    surface_.reset();
    pipeline_.reset();
  }

  const Status& status() const { return status_; }
  const char* renderer() const { return status_.ok() ? context_.renderer().c_str() : ""; }

  ExecutionReport execute(std::span<const std::uint32_t> list, BusMemory& memory) {
    ExecutionReport report;
    report.status = status_;
    if (!status_.ok()) return report;
    const GlContext::Current current(context_);
    if (!current.ok()) {
      report.status = {StatusCode::kUnavailable, "OSMesa cannot make its context current on this thread", 0};
      return report;
    }
    pipeline_->begin_list();
    GlSink sink(*surface_, *pipeline_, report.counters);
    report.status = decode(list, memory, sink, report.counters.command_words);
    surface_->store();  // whatever stopped the list, what was drawn before stays drawn
    const Status gl_status = take_gl_error();
    if (report.status.ok()) report.status = gl_status;
    return report;
  }

 private:
  GlContext context_;
  Status status_;
  std::optional<GlPipeline> pipeline_;  // these two live only while the context does, and end with it current
  std::optional<GlSurface> surface_;
};

OsmesaEngine::OsmesaEngine(std::uint32_t threads) : implementation_(std::make_unique<Implementation>(threads)) {}
OsmesaEngine::~OsmesaEngine() = default;

const Status& OsmesaEngine::status() const { return implementation_->status(); }
const char* OsmesaEngine::renderer() const { return implementation_->renderer(); }

ExecutionReport OsmesaEngine::do_execute(std::span<const std::uint32_t> list, BusMemory& memory) {
  return implementation_->execute(list, memory);
}

}  // namespace usuzumi::gfx
