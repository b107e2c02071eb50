#include "mesh/wrap/wrap_process.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <vector>

#include "mesh/input/child_process.hpp"
#include "mesh/input/messages.hpp"
#include "mesh/wrap/wrap_protocol.hpp"

namespace elastolab {

namespace {

std::string request_bytes(WrapRequestHeader header, const SurfaceMesh& surface) {
    header.n_vertices = surface.n_vertices();
    header.n_triangles = surface.n_triangles();
    std::string bytes;
    append_bytes(bytes, &header, 1);
    append_bytes(bytes, surface.vertices.data(), static_cast<std::size_t>(surface.vertices.size()));
    append_bytes(bytes, surface.triangles.data(), static_cast<std::size_t>(surface.triangles.size()));
    return bytes;
}

std::size_t reply_size(const WrapReplyHeader& header) {
    return sizeof(header) + 3 * sizeof(double) * static_cast<std::size_t>(header.n_vertices) +
           3 * sizeof(int) * static_cast<std::size_t>(header.n_triangles);
}

std::string end_of_wrap(int status, const std::string& output) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) return "it was killed, most likely for lack of memory";
    if (WIFSIGNALED(status)) return "it crashed (signal " + std::to_string(WTERMSIG(status)) + ")";
    return output.empty() ? "it ended early" : output.substr(0, output.find('\n'));
}

WrapResult run_wrap(const WrapRequestHeader& request, const SurfaceMesh& surface, Control& control) {
    ChildProcess helper(helper_program("elastolab-wrap"));
    const std::vector<char> reply = helper.exchange(request_bytes(request, surface), control);
    const int status = helper.wait(control);

    WrapResult result;
    WrapReplyHeader header;
    if (reply.size() >= sizeof(header)) std::memcpy(&header, reply.data(), sizeof(header));
    if (reply.size() < sizeof(header) || header.magic != kWrapMagic || header.n_vertices < 0 ||
        header.n_triangles < 0 || reply.size() != reply_size(header)) {
        result.failure = end_of_wrap(status, helper.output());
        return result;
    }
    if (header.n_triangles == 0) {
        result.failure = "nothing is left of the surface";
        return result;
    }
    result.alpha = header.alpha;
    result.offset = header.offset;
    result.n_holes = header.n_holes;
    result.surface.vertices.resize(3, header.n_vertices);
    result.surface.triangles.resize(3, header.n_triangles);
    ReplyReader reader(reply);
    reader.read(&header, 1);
    reader.read(result.surface.vertices.data(), static_cast<std::size_t>(result.surface.vertices.size()));
    reader.read(result.surface.triangles.data(), static_cast<std::size_t>(result.surface.triangles.size()));
    return result;
}

}  // namespace

WrapResult alpha_wrap(const SurfaceMesh& triangles, double alpha, Control& control) {
    return run_wrap({.task = WrapTask::wrap, .alpha = alpha}, triangles, control);
}

/// The number of vertices grows with the wrap's area over the square of alpha, from one wrap to a finer one a little
/// slower, as was measured. The area is known only once there is a wrap, since what the triangles hide does not count.
WrapResult alpha_wrap(const SurfaceMesh& triangles, int n_vertices, double within, const WrapResult& known,
                      Control& control) {
    constexpr double kExponent = 1.85;
    const double ratio = static_cast<double>(known.surface.n_vertices()) / n_vertices;
    const double alpha = known.alpha * std::clamp(std::pow(ratio, 1.0 / kExponent), 0.1, 4.0);
    return run_wrap({.task = WrapTask::wrap, .wanted_vertices = n_vertices, .alpha = alpha, .within = within},
                    triangles, control);
}

WrapResult collapse_edges(const SurfaceMesh& surface, int n_vertices, Control& control) {
    return run_wrap({.task = WrapTask::collapse, .wanted_vertices = n_vertices}, surface, control);
}

WrapResult fill_holes(const SurfaceMesh& surface, HoleFilling how, Control& control) {
    const WrapTask task = how == HoleFilling::smooth ? WrapTask::fill_smooth : WrapTask::fill_flat;
    return run_wrap({.task = task, .wanted_vertices = surface.n_vertices()}, surface, control);
}

}  // namespace elastolab
