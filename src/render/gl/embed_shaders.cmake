# Writes OUTPUT, the source of embedded_shaders(), from SHADERS (paths joined by commas). Run with cmake -P.
string(REPLACE "," ";" shaders "${SHADERS}")
set(entries "")
foreach(shader IN LISTS shaders)
  get_filename_component(name ${shader} NAME)
  file(READ ${shader} text)
  string(APPEND entries "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"render/gl/embedded_shaders.hpp\"

namespace elastolab {

namespace {
constexpr EmbeddedShader kShaders[] = {
${entries}};
}  // namespace

std::span<const EmbeddedShader> embedded_shaders() { return kShaders; }

}  // namespace elastolab
")
