#include "gfx_subsystem/engine_osmesa/gl_pipeline.h"

#include <cstdint>

namespace usuzumi::gfx {
namespace {

using namespace command;

// Vertex attributes; position is 0, which the compatibility profile wants enabled in every draw.
constexpr GLuint kPosition = 0, kNormal = 1, kColour = 2, kTextureCoordinate = 3;

// Row 0 of the framebuffer is the panel's top (gl_surface.h), hence -clip.y.
constexpr const char* kVertexShader = R"(#version 120
uniform mat4 model_to_clip;
uniform bool lit;
uniform vec3 to_light, ambient, diffuse;
attribute vec3 position;
attribute vec3 normal;
attribute vec4 colour;
attribute vec2 texture_coordinate;
void main() {
  vec4 clip = model_to_clip * vec4(position, 1.0);
  gl_Position = vec4(clip.x, -clip.y, clip.z, clip.w);
  vec3 light = vec3(1.0);
  if (lit) light = min(vec3(1.0), ambient + diffuse * max(0.0, dot(max(normal, vec3(-1.0)), to_light)));
  gl_FrontColor = vec4(colour.rgb * light, colour.a);
  gl_TexCoord[0] = vec4(texture_coordinate, 0.0, 1.0);
})";
// The alpha test compares whole channels, as the engine has them. Bits 31-24 of a pixel that is not blended
// become 0xFF.
constexpr const char* kFragmentShader = R"(#version 120
uniform bool textured, blended;
uniform float alpha_reference;
uniform sampler2D image;
void main() {
  vec4 c = gl_Color;
  if (textured) c *= texture2D(image, gl_TexCoord[0].st);
  if (floor(c.a * 255.0 + 0.5) < alpha_reference) discard;
  gl_FragColor = vec4(c.rgb, blended ? c.a : 1.0);
})";

GLuint compile(GLenum type, const char* source) {
  const GLuint shader = glCreateShader(type);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  return shader;
}

constexpr GLenum topology_name(Topology t) {
  switch (t) {
    case Topology::kPoints: return GL_POINTS;
    case Topology::kLines: return GL_LINES;
    case Topology::kTriangles: return GL_TRIANGLES;
    case Topology::kTriangleStrip: return GL_TRIANGLE_STRIP;
    case Topology::kTriangleFan: return GL_TRIANGLE_FAN;
  }
  return GL_POINTS;
}

constexpr GLenum depth_function_name(DepthFunction f) {
  switch (f) {
    case DepthFunction::kAlways: return GL_ALWAYS;
    case DepthFunction::kLess: return GL_LESS;
    case DepthFunction::kLessEqual: return GL_LEQUAL;
  }
  return GL_ALWAYS;
}

void enable(GLenum capability, bool on) {
  if (on) glEnable(capability);
  else glDisable(capability);
}

GLboolean boolean(bool on) { return on ? GL_TRUE : GL_FALSE; }

void set_scissor(const SetScissor& s) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(static_cast<GLint>(s.x), static_cast<GLint>(s.y), static_cast<GLsizei>(s.width),
            static_cast<GLsizei>(s.height));
}

}  // namespace

GlPipeline::~GlPipeline() {
  if (program_ != 0) glDeleteProgram(program_);
  if (query_ != 0) glDeleteQueries(1, &query_);
}

