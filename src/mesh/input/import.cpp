#include "mesh/input/import.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/input/child_process.hpp"
#include "mesh/input/import_protocol.hpp"
#include "mesh/input/merge.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& finding) {
    throw MeshError(one_line(file.string() + ": " + finding));
}

void require_readable(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) fail(file, "there is no such file. Check the path.");
    if (fs::is_directory(status)) fail(file, "is a folder. Name a mesh file in it.");
    if (!fs::is_regular_file(status)) fail(file, "is not a regular file. Copy the mesh into one.");
    if (fs::file_size(file, error) == 0) fail(file, "is empty. Export the mesh again.");
    if (!std::ifstream(file)) fail(file, "cannot be opened. Check its permissions.");
}

/// assimp would look for the end of a PLY header forever.
void require_complete_header(const fs::path& file) {
    constexpr std::size_t kLongestHeader = std::size_t{1} << 20;
    std::string start(std::min(kLongestHeader, static_cast<std::size_t>(fs::file_size(file))), '\0');
    std::ifstream(file, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
    if ((start.starts_with("ply") || start.starts_with("PLY")) && start.find("end_header") == std::string::npos)
        fail(file, "is a PLY file whose header does not end. Is it damaged? Export it again.");
}

/// Time and memory far beyond what any sound file of this size takes.
ImportRequestHeader header_for(const fs::path& file) {
    const double size = static_cast<double>(fs::file_size(file));
    ImportRequestHeader header;
    header.path_size = static_cast<std::int32_t>(file.string().size());
    header.cpu_seconds = static_cast<std::int32_t>(std::min(10.0 + 4e-6 * size, 1e6));
    header.memory_bytes = static_cast<std::int64_t>(2e9 + 200.0 * size);
    return header;
}

std::string request_bytes(const fs::path& file) {
    const ImportRequestHeader header = header_for(file);
    std::string bytes(sizeof(header), '\0');
    std::memcpy(bytes.data(), &header, sizeof(header));
    return bytes + file.string();
}

std::string meaning_of_end(int status) {
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGXCPU || signal == SIGALRM || signal == SIGKILL)
        return "cannot be read: the reader used up its time or memory. Is it damaged? Export it again.";
    return "cannot be read: the reader crashed on it (" +
           (signal != 0 ? "signal " + std::to_string(signal) : "exit code " + std::to_string(WEXITSTATUS(status))) +
           "). Is it damaged? Export it again as OBJ, PLY or STL.";
}

/// Takes the arrays of a reply one after another.
class ReplyReader {
public:
    explicit ReplyReader(const std::vector<char>& bytes) : bytes_(bytes) {}
    /// False when the reply is not that long.
    bool take(void* to, std::size_t size) {
        if (bytes_.size() - at_ < size) return false;
        if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
        at_ += size;
        return true;
    }
    template <class Matrix>
    bool take(Matrix& matrix) {
        return take(matrix.data(), sizeof(*matrix.data()) * static_cast<std::size_t>(matrix.size()));
    }

private:
    const std::vector<char>& bytes_;
    std::size_t at_ = 0;
};

struct Imported {
    SurfaceMesh mesh;
    Positions order;  ///< places in the order of their first appearance in the file, where `mesh` has another order
};

Imported import(const fs::path& file) {
    Control control;  // nobody cancels: the helper has a time limit
    ChildProcess helper(helper_program("elastolab-import"));
    const std::vector<char> bytes = helper.exchange(request_bytes(file), control);
    const int status = helper.wait(control);

    ReplyReader reply(bytes);
    ImportReplyHeader header;
    if (!reply.take(&header, sizeof(header)) || header.magic != kImportMagic) fail(file, meaning_of_end(status));
    Imported result{{Positions(3, header.n_vertices), Triangles(3, header.n_triangles)}, Positions(3, header.n_order)};
    std::string problem(static_cast<std::size_t>(header.text_size), '\0');
    const bool complete = reply.take(result.mesh.vertices) && reply.take(result.order) &&
                          reply.take(result.mesh.triangles) && reply.take(problem);
    if (!complete) fail(file, meaning_of_end(status));
    if (!problem.empty()) fail(file, problem);
    return result;
}

}  // namespace

SurfaceMesh load_surface(const fs::path& file) {
    require_readable(file);
    require_complete_header(file);
    const Imported imported = import(file);
    return merged(imported.mesh, imported.order);
}

}  // namespace elastolab
