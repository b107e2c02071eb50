#include "scene/figure/gltf.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <Eigen/Geometry>
#include <ostream>
#include <string>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "scene/file/json_text.hpp"

namespace elastolab {

static_assert(std::endian::native == std::endian::little, "glTF is little endian");

namespace {

// Numbers of the specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/// The binary part, and the views and accessors that say what is where in it.
class Buffer {
public:
    /// One vector for each vertex; the number of its accessor.
    int add_vectors(const Eigen::Matrix3Xf& vectors) {
        const Eigen::Vector3f low = vectors.rowwise().minCoeff(), high = vectors.rowwise().maxCoeff();
        append(vectors.data(), sizeof(float) * static_cast<std::size_t>(vectors.size()), kArrayBuffer);
        return add_accessor({{"componentType", kFloat},
                             {"count", vectors.cols()},
                             {"type", "VEC3"},
                             {"min", {low.x(), low.y(), low.z()}},
                             {"max", {high.x(), high.y(), high.z()}}});
    }
    int add_corners(const Triangles& triangles) {
        append(triangles.data(), sizeof(int) * static_cast<std::size_t>(triangles.size()), kElementArrayBuffer);
        return add_accessor({{"componentType", kUnsignedInt}, {"count", triangles.size()}, {"type", "SCALAR"}});
    }
    const std::string& bytes() const { return bytes_; }
    const Json& views() const { return views_; }
    const Json& accessors() const { return accessors_; }

private:
    void append(const void* data, std::size_t size, int target) {
        views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}, {"target", target}});
        bytes_.append(static_cast<const char*>(data), size);  // a multiple of four
    }
    int add_accessor(Json accessor) {
        accessor["bufferView"] = views_.size() - 1;
        accessors_.push_back(std::move(accessor));
        return static_cast<int>(accessors_.size()) - 1;
    }

    std::string bytes_;
    Json views_ = Json::array(), accessors_ = Json::array();
};

Eigen::Matrix3Xf vectors_of(const Eigen::Ref<const Eigen::VectorXd>& values) {
    return Eigen::Map<const Eigen::Matrix3Xd>(values.data(), 3, values.size() / 3).cast<float>();
}

void put(std::ostream& out, std::uint32_t number) {
    const auto bytes = std::bit_cast<std::array<char, 4>>(number);
    out.write(bytes.data(), bytes.size());
}

void write_chunk(std::ostream& out, std::uint32_t kind, const std::string& content) {
    put(out, static_cast<std::uint32_t>(content.size()));
    put(out, kind);
    out << content;
}

std::string padded(std::string text) {
    text.append((4 - text.size() % 4) % 4, ' ');
    return text;
}

}  // namespace

void write_glb(std::ostream& out, const Figure& figure) {
    static constexpr std::array kMotions = {"shift x", "shift y", "shift z", "turn x", "turn y", "turn z"};
    Buffer buffer;
    const Positions& rest = figure.surface->vertices;
    const Eigen::Vector3d origin = single_precision_origin(rest);
    const int position = buffer.add_vectors((rest.colwise() - origin).cast<float>());
    const int corners = buffer.add_corners(figure.surface->triangles);
    Json targets = Json::array(), names = Json::array(), weights = Json::array();
    const auto add_target = [&](const Eigen::Ref<const Eigen::VectorXd>& u, const std::string& name, double weight) {
        targets.push_back({{"POSITION", buffer.add_vectors(vectors_of(u))}});
        names.push_back(name);
        weights.push_back(weight);
    };
    add_target(figure.displacement, "scene", 1.0);
    for (const FigureHandle& handle : figure.handles)
        for (std::size_t kind = 0; kind < kMotions.size(); ++kind)
            add_target(handle.displacement.col(static_cast<Eigen::Index>(kind)), handle.name + " " + kMotions[kind],
                       0.0);
    const Json primitive = {
        {"attributes", {{"POSITION", position}}}, {"indices", corners}, {"mode", 4}, {"targets", targets}};
    const auto upright =
        Eigen::Quaterniond::FromTwoVectors(figure.vertical.stableNormalized(), Eigen::Vector3d::UnitY());
    const Eigen::Vector3d place = upright * origin;
    const Json node = {{"mesh", 0},
                       {"name", figure.title},
                       {"rotation", {upright.x(), upright.y(), upright.z(), upright.w()}},
                       {"translation", {place.x(), place.y(), place.z()}}};
    const Json root = {{"asset", {{"version", "2.0"}, {"generator", std::string("elastolab ") + version()}}},
                       {"scene", 0},
                       {"scenes", Json::array({{{"nodes", {0}}}})},
                       {"nodes", Json::array({node})},
                       {"meshes", Json::array({{{"name", figure.title},
                                                {"primitives", Json::array({primitive})},
                                                {"weights", weights},
                                                {"extras", {{"targetNames", names}}}}})},
                       {"accessors", buffer.accessors()},
                       {"bufferViews", buffer.views()},
                       {"buffers", Json::array({{{"byteLength", buffer.bytes().size()}}})}};
    const std::string text = padded(root.dump(-1, ' ', true, Json::error_handler_t::replace));
    constexpr std::size_t kHeader = 12, kChunkHeader = 8;
    put(out, kMagic);
    put(out, kVersion);
    put(out, static_cast<std::uint32_t>(kHeader + 2 * kChunkHeader + text.size() + buffer.bytes().size()));
    write_chunk(out, kJsonChunk, text);
    write_chunk(out, kBinaryChunk, buffer.bytes());
}

void save_figure(const std::filesystem::path& file, const Figure& figure) {
    AtomicFile output(file);
    is_glb_file(file) ? write_glb(output.stream(), figure) : write_figure(output.stream(), figure);
    output.commit();
}

bool is_glb_file(const std::filesystem::path& file) { return lower_case(file.extension().string()) == ".glb"; }

FigureUse use_of(const std::filesystem::path& file) { return is_glb_file(file) ? FigureUse::show : FigureUse::pull; }

}  // namespace elastolab
