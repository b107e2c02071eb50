#include "bem/galerkin/close_pairs_kept.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace elastolab {

namespace {

/// Positions whose triangles may be close to a box of triangles with at most this radius.
class Search {
public:
    Search(const PairIntegrals& integrals, const ClusterTree& tree) : integrals_(integrals), tree_(tree) {
        for (const ClusterTree::Cluster& cluster : tree.clusters()) {
            double largest = 0.0;
            for (int position = cluster.range.begin; position < cluster.range.end; ++position)
                largest = std::max(largest, integrals.radius(tree.order()[static_cast<std::size_t>(position)]));
            radii_.push_back(largest);
        }
    }

    void add(const Eigen::AlignedBox3d& box, double radius, int from, int cluster, std::vector<int>& found) const {
        const ClusterTree::Cluster& c = tree_.cluster(cluster);
        const double reach = integrals_.close_distance() * (radius + radii_[static_cast<std::size_t>(cluster)]);
        if (c.range.end <= from || box.exteriorDistance(c.box) >= reach) return;
        if (!c.is_leaf()) {
            for (int i = 0; i < 2; ++i) add(box, radius, from, c.first_child + i, found);
            return;
        }
        for (int position = std::max(from, c.range.begin); position < c.range.end; ++position)
            found.push_back(position);
    }

private:
    const PairIntegrals& integrals_;
    const ClusterTree& tree_;
    std::vector<double> radii_;
};

}  // namespace

KeptClosePairs::KeptClosePairs(const PairIntegrals& integrals, std::span<const TriangleGeometry> triangles,
                               const ClusterTree& tree, Control& control)
    : positions_(tree.positions()), pairs_(triangles.size()) {
    const Search search(integrals, tree);
    const int n = tree.size(), lanes = integrals.lanes();
    parallel_blocks((n + lanes - 1) / lanes, 4, control, [&](int begin, int end) {
        for (int number = begin; number < end; ++number) {
            const int first = number * lanes, last = std::min(n, first + lanes);
            const auto tests = std::span(tree.order())
                                   .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first));
            Eigen::AlignedBox3d box;
            double radius = 0.0;
            for (const int t : tests) {
                for (const auto& corner : triangles[static_cast<std::size_t>(t)].corner)
                    box.extend(Eigen::Vector3d(corner));
                radius = std::max(radius, integrals.radius(t));
            }
            std::vector<int> candidates;
            search.add(box, radius, first, 0, candidates);
            const PairIntegrals::Pack pack = integrals.pack(tests);
            for (const int position : candidates) {
                const int field = tree.order()[static_cast<std::size_t>(position)];
                const auto is_wanted = [&](int test) {
                    return test <= position && integrals.is_close(tree.order()[static_cast<std::size_t>(test)], field);
                };
                bool any = false;
                for (int test = first; test < last; ++test) any = any || is_wanted(test);
                if (!any) continue;
                double numbers[kPairNumbers * kMaxLanes];
                integrals.integrate(pack, field, false, numbers);
                for (int test = first; test < last; ++test) {
                    if (!is_wanted(test)) continue;
                    Pair pair{position, {}};
                    for (int k = 0; k < kPairTensorNumbers; ++k)
                        pair.numbers[static_cast<std::size_t>(k)] = numbers[k * lanes + test - first];
                    pairs_[static_cast<std::size_t>(test)].push_back(pair);
                }
            }
        }
    });
}

const KeptClosePairs::Numbers& KeptClosePairs::of(int t, int s) const {
    const int a = positions_[static_cast<std::size_t>(t)], b = positions_[static_cast<std::size_t>(s)];
    const std::vector<Pair>& pairs = pairs_[static_cast<std::size_t>(std::min(a, b))];
    const auto found = std::lower_bound(pairs.begin(), pairs.end(), std::max(a, b),
                                        [](const Pair& pair, int position) { return pair.later < position; });
    return found->numbers;
}

}  // namespace elastolab
