#include "scene/document.hpp"

#include <array>
#include <utility>

namespace elastolab {

namespace {

constexpr std::array<std::pair<ProxyUse, std::string_view>, 4> kProxyUses = {{{ProxyUse::never, "never"},
                                                                              {ProxyUse::automatic, "auto"},
                                                                              {ProxyUse::always, "always"},
                                                                              {ProxyUse::fill, "fill"}}};

}  // namespace

std::string_view name(ProxyUse use) {
    for (const auto& [known, text] : kProxyUses)
        if (known == use) return text;
    return {};
}

std::optional<ProxyUse> parse_proxy_use(std::string_view text) {
    for (const auto& [use, known] : kProxyUses)
        if (known == text) return use;
    return std::nullopt;
}

std::string default_fixed_name(std::size_t place) { return place == 0 ? "fixed" : "fixed-" + std::to_string(place); }

bool is_plain(const std::vector<FixedSet>& sets) {
    return sets.size() == 1 && (sets.front().name.empty() || sets.front().name == default_fixed_name(0));
}

bool operator==(const Document& a, const Document& b) {
    return a.mesh == b.mesh && a.material.young_modulus == b.material.young_modulus &&
           a.material.poisson_ratio == b.material.poisson_ratio && a.method == b.method && a.fixed == b.fixed &&
           a.handles == b.handles && a.proxy == b.proxy && a.settings == b.settings;
}

}  // namespace elastolab
