#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace elastolab {

/// Generations of one set: each costs some small blocks more.
constexpr int kMostGenerations = 3;

/// A generation and those before it, oldest first.
template <class Generation>
std::vector<std::shared_ptr<const Generation>> chain_of(std::shared_ptr<const Generation> last) {
    std::vector<std::shared_ptr<const Generation>> chain;
    for (; last; last = last->before) chain.push_back(last);
    std::reverse(chain.begin(), chain.end());
    return chain;
}

/// Of some generations and those before them (members: before, depth, n_items(), those of all before included), the one
/// that leaves least of `n_wanted` items to compute, or null. n_known: how many of the wanted a generation has. What a
/// set does not use of it costs time in every product, so at least half must be used.
template <class Generation, class Count>
std::shared_ptr<const Generation> best_generation(const std::vector<std::shared_ptr<const Generation>>& known,
                                                  int n_wanted, const Count& n_known) {
    std::shared_ptr<const Generation> best;
    std::pair<int, int> least{n_wanted, 0};
    for (const auto& last : known)
        for (auto g = last; g; g = g->before) {
            const int used = n_known(*g);
            const std::pair<int, int> cost{n_wanted - used, g->n_items()};
            const int depth = g->depth + (cost.first > 0 ? 1 : 0);
            if (2 * used < g->n_items() || depth > kMostGenerations || !(cost < least)) continue;
            best = g;
            least = cost;
        }
    return best;
}

/// What is in use and may be built upon: objects with a last_generation(). Any thread may use it.
template <class Layers>
class LivingLayers {
public:
    /// make(last generations of what lives): a new one, as shared pointer, which is listed then.
    template <class Make>
    std::shared_ptr<const Layers> add(const Make& make) {
        using LastGeneration = decltype(std::declval<const Layers&>().last_generation());
        std::vector<std::decay_t<LastGeneration>> known;
        {
            const std::scoped_lock lock(mutex_);
            std::erase_if(living_, [](const auto& layers) { return layers.expired(); });
            for (const auto& weak : living_)
                if (const auto layers = weak.lock()) known.push_back(layers->last_generation());
        }
        std::shared_ptr<const Layers> made = make(known);
        const std::scoped_lock lock(mutex_);
        living_.push_back(made);
        return made;
    }

private:
    std::mutex mutex_;
    std::vector<std::weak_ptr<const Layers>> living_;
};

}  // namespace elastolab
