#include "base/text.hpp"
#include "mesh/checks/defects.hpp"

namespace elastolab {

namespace {

constexpr std::size_t kMostPlaces = 8;

}  // namespace

std::string counted(int count, const std::string& one, const std::string& many,
                    const std::vector<Eigen::Vector3d>& places) {
    std::string text = std::to_string(count) + " " + (count == 1 ? one : many);
    if (!places.empty() && places.front().allFinite()) text += " near " + readable_point(places.front());
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
    defect.found = counted(defect.count, one, many, defect.places);
    defect.text = defect.found + rest;
    return defect;
}

void DefectCount::report_fatal(MeshReport& report, Defect::Kind kind, const std::string& one, const std::string& many,
                               const std::string& rest) const {
    if (defect_.count == 0) return;
    report.defects.push_back(build(kind, one, many, rest));
    report.defects.back().fatal = true;
}

}  // namespace elastolab
