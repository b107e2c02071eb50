#include "render/gl/shader.hpp"

#include <gmock/gmock.h>

#include "base/error.hpp"
#include "render/gl/embedded_shaders.hpp"
#include "render/gl/framebuffer.hpp"
#include "render/gl/gl_window.hpp"

namespace elastolab {
namespace {

using testing::HasSubstr;

TEST(Shader, IsPartOfTheProgramWithWhatItIncludes) {
    EXPECT_THAT(shader_text("surface.frag"), HasSubstr("vec3 lit("));
    EXPECT_THAT(shader_text("surface.frag"), Not(HasSubstr("#include")));
    EXPECT_THROW(shader_text("missing.frag"), Error);
}

TEST(Shader, NamesTheFilesThatDoNotFit) {
    const test::GlWindow window;
    try {
        ShaderProgram({"line.vert", "surface.geom", "line.frag"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("line.vert, surface.geom, line.frag"));
    }
}

TEST(Shader, IsSharedWhileItIsUsed) {
    const test::GlWindow window;
    const auto a = shared_shader({"line.vert", "line.geom", "line.frag"});
    EXPECT_EQ(a, shared_shader({"line.vert", "line.geom", "line.frag"}));
    EXPECT_NE(a, shared_shader({"point.vert", "point.frag"}));
}

TEST(Framebuffer, KeepsItsSizeAndClearsAfterResize) {
    const test::GlWindow window;
    Framebuffer picture(30, 20);
    picture.resize(17, 11);
    picture.bind();
    EXPECT_EQ(picture.read().width, 17);
    EXPECT_EQ(picture.read().pixels.size(), 3u * 17u * 11u);
    EXPECT_STREQ(gl_error(), "");
}

}  // namespace
}  // namespace elastolab
