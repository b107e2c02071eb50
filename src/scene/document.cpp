#include "scene/document.hpp"

#include <array>
#include <utility>

namespace elastolab {

namespace {

constexpr std::array<std::pair<ProxyUse, std::string_view>, 4> kProxyUses = {{{ProxyUse::never, "never"},
                                                                              {ProxyUse::automatic, "auto"},
                                                                              {ProxyUse::always, "always"},
                                                                              {ProxyUse::fill, "fill"}}};
constexpr std::array<std::pair<OpenSurface, std::string_view>, 3> kOpenSurfaces = {
    {{OpenSurface::automatic, "auto"}, {OpenSurface::solid, "solid"}, {OpenSurface::sheet, "sheet"}}};

template <class Words, class Value>
std::string_view word_of(const Words& words, Value value) {
    for (const auto& [known, text] : words)
        if (known == value) return text;
    return {};
}

template <class Value, std::size_t n>
std::optional<Value> parsed(const std::array<std::pair<Value, std::string_view>, n>& words, std::string_view text) {
    for (const auto& [value, known] : words)
        if (known == text) return value;
    return std::nullopt;
}

}  // namespace

std::string_view name(ProxyUse use) { return word_of(kProxyUses, use); }
std::optional<ProxyUse> parse_proxy_use(std::string_view text) { return parsed(kProxyUses, text); }
std::string_view name(OpenSurface taken_for) { return word_of(kOpenSurfaces, taken_for); }
std::optional<OpenSurface> parse_open_surface(std::string_view text) { return parsed(kOpenSurfaces, text); }

std::string default_fixed_name(std::size_t place) { return place == 0 ? "fixed" : "fixed-" + std::to_string(place); }

std::string default_load_name(std::size_t place) { return "load-" + std::to_string(place); }

bool is_plain(const std::vector<FixedSet>& sets) {
    return sets.size() == 1 && (sets.front().name.empty() || sets.front().name == default_fixed_name(0));
}

bool operator==(const Document& a, const Document& b) {
    return a.mesh == b.mesh && a.material.young_modulus == b.material.young_modulus &&
           a.material.poisson_ratio == b.material.poisson_ratio && a.method == b.method && a.fixed == b.fixed &&
           a.handles == b.handles && a.gravity == b.gravity && a.density == b.density && a.loads == b.loads &&
           a.proxy == b.proxy && a.settings == b.settings;
}

}  // namespace elastolab
