#include "mesh/wrap/wrap_process.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <limits>
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

/// Takes the helper's words on its progress out of what it answers.
class Progress {
public:
    explicit Progress(Control& control) : control_(control) {}

    void read(const std::vector<char>& bytes) {
        for (WrapProgress word; bytes.size() >= end_ + sizeof(word); end_ += sizeof(word)) {
            std::memcpy(&word, bytes.data() + end_, sizeof(word));
            if (word.magic != kWrapProgress) return;
            control_.set_progress(std::clamp(word.fraction, 0.0, 1.0));
        }
    }
    std::size_t end() const { return end_; }  ///< where the reply begins

private:
    Control& control_;
    std::size_t end_ = 0;
};

WrapResult run_wrap(const WrapRequestHeader& request, const SurfaceMesh& surface, Control& control) {
    ChildProcess helper(helper_program("elastolab-wrap"));
    Progress progress(control);
    std::vector<char> reply =
        helper.exchange(request_bytes(request, surface), control, std::numeric_limits<std::size_t>::max(),
                        [&](const std::vector<char>& bytes) { progress.read(bytes); });
    reply.erase(reply.begin(), reply.begin() + static_cast<std::ptrdiff_t>(progress.end()));
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

WrapResult alpha_wrap(const SurfaceMesh& triangles, int n_vertices, double within, const WrapResult& known,
                      Control& control) {
    return run_wrap({.task = WrapTask::wrap,
                     .wanted_vertices = n_vertices,
                     .known_vertices = known.surface.n_vertices(),
                     .alpha = known.alpha,
                     .within = within},
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
