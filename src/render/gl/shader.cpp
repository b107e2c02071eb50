#include "render/gl/shader.hpp"

#include <epoxy/gl.h>

#include <functional>
#include <sstream>
#include <vector>

#include "base/error.hpp"
#include "render/gl/embedded_shaders.hpp"

namespace elastolab {

namespace {

std::string_view embedded(std::string_view file) {
    for (const EmbeddedShader& shader : embedded_shaders())
        if (shader.file == file) return shader.text;
    throw Error("shader " + std::string(file) + " is not part of this program. Build it again.");
}

GLenum stage_of(std::string_view file) {
    if (file.ends_with(".vert")) return GL_VERTEX_SHADER;
    if (file.ends_with(".geom")) return GL_GEOMETRY_SHADER;
    return GL_FRAGMENT_SHADER;
}

using GetParameter = void (*)(GLuint, GLenum, GLint*);
using GetLog = void (*)(GLuint, GLsizei, GLsizei*, GLchar*);

std::string log_of(unsigned id, GetParameter get_parameter, GetLog get_log) {
    GLint length = 0;
    get_parameter(id, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    get_log(id, length, nullptr, log.data());
    return log.substr(0, log.find('\0'));
}

GlShader compiled(std::string_view file) {
    const std::string text = shader_text(file);
    const char* const source = text.c_str();
    GlShader shader(glCreateShader(stage_of(file)));
    glShaderSource(shader.id(), 1, &source, nullptr);
    glCompileShader(shader.id());
    GLint ok = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    const std::string log = log_of(shader.id(), glGetShaderiv, glGetShaderInfoLog);
    throw Error("shader " + std::string(file) + " does not compile: " + log + " Update the graphics driver.");
}

}  // namespace

std::string shader_text(std::string_view file) {
    constexpr std::string_view kInclude = "#include \"";
    std::istringstream lines{std::string(embedded(file))};
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kInclude))
            text += shader_text(line.substr(kInclude.size(), line.rfind('"') - kInclude.size()));
        else
            text += line + "\n";
    }
    return text;
}

ShaderProgram::ShaderProgram(std::initializer_list<std::string_view> files) : program_(glCreateProgram()) {
    std::vector<GlShader> shaders;
    std::string names;
    for (const std::string_view file : files) {
        shaders.push_back(compiled(file));
        glAttachShader(program_.id(), shaders.back().id());
        names += (names.empty() ? "" : ", ") + std::string(file);
    }
    glLinkProgram(program_.id());
    for (const GlShader& shader : shaders) glDetachShader(program_.id(), shader.id());
    GLint ok = GL_FALSE;
    glGetProgramiv(program_.id(), GL_LINK_STATUS, &ok);
    if (ok == GL_TRUE) return;
    const std::string log = log_of(program_.id(), glGetProgramiv, glGetProgramInfoLog);
    throw Error("shaders " + names + " do not link: " + log + " Update the graphics driver.");
}

std::shared_ptr<ShaderProgram> shared_shader(std::initializer_list<std::string_view> files) {
    static std::map<std::string, std::weak_ptr<ShaderProgram>> programs;
    std::string names;
    for (const std::string_view file : files) names += std::string(file) + " ";
    std::shared_ptr<ShaderProgram> program = programs[names].lock();
    if (!program) programs[names] = program = std::make_shared<ShaderProgram>(files);
    return program;
}

void ShaderProgram::use() const { glUseProgram(program_.id()); }

int ShaderProgram::location(const char* uniform) {
    const auto found = locations_.find(uniform);
    if (found != locations_.end()) return found->second;
    return locations_[uniform] = glGetUniformLocation(program_.id(), uniform);
}

void ShaderProgram::set(const char* uniform, int value) { glUniform1i(location(uniform), value); }
void ShaderProgram::set(const char* uniform, float value) { glUniform1f(location(uniform), value); }
void ShaderProgram::set(const char* uniform, const Eigen::Vector2f& value) {
    glUniform2fv(location(uniform), 1, value.data());
}
void ShaderProgram::set(const char* uniform, const Eigen::Vector2i& value) {
    glUniform2iv(location(uniform), 1, value.data());
}
void ShaderProgram::set(const char* uniform, const Eigen::Vector3f& value) {
    glUniform3fv(location(uniform), 1, value.data());
}
void ShaderProgram::set(const char* uniform, const Colour& value) {
    glUniform4f(location(uniform), value.r, value.g, value.b, value.a);
}
void ShaderProgram::set(const char* uniform, const Eigen::Matrix4f& value) {
    glUniformMatrix4fv(location(uniform), 1, GL_FALSE, value.data());
}

}  // namespace elastolab
