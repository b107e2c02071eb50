#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "render/colour.hpp"
#include "render/gl/gl_object.hpp"

namespace elastolab {

/// The text of a file of shaders/, as it was when the program was built, with its #include "..." lines replaced by the
/// files they name. Throws Error when there is no such file.
std::string shader_text(std::string_view file);

/// A linked program of shaders. set() needs it in use, and does nothing for a uniform that the shaders do not use.
class ShaderProgram {
public:
    /// From files of shaders/ ("surface.vert", ".geom", ".frag"). Throws Error with the file and the log when one does
    /// not compile or they do not link.
    explicit ShaderProgram(std::initializer_list<std::string_view> files);

    void use() const;
    void set(const char* uniform, int value);
    void set(const char* uniform, float value);
    void set(const char* uniform, const Eigen::Vector2f& value);
    void set(const char* uniform, const Eigen::Vector2i& value);
    void set(const char* uniform, const Eigen::Vector3f& value);
    void set(const char* uniform, const Colour& value);
    void set(const char* uniform, const Eigen::Matrix4f& value);

private:
    int location(const char* uniform);

    GlProgram program_;
    std::map<std::string, int, std::less<>> locations_;
};

/// The program of these files, one for all who use it at the same time; gone with the last of them.
std::shared_ptr<ShaderProgram> shared_shader(std::initializer_list<std::string_view> files);

}  // namespace elastolab