Status GlPipeline::start() {
  const GLuint vertex = compile(GL_VERTEX_SHADER, kVertexShader),
               fragment = compile(GL_FRAGMENT_SHADER, kFragmentShader);
  program_ = glCreateProgram();
  glAttachShader(program_, vertex);
  glAttachShader(program_, fragment);
  glBindAttribLocation(program_, kPosition, "position");
  glBindAttribLocation(program_, kNormal, "normal");
  glBindAttribLocation(program_, kColour, "colour");
  glBindAttribLocation(program_, kTextureCoordinate, "texture_coordinate");
  glLinkProgram(program_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint linked = GL_FALSE;
  glGetProgramiv(program_, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE)
    return {StatusCode::kUnavailable, "OSMesa does not compile the engine's shaders; its OpenGL is too old", 0};
  model_to_clip_ = glGetUniformLocation(program_, "model_to_clip");
  lit_ = glGetUniformLocation(program_, "lit");
  to_light_ = glGetUniformLocation(program_, "to_light");
  ambient_ = glGetUniformLocation(program_, "ambient");
  diffuse_ = glGetUniformLocation(program_, "diffuse");
  textured_ = glGetUniformLocation(program_, "textured");
  blended_ = glGetUniformLocation(program_, "blended");
  alpha_reference_ = glGetUniformLocation(program_, "alpha_reference");
  glGenQueries(1, &query_);
  glDisable(GL_DITHER);
  // Points are squares around the exact vertex; without this OpenGL moves them to whole pixels.
  glEnable(GL_POINT_SPRITE);
  glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
  glEnableVertexAttribArray(kPosition);
  return ok_status();
}

void GlPipeline::clear(const EngineState& state, const Clear& clear) {
  set_scissor(state.scissor);
  GLbitfield planes = 0;
  if ((clear.planes & kClearColour) != 0) {
    const auto channel = [](std::uint32_t v) { return static_cast<float>(v) / 255.0f; };
    glClearColor(channel(clear.colour.r()), channel(clear.colour.g()), channel(clear.colour.b()), 1.0f);
    planes |= GL_COLOR_BUFFER_BIT;
  }
  if ((clear.planes & kClearDepth) != 0) {
    glDepthMask(GL_TRUE);
    glClearDepth(static_cast<double>(clear.depth));
    planes |= GL_DEPTH_BUFFER_BIT;
  }
  glClear(planes);
}

std::uint64_t GlPipeline::draw(const EngineState& state, const DrawCall& call) {
  set_scissor(state.scissor);
  apply_viewport(state.viewport);
  apply_raster_state(state.raster);
  glUseProgram(program_);
  apply_uniforms(state);
  apply_streams(state);
  if (!state.texels.empty()) texture_.bind(state);
  const bool tests_alpha = state.fragment.alpha_test != 0;
  const bool hides =
      tests_alpha || (state.raster.depth_test != 0 && state.raster.depth_function != DepthFunction::kAlways);
  std::uint64_t pixels_covered = 0;
  glUniform1f(alpha_reference_, 0);
  if (hides) {  // covered pixels that the tests will hide count too: drawn once to be counted, once to be seen
    glDisable(GL_DEPTH_TEST);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    pixels_covered = submit_counted(call);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  apply_depth_state(state.raster);
  if (tests_alpha) glUniform1f(alpha_reference_, static_cast<float>(state.fragment.alpha_reference));
  apply_blend_state(state.fragment);
  const std::uint64_t pixels_drawn = submit_counted(call);
  glDisable(GL_BLEND);
  return hides ? pixels_covered : pixels_drawn;
}

void GlPipeline::apply_viewport(const SetViewport& v) {
  glViewportIndexedf(0, v.x, v.y, v.width, v.height);
  glDepthRange(static_cast<double>(v.near_depth), static_cast<double>(v.far_depth));
}

void GlPipeline::apply_raster_state(const SetRasterState& raster) {
  glShadeModel(raster.shade_model == ShadeModel::kFlat ? GL_FLAT : GL_SMOOTH);
  enable(GL_CULL_FACE, raster.cull != CullMode::kNone);
  if (raster.cull != CullMode::kNone) glCullFace(raster.cull == CullMode::kBack ? GL_BACK : GL_FRONT);
  // OpenGL sees the panel upside down, and so every winding turned round.
  glFrontFace(raster.front_face == FrontFace::kCounterClockwise ? GL_CW : GL_CCW);
  glPointSize(raster.point_size);
  glLineWidth(raster.line_width);
}

void GlPipeline::apply_depth_state(const SetRasterState& raster) {
  enable(GL_DEPTH_TEST, raster.depth_test != 0);
  glDepthFunc(depth_function_name(raster.depth_function));
  glDepthMask(boolean(raster.depth_write != 0));
}

/// Alpha adds up, so that bits 31-24 that were 0xFF stay so.
void GlPipeline::apply_blend_state(const SetFragmentState& fragment) {
  enable(GL_BLEND, fragment.blend == BlendMode::kAlpha);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE);
}

void GlPipeline::apply_uniforms(const EngineState& state) {
  glUniformMatrix4fv(model_to_clip_, 1, GL_TRUE, state.transform.model_to_clip.m);
  glUniform1i(lit_, state.light.enabled != 0 && !state.normals.empty() ? 1 : 0);
  glUniform1i(textured_, state.texels.empty() ? 0 : 1);
  glUniform1i(blended_, state.fragment.blend == BlendMode::kAlpha ? 1 : 0);
  const auto set = [](GLint uniform, Vec3 v) { glUniform3f(uniform, v.x, v.y, v.z); };
  set(to_light_, state.light.to_light);
  set(ambient_, state.light.ambient);
  set(diffuse_, state.light.diffuse);
}

void GlPipeline::apply_streams(const EngineState& state) {
  const auto stride = [](std::uint32_t bytes) { return static_cast<GLsizei>(bytes); };
  glVertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, stride(state.streams.position_stride),
                        state.positions.data());
  apply_texture_coordinates(state);
  if (state.normals.empty()) {
    glDisableVertexAttribArray(kNormal);
  } else {
    glEnableVertexAttribArray(kNormal);
    glVertexAttribPointer(kNormal, 4, GL_INT_2_10_10_10_REV, GL_TRUE, stride(state.streams.normal_stride),
                          state.normals.data());
  }
  if (state.colours.empty()) {
    const Rgba8 c = state.streams.constant_colour;
    glDisableVertexAttribArray(kColour);
    glVertexAttrib4Nub(kColour, static_cast<GLubyte>(c.r()), static_cast<GLubyte>(c.g()), static_cast<GLubyte>(c.b()),
                       static_cast<GLubyte>(c.a()));
  } else {
    glEnableVertexAttribArray(kColour);
    glVertexAttribPointer(kColour, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride(state.streams.colour_stride),
                          state.colours.data());
  }
}

