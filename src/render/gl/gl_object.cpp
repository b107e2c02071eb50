#include "render/gl/gl_object.hpp"

#include <epoxy/gl.h>

#include <cstdint>

namespace elastolab {

void delete_gl_buffer(unsigned id) { glDeleteBuffers(1, &id); }
void delete_gl_vertex_array(unsigned id) { glDeleteVertexArrays(1, &id); }
void delete_gl_texture(unsigned id) { glDeleteTextures(1, &id); }
void delete_gl_renderbuffer(unsigned id) { glDeleteRenderbuffers(1, &id); }
void delete_gl_framebuffer(unsigned id) { glDeleteFramebuffers(1, &id); }
void delete_gl_shader(unsigned id) { glDeleteShader(id); }
void delete_gl_program(unsigned id) { glDeleteProgram(id); }

namespace {

/// `generate` is one of OpenGL's glGen... functions.
template <class Object, class Generate>
Object generated(Generate generate) {
    unsigned id = 0;
    generate(1, &id);
    return Object(id);
}

}  // namespace

GlBuffer make_gl_buffer() { return generated<GlBuffer>(glGenBuffers); }
GlVertexArray make_gl_vertex_array() { return generated<GlVertexArray>(glGenVertexArrays); }
GlTexture make_gl_texture() { return generated<GlTexture>(glGenTextures); }
GlRenderbuffer make_gl_renderbuffer() { return generated<GlRenderbuffer>(glGenRenderbuffers); }
GlFramebuffer make_gl_framebuffer() { return generated<GlFramebuffer>(glGenFramebuffers); }

void upload(const GlBuffer& buffer, std::span<const std::byte> bytes) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STREAM_DRAW);
}

void attach_indices(const GlVertexArray& vertex_array, const GlBuffer& indices) {
    glBindVertexArray(vertex_array.id());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.id());
    glBindVertexArray(0);
}

void attach(const GlVertexArray& vertex_array, const GlBuffer& buffer, const GlAttribute& attribute) {
    glBindVertexArray(vertex_array.id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glEnableVertexAttribArray(attribute.location);
    const auto* const offset = reinterpret_cast<const void*>(static_cast<std::uintptr_t>(attribute.offset));
    glVertexAttribPointer(attribute.location, attribute.components, attribute.bytes ? GL_UNSIGNED_BYTE : GL_FLOAT,
                          attribute.bytes ? GL_TRUE : GL_FALSE, static_cast<GLsizei>(attribute.stride), offset);
    glVertexAttribDivisor(attribute.location, attribute.per_instance ? 1 : 0);
    glBindVertexArray(0);
}

namespace {

void enable(GLenum what, bool on) { on ? glEnable(what) : glDisable(what); }

GLenum depth_function(GlState::Depth depth) {
    switch (depth) {
        case GlState::Depth::ignored:
            return GL_ALWAYS;
        case GlState::Depth::nearer:
            return GL_LESS;
        case GlState::Depth::nearer_or_equal:
            return GL_LEQUAL;
        case GlState::Depth::behind:
            return GL_GREATER;
    }
    return GL_LEQUAL;
}

}  // namespace

void apply(const GlState& state) {
    enable(GL_BLEND, state.blend);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(depth_function(state.depth));
    glDepthMask(state.write_depth ? GL_TRUE : GL_FALSE);
    enable(GL_CULL_FACE, state.cull != GlState::Cull::none);
    glCullFace(state.cull == GlState::Cull::front ? GL_FRONT : GL_BACK);
    const GLboolean colour = state.write_colour ? GL_TRUE : GL_FALSE;
    glColorMask(colour, colour, colour, colour);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_PROGRAM_POINT_SIZE);
}

const char* gl_error() {
    switch (glGetError()) {
        case GL_NO_ERROR:
            return "";
        case GL_INVALID_ENUM:
            return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE:
            return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION:
            return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_OUT_OF_MEMORY:
            return "GL_OUT_OF_MEMORY";
        default:
            return "unknown error of OpenGL";
    }
}

}  // namespace elastolab
