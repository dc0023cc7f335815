// One OSMesa context: started, checked, and made current for the length of a scope.
#pragma once

#include <cstdint>
#include <string>

#include "gfx_subsystem/engine_osmesa/gl.h"
#include "hal/status.h"

namespace usuzumi::gfx {

class GlContext {
 public:
  explicit GlContext(std::uint32_t threads);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  const Status& status() const { return status_; }
  const std::string& renderer() const { return renderer_; }

  /// Makes the context current on the calling thread, and no context current at the scope's end. Whoever draws holds
  /// one.
  class Current {
   public:
    explicit Current(GlContext& context) : ok_(context.make_current()) {}
    ~Current() { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    bool ok() const { return ok_; }

   private:
    bool ok_;
  };

 private:
  bool make_current();
  Status start(std::uint32_t threads);

  // OSMesa insists on a buffer of its own; everything is drawn into a framebuffer object instead.
  static constexpr int kUnusedSize = 4;
  std::uint32_t unused_[kUnusedSize * kUnusedSize] = {};
  OSMesaContext context_ = nullptr;
  std::string renderer_;
  Status status_;
};

}  // namespace usuzumi::gfx
