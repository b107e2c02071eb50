#include "mesh/tets/tetgen_process.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cassert>
#include <csignal>
#include <cstring>
#include <string_view>
#include <vector>

#include "mesh/input/child_process.hpp"
#include "mesh/input/messages.hpp"
#include "mesh/tets/tetgen_protocol.hpp"

namespace elastolab {

namespace {

/// Seconds of the processor that TetGen may take: some at least, and as many per vertex.
constexpr double kLeastSeconds = 3.0, kSecondsPerVertex = 0.01;

std::string request_bytes(const SurfaceMesh& surface, const Positions& holes, const TetgenSettings& settings) {
    TetgenRequestHeader header;
    assert(settings.switches.size() < header.switches.size());
    std::copy(settings.switches.begin(), settings.switches.end(), header.switches.begin());
    header.relative_volume = settings.relative_volume;
    header.growth = settings.growth;
    header.seeded = settings.seeded ? 1 : 0;
    header.cpu_seconds = static_cast<std::int32_t>(kLeastSeconds + kSecondsPerVertex * surface.n_vertices());
    header.n_vertices = surface.n_vertices();
    header.n_triangles = surface.n_triangles();
    header.n_holes = static_cast<std::int32_t>(holes.cols());
    std::string bytes;
    append_bytes(bytes, &header, 1);
    append_bytes(bytes, surface.vertices.data(), static_cast<std::size_t>(surface.vertices.size()));
    append_bytes(bytes, surface.triangles.data(), static_cast<std::size_t>(surface.triangles.size()));
    append_bytes(bytes, holes.data(), static_cast<std::size_t>(holes.size()));
    return bytes;
}

/// The last line of TetGen's output that looks like a reason.
std::string reason_in(const std::string& output) {
    std::string reason;
    for (std::size_t begin = 0; begin < output.size();) {
        const std::size_t end = std::min(output.find('\n', begin), output.size());
        const std::string line = output.substr(begin, end - begin);
        const auto says = [&](const char* word) { return line.find(word) != std::string::npos; };
        if (says("Error") || says("intersect") || says("duplicate") || says("error")) reason = line;
        begin = end + 1;
    }
    std::replace_if(
        reason.begin(), reason.end(), [](char c) { return c < ' '; }, ' ');
    const std::size_t text = reason.find_first_not_of(' ');
    return text == std::string::npos ? "" : " (TetGen: " + reason.substr(text, 160) + ")";
}

std::string meaning_of_status(int status) {
    switch (status) {
        case 1:
            return "TetGen ran out of memory";
        case 3:
            return "the surface intersects itself";
        case 4:
            return "parts of the surface are too close together for TetGen's tolerance";
        case 5:
            return "two facets of the surface almost coincide";
        case 10:
            return "TetGen rejects the surface";
        default:
            return "TetGen gave up with internal error " + std::to_string(status);
    }
}

bool ran_out_of_time(int status) { return WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU; }

std::string end_of_tetgen(int status) {
    if (ran_out_of_time(status))
        return "TetGen comes to no end, as it does where a surface is twisted or folds through itself";
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) return "TetGen was killed, most likely for lack of memory";
    if (WIFSIGNALED(status)) return "TetGen crashed on it (signal " + std::to_string(WTERMSIG(status)) + ")";
    return "TetGen ended early (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
}

std::size_t expected_size(const TetgenReplyHeader& header) {
    return sizeof(header) + 3 * sizeof(double) * static_cast<std::size_t>(header.n_vertices) +
           4 * sizeof(int) * static_cast<std::size_t>(header.n_tetrahedra);
}

}  // namespace

TetgenResult run_tetgen(const SurfaceMesh& surface, const Positions& holes, const TetgenSettings& settings,
                        Control& control) {
    ChildProcess helper(helper_program("elastolab-tetgen"));
    const std::vector<char> reply = helper.exchange(request_bytes(surface, holes, settings), control);
    const int status = helper.wait(control);

    TetgenResult result;
    TetgenReplyHeader header;
    if (reply.size() >= sizeof(header)) std::memcpy(&header, reply.data(), sizeof(header));
    if (reply.size() < sizeof(header) || header.magic != kTetgenMagic || reply.size() != expected_size(header)) {
        result.failure = end_of_tetgen(status) + reason_in(helper.output());
        result.ran_out_of_time = ran_out_of_time(status);
        return result;
    }
    if (header.status != 0) {
        result.failure = meaning_of_status(header.status) + reason_in(helper.output());
        return result;
    }
    result.vertices.resize(3, header.n_vertices);
    result.tetrahedra.resize(4, header.n_tetrahedra);
    ReplyReader reader(reply);
    reader.read(&header, 1);
    reader.read(result.vertices.data(), static_cast<std::size_t>(result.vertices.size()));
    reader.read(result.tetrahedra.data(), static_cast<std::size_t>(result.tetrahedra.size()));
    return result;
}

}  // namespace elastolab
