#include "deform/load_share.hpp"

namespace elastolab {

std::vector<LoadShare> nodal_shares(const Positions& positions, const std::vector<int>& vertices) {
    std::vector<LoadShare> shares;
    for (int i = 0; i < std::ssize(vertices); ++i)
        shares.push_back({i, i, 1.0, positions.col(vertices[static_cast<std::size_t>(i)])});
    return shares;
}

}  // namespace elastolab
