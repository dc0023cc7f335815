#include "gfx_subsystem/engine_osmesa/gl_context.h"

#include <cstdlib>
#include <string_view>

namespace usuzumi::gfx {
namespace {

// Viewports in fractions of a pixel came with 4.1, normals as c / 511 (not (2c + 1) / 1023) with 4.2.
constexpr int kMajorVersion = 4;
constexpr int kMinorVersion = 2;

Status unavailable(const char* message) { return {StatusCode::kUnavailable, message, 0}; }

// Mesa reads these when its first context is made. What the user has set stays.
void choose_driver(std::uint32_t threads) {
  constexpr int kKeepUsers = 0;
  ::setenv("GALLIUM_DRIVER", "llvmpipe", kKeepUsers);
  ::setenv("MESA_SHADER_CACHE_DISABLE", "true", kKeepUsers);  // nothing is left in the user's home
  if (threads == 0) return;  // llvmpipe's default: one per processor
  // llvmpipe counts the threads beside the caller's and lets the caller rasterize only when there are none.
  ::setenv("LP_NUM_THREADS", std::to_string(threads == 1 ? 0 : threads).c_str(), kKeepUsers);
}

std::string_view gl_string(GLenum name) {
  const auto* text = glGetString(name);
  return text == nullptr ? std::string_view() : std::string_view(reinterpret_cast<const char*>(text));
}

}  // namespace

GlContext::GlContext(std::uint32_t threads) : status_(start(threads)) {}

GlContext::~GlContext() {
  if (context_ != nullptr) OSMesaDestroyContext(context_);
}

bool GlContext::make_current() {
  return context_ != nullptr &&
         OSMesaMakeCurrent(context_, unused_, GL_UNSIGNED_BYTE, kUnusedSize, kUnusedSize) == GL_TRUE;
}

Status GlContext::start(std::uint32_t threads) {
  choose_driver(threads);
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_BGRA,
                            OSMESA_PROFILE,
                            OSMESA_COMPAT_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            kMajorVersion,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            kMinorVersion,
                            0};
  context_ = OSMesaCreateContextAttribs(attributes, nullptr);
  if (context_ == nullptr)
    return unavailable(
        "OSMesa cannot make an OpenGL 4.2 context; install libosmesa6 (Mesa 20 or newer), or unset GALLIUM_DRIVER");
  const Current current(*this);
  if (!current.ok()) return unavailable("OSMesa made a context but cannot make it current");
  renderer_ = gl_string(GL_RENDERER);
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (driver != nullptr && std::string_view(driver) == "llvmpipe" && !renderer_.starts_with("llvmpipe"))
    return unavailable(
        "OSMesa was asked for llvmpipe and started another renderer; this Mesa is built without llvmpipe");
  return ok_status();
}

}  // namespace usuzumi::gfx
