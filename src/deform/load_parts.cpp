#include "deform/load_parts.hpp"

namespace elastolab {

UnitLoad on_triangles(const UnitLoad& load, const std::vector<int>& numbers) {
    UnitLoad part{.body_force = load.body_force};
    part.follows = load.follows;
    std::vector<int> columns;
    for (std::size_t k = 0; k < load.triangles.size(); ++k)
        if (const int t = numbers[static_cast<std::size_t>(load.triangles[k])]; t >= 0) {
            part.triangles.push_back(t);
            columns.push_back(static_cast<int>(k));
        }
    part.tractions = load.tractions(Eigen::all, columns);
    return part;
}

}  // namespace elastolab
