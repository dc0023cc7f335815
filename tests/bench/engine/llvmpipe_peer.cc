#define GL_GLEXT_PROTOTYPES
#include "tests/bench/engine/llvmpipe_peer.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/osmesa.h>

#include <cstdlib>
#include <stdexcept>

namespace usuzumi::bench {

void LlvmpipePeer::choose_driver() {
  setenv("LP_NUM_THREADS", "0", 1);
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
}

LlvmpipePeer::LlvmpipePeer(const BenchScene& scene)
    : scene_(scene), context_(OSMesaCreateContextExt(OSMESA_BGRA, 24, 0, 0, nullptr)) {
  pixels_.resize(std::size_t{scene.width} * scene.height);
  if (context_ == nullptr ||
      OSMesaMakeCurrent(static_cast<OSMesaContext>(context_), pixels_.data(), GL_UNSIGNED_BYTE,
                        static_cast<GLsizei>(scene.width), static_cast<GLsizei>(scene.height)) == GL_FALSE)
    throw std::runtime_error("OSMesa has no context to give");
  renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_LIGHTING);
  glDisable(GL_DITHER);
  glShadeModel(scene.flat ? GL_FLAT : GL_SMOOTH);
  glMatrixMode(GL_PROJECTION);
  glLoadTransposeMatrixf(scene.transform.m);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glClearColor(0.1f, 0.1f, 0.12f, 1);
  if (scene.clear_only) return;
  glGenBuffers(4, buffers_);
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(scene.positions.size() * sizeof(Vec3)), scene.positions.data(),
               GL_STATIC_DRAW);
  glEnableClientState(GL_VERTEX_ARRAY);
  glVertexPointer(3, GL_FLOAT, 0, nullptr);
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[1]);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(scene.colours.size() * sizeof(Rgba8)), scene.colours.data(),
               GL_STATIC_DRAW);
  glEnableClientState(GL_COLOR_ARRAY);
  glColorPointer(4, GL_UNSIGNED_BYTE, 0, nullptr);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[2]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(scene.indices.size() * 4), scene.indices.data(),
               GL_STATIC_DRAW);
  if (scene.texture.width != 0) set_texture();
}

void LlvmpipePeer::set_texture() {
  const BenchTexture& t = scene_.texture;
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[3]);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(scene_.coordinates.size() * sizeof(TexCoord)),
               scene_.coordinates.data(), GL_STATIC_DRAW);
  glEnableClientState(GL_TEXTURE_COORD_ARRAY);
  glTexCoordPointer(2, GL_FLOAT, 0, nullptr);
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  const std::uint32_t* texels = t.texels.data();
  for (std::uint32_t i = 0; i < t.levels; ++i) {
    const std::uint32_t width = t.width >> i, height = t.height >> i;  // a square: neither reaches 0 first
    glTexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), GL_RGBA8, static_cast<GLsizei>(width),
                 static_cast<GLsizei>(height), 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, texels);
    texels += std::size_t{width} * height;
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                  t.bilinear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, t.bilinear ? GL_LINEAR : GL_NEAREST);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
  glEnable(GL_TEXTURE_2D);
  if (!scene_.blended) return;
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

LlvmpipePeer::~LlvmpipePeer() { OSMesaDestroyContext(static_cast<OSMesaContext>(context_)); }

void LlvmpipePeer::draw() {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (!scene_.clear_only)
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(scene_.indices.size()), GL_UNSIGNED_INT, nullptr);
  glFinish();
}

}  // namespace usuzumi::bench
