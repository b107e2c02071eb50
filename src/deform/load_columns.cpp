#include "deform/load_columns.hpp"

#include <map>
#include <memory>
#include <vector>

namespace elastolab {

Columns load_columns(ColumnCache& cache, std::span<const UnitLoad> loads, Eigen::Index n_rows,
                     const std::function<Eigen::MatrixXd(std::span<const UnitLoad>)>& compute, const Control& control) {
    if (loads.empty()) return {};
    std::vector<ColumnKey> keys;
    std::map<ColumnKey, const UnitLoad*> load_of;
    for (const UnitLoad& load : loads) {
        keys.push_back(load_key(load));
        load_of[keys.back()] = &load;
    }
    const auto compute_missing = [&](const std::vector<ColumnKey>& missing) {
        std::vector<UnitLoad> wanted;
        for (const ColumnKey& key : missing) wanted.push_back(*load_of.at(key));
        const Eigen::MatrixXd columns = compute(wanted);
        std::vector<Columns::Block> blocks;
        for (Eigen::Index i = 0; i < columns.cols(); ++i)
            blocks.push_back(std::make_shared<const Eigen::MatrixXd>(columns.col(i)));
        return blocks;
    };
    return cache.get(
        keys, [&](const ColumnKey&) { return 8 * static_cast<std::uint64_t>(n_rows); }, compute_missing, control);
}

}  // namespace elastolab
