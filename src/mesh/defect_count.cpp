#include <array>
#include <cstdio>

#include "mesh/defects.hpp"

namespace elastolab {

namespace {

constexpr std::size_t kMostPlaces = 8;

std::string text_of(const Eigen::Vector3d& p) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "(%.4g, %.4g, %.4g)", p.x(), p.y(), p.z());
    return text.data();
}

}  // namespace

std::string counted(int count, const std::string& one, const std::string& many,
                    const std::vector<Eigen::Vector3d>& places) {
    std::string text = std::to_string(count) + " " + (count == 1 ? one : many);
    if (!places.empty() && places.front().allFinite()) text += " near " + text_of(places.front());
    return text;
}

void DefectCount::add(const Eigen::Vector3d& place) {
    ++defect_.count;
    if (defect_.places.size() < kMostPlaces) defect_.places.push_back(place);
}

Defect DefectCount::build(Defect::Kind kind, const std::string& one, const std::string& many,
                          const std::string& rest) const {
    Defect defect = defect_;
    defect.kind = kind;
    defect.text = counted(defect.count, one, many, defect.places) + rest;
    return defect;
}

void DefectCount::report_fatal(MeshReport& report, Defect::Kind kind, const std::string& one, const std::string& many,
                               const std::string& rest) const {
    if (defect_.count == 0) return;
    report.defects.push_back(build(kind, one, many, rest));
    report.defects.back().fatal = true;
}

}  // namespace elastolab
