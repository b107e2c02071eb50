#pragma once

#include <cstddef>
#include <span>
#include <utility>

namespace elastolab {

/// Owns one OpenGL object (3.3 core). Made, used and destroyed on the thread of the context, while that is current.
/// An empty one (0) is fine to destroy.
template <void (*Destroy)(unsigned)>
class GlObject {
public:
    GlObject() = default;
    explicit GlObject(unsigned id) : id_(id) {}
    ~GlObject() {
        if (id_ != 0) Destroy(id_);
    }
    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }

    unsigned id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

private:
    unsigned id_ = 0;
};

void delete_gl_buffer(unsigned id);
void delete_gl_vertex_array(unsigned id);
void delete_gl_texture(unsigned id);
void delete_gl_renderbuffer(unsigned id);
void delete_gl_framebuffer(unsigned id);
void delete_gl_shader(unsigned id);
void delete_gl_program(unsigned id);

using GlBuffer = GlObject<delete_gl_buffer>;
using GlVertexArray = GlObject<delete_gl_vertex_array>;
using GlTexture = GlObject<delete_gl_texture>;
using GlRenderbuffer = GlObject<delete_gl_renderbuffer>;
using GlFramebuffer = GlObject<delete_gl_framebuffer>;
using GlShader = GlObject<delete_gl_shader>;
using GlProgram = GlObject<delete_gl_program>;

GlBuffer make_gl_buffer();
GlVertexArray make_gl_vertex_array();
GlTexture make_gl_texture();
GlRenderbuffer make_gl_renderbuffer();
GlFramebuffer make_gl_framebuffer();

/// Replaces what the buffer holds. The old storage is orphaned, so this never waits for a draw that still reads it.
void upload(const GlBuffer& buffer, std::span<const std::byte> bytes);
template <class T>
void upload(const GlBuffer& buffer, std::span<const T> values) {
    upload(buffer, std::as_bytes(values));
}

/// A buffer of vertex numbers that `vertex_array` draws with; uploads to it leave the array alone.
void attach_indices(const GlVertexArray& vertex_array, const GlBuffer& indices);

/// An attribute of the vertices that `vertex_array` reads from `buffer`.
struct GlAttribute {
    unsigned location = 0;
    int components = 3;
    std::size_t offset = 0, stride = 0;  ///< [bytes]
    bool bytes = false;                  ///< unsigned bytes that stand for [0, 1], instead of floats
    bool per_instance = false;
};
void attach(const GlVertexArray& vertex_array, const GlBuffer& buffer, const GlAttribute& attribute);

/// The fixed-function state that a drawing needs. Every drawing sets its own and leaves it; nothing is restored.
struct GlState {
    enum class Depth { ignored, nearer, nearer_or_equal, behind };
    enum class Cull { none, back, front };
    bool blend = false;  ///< by the opacity of the source
    Depth depth = Depth::nearer_or_equal;
    bool write_depth = true;
    Cull cull = Cull::none;
    bool write_colour = true;
};
void apply(const GlState& state);

/// Name of the first error since the last call ("GL_INVALID_OPERATION"), or an empty text. For tests.
const char* gl_error();

}  // namespace elastolab
