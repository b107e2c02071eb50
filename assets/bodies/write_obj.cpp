#include "bodies/write_obj.hpp"

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

namespace elastolab::bodies {

namespace {

std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.5f", x);
    std::string digits = text;
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return digits;
}

}  // namespace

void write_obj(const std::filesystem::path& file, const SurfaceMesh& mesh) {
    std::ofstream out(file, std::ios::binary);
    for (const auto& p : mesh.vertices.colwise())
        out << "v " << number(p[0]) << ' ' << number(p[1]) << ' ' << number(p[2]) << '\n';
    for (const auto& t : mesh.triangles.colwise())
        out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    out.close();
    if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace elastolab::bodies