void GlPipeline::apply_texture_coordinates(const EngineState& state) {
  if (state.texture_coordinates.empty()) return glDisableVertexAttribArray(kTextureCoordinate);
  glEnableVertexAttribArray(kTextureCoordinate);
  glVertexAttribPointer(kTextureCoordinate, 2, GL_FLOAT, GL_FALSE,
                        static_cast<GLsizei>(state.streams.texture_coordinate_stride),
                        state.texture_coordinates.data());
}

std::uint64_t GlPipeline::submit_counted(const DrawCall& call) {
  const GLenum topology = topology_name(call.draw.topology);
  const auto count = static_cast<GLsizei>(call.draw.count);
  glBeginQuery(GL_SAMPLES_PASSED, query_);
  if (call.draw.index_format == IndexFormat::kNone) {
    glDrawArrays(topology, static_cast<GLint>(call.draw.first), count);
  } else {
    const GLenum type = call.draw.index_format == IndexFormat::kU16 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
    glDrawRangeElements(topology, call.min_vertex, call.max_vertex, count, type, call.indices.data());
  }
  glEndQuery(GL_SAMPLES_PASSED);
  GLuint samples = 0;  // saturates at 2^32 - 1, some 250 times the largest target
  glGetQueryObjectuiv(query_, GL_QUERY_RESULT, &samples);
  return samples;
}

}  // namespace usuzumi::gfx
