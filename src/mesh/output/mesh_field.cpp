#include "mesh/output/mesh_field.hpp"

#include <array>

namespace elastolab {

std::string component_name(const MeshField& field, int component) {
    constexpr std::array<const char*, 3> kVector = {"_x", "_y", "_z"};
    constexpr std::array<const char*, 6> kTensor = {"_xx", "_yy", "_zz", "_xy", "_yz", "_xz"};
    const auto i = static_cast<std::size_t>(component);
    switch (field.values.rows()) {
        case 1:
            return field.name;
        case 3:
            return field.name + kVector[i];
        case 6:
            return field.name + kTensor[i];
        default:
            return field.name + "_" + std::to_string(component);
    }
}

}  // namespace elastolab
