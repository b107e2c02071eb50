#include <map>
#include <memory>
#include <mutex>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/quadratic/method.hpp"
#include "study/error/error_report.hpp"
#include "study/measure.hpp"
#include "study/setups.hpp"
#include "study/study.hpp"

namespace elastolab {

namespace {

/// What is compared: a method with its choices, under a name.
struct Variant {
    std::string name;
    Method method;
    std::vector<int> sizes;  ///< cells, ascending
};

Method with_tractions(Tractions tractions) { return {.kind = kLinearBem, .tractions = tractions}; }

std::vector<int> up_to(int largest, bool quick) {
    std::vector<int> sizes;
    for (const int size : {2, 3, 4, 6, 8, 10, 12, 16, 20})
        if (size <= (quick ? std::min(largest, 3) : largest)) sizes.push_back(size);
    return sizes;
}

Repeats repeats(bool quick) { return quick ? Repeats{0.02, 2} : Repeats{}; }

std::vector<Variant> main_variants(bool quick) {
    return {{"fem", {.kind = kFem}, up_to(20, quick)},
            {"constant-bem", {.kind = kConstantBem}, up_to(8, quick)},
            {"quadratic-fem", {.kind = kQuadraticFem}, up_to(10, quick)},
            {"galerkin-bem", {.kind = kGalerkinBem}, up_to(12, quick)},
            {"linear-bem", with_tractions(Tractions::discontinuous), up_to(12, quick)},
            {"linear-bem restricted", with_tractions(Tractions::restricted), up_to(12, quick)},
            {"linear-bem continuous", with_tractions(Tractions::continuous), up_to(12, quick)}};
}

/// Galerkin BEM with thin triangles along the rims, where most of the error on organic bodies comes from.
std::vector<Variant> finer_rim_variants() {
    return {{"galerkin-bem rims 1", {.kind = kGalerkinBem, .rims = 1}, {}},
            {"galerkin-bem rims 2", {.kind = kGalerkinBem, .rims = 2}, {}}};
}

/// Makes each problem once for all methods that ask for it in turn: the truth of an organic body takes far longer than
/// what is measured.
class ProblemStore {
public:
    std::shared_ptr<const Problem> get(const std::string& family, int size, double nu) {
        const std::string key = family + " " + std::to_string(size) + " " + std::to_string(nu);
        if (key != key_) problem_ = std::make_shared<const Problem>(problem_family(family).make(size, nu));
        key_ = key;
        return problem_;
    }

private:
    std::string key_;
    std::shared_ptr<const Problem> problem_;
};

class CaseList {
public:
    using Work = std::function<Row(const Problem&, Control&)>;
    explicit CaseList(bool quick) : repeats_(repeats(quick)) {}

    void add(const std::string& part, const std::string& family, const std::string& variant, double nu, int size,
             double weight, const Work& work) {
        const Row id =
            Row().set("part", part).set("problem", family).set("variant", variant).set("nu", nu).set("size", size);
        cases_.push_back({id, weight, [=, store = store_](Control& control) {
                              const std::shared_ptr<const Problem> problem = store->get(family, size, nu);
                              Row row = work(*problem, control);
                              row.set("truth", problem_family(family).truth)
                                  .set("truth_error", problem->truth_error)
                                  .set("truth_force_error", problem->truth_force_error);
                              return std::vector<Row>{row};
                          }});
    }
    void add(const std::string& part, const std::string& family, const Variant& variant, double nu, int size) {
        // Seconds on two cores; sizes are cells along an edge, or vertices, and then most of it is the truth.
        const double weight = 0.5 + (problem_family(family).organic ? 1e-5 : 2e-2) * size * size;
        add(part, family, variant.name, nu, size, weight,
            [method = variant.method, many = repeats_](const Problem& problem, Control& control) {
                return measure(problem, method, many, control).set("method", text(method.kind));
            });
    }
    std::vector<Case> take() { return std::move(cases_); }

private:
    Repeats repeats_;
    std::vector<Case> cases_;
    std::shared_ptr<ProblemStore> store_ = std::make_shared<ProblemStore>();
};

/// Refinement at a compressible and a nearly incompressible ratio.
void add_refinements(CaseList& cases, bool quick) {
    for (const ProblemFamily& family : problem_families()) {
        if (family.organic || family.reproduced || family.finite || (quick && family.name.ends_with("irregular")))
            continue;
        for (const double nu : {0.3, 0.49}) {
            if (quick && nu != 0.3) continue;
            for (const Variant& variant : main_variants(quick))
                for (const int size : variant.sizes) cases.add("refinement", family.name, variant, nu, size);
        }
    }
}

/// Fields that linear elements represent exactly, at one size.
void add_reproduced(CaseList& cases, bool quick) {
    for (const ProblemFamily& family : problem_families())
        for (const Variant& variant : main_variants(quick))
            if (family.reproduced && !family.finite) cases.add("reproduced", family.name, variant, 0.3, quick ? 2 : 6);
}

/// All Poisson's ratios at one size, on flat and on curved surfaces.
void add_ratios(CaseList& cases, bool quick) {
    const std::vector<double> ratios =
        quick ? std::vector{-0.5, 0.4999, 0.5} : std::vector{-0.5, 0.0, 0.3, 0.45, 0.49, 0.499, 0.4999, 0.5};
    std::vector<std::pair<std::string, int>> problems = {
        {"bending", 6}, {"torsion", 4}, {"hollow-sphere", 4}, {"hanging-bar", 6}, {"pressed-bar", 4}};
    if (quick) problems = {{"bending", 2}, {"pressed-bar", 2}};
    for (const auto& [problem, size] : problems)
        for (const double nu : ratios)
            for (const Variant& variant : main_variants(quick))
                if (nu < 0.5 || variant.method.kind->takes_incompressible)
                    cases.add("poisson", problem, variant, nu, size);
}

/// Tetrahedra of other sizes and qualities; integrals of other tolerances.
void add_choices(CaseList& cases, bool quick) {
    const int size = quick ? 4 : 8;
    const auto tets = [&](const std::string& name, const TetOptions& options) {
        cases.add("choices", "bending", name, 0.3, size, 0.5, [=](const Problem& problem, Control& control) {
            return measure_tetrahedra(problem, options, repeats(quick), control).set("method", text(kFem));
        });
    };
    for (const double volume : quick ? std::vector{0.5, 1.8} : std::vector{0.25, 0.5, 1.0, 1.8, 4.0, 16.0})
        tets("tet volume " + Row().set("v", volume).text("v"), {.relative_volume = volume});
    for (const double quality : quick ? std::vector{1.2, 1.4} : std::vector{1.1, 1.2, 1.4, 2.0, 3.0})
        tets("tet quality " + Row().set("q", quality).text("q"), {.radius_edge_ratio = quality});
    const std::vector<double> tolerances =
        quick ? std::vector{1e-3, 1e-10} : std::vector{1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-13};
    for (const double tolerance : tolerances)
        for (const MethodKind kind : {kLinearBem, kConstantBem, kGalerkinBem}) {
            Method method;
            method.kind = kind;
            method.integral_tolerance = tolerance;
            cases.add("choices", "bending",
                      {text(kind) + " tolerance " + Row().set("t", tolerance).text("t"), method, {}}, 0.3,
                      quick ? 2 : 6);
        }
}

/// Organic bodies pulled at a small patch, and turned there, and a bar bent by its weight. In the quick run two
/// small ones.
void add_organic(CaseList& cases, bool quick) {
    std::vector<std::pair<std::string, int>> bodies = {
        {"potato", 350}, {"potato-turned", 350}, {"rabbit", 600},  {"rabbit-turned", 600},
        {"cactus", 850}, {"cactus-turned", 850}, {"cantilever", 4}};
    if (quick) bodies = {{"potato", 150}, {"cantilever", 2}};
    for (const auto& [body, size] : bodies)
        for (const double nu : {0.0, 0.3, 0.45, 0.49}) {
            if (quick && nu != 0.3) continue;
            for (const Variant& variant : main_variants(quick)) cases.add("organic", body, variant, nu, size);
            for (const Variant& variant : finer_rim_variants()) cases.add("organic", body, variant, nu, size);
        }
}

/// Large deformations, by the method that is not linear: refinement, and what linear elements represent exactly.
void add_finite(CaseList& cases, bool quick) {
    const std::vector<Variant> variants = {
        {"nonlinear-fem", nonlinear_method(ElementDegree::quadratic), up_to(8, quick)},
        {"nonlinear-fem of four nodes", nonlinear_method(ElementDegree::linear), up_to(12, quick)}};
    for (const ProblemFamily& family : problem_families()) {
        if (!family.finite) continue;
        for (const double nu : {0.3, 0.49}) {
            if (quick && nu != 0.3) continue;
            for (const Variant& variant : variants)
                for (const int size : family.reproduced ? std::vector{3} : variant.sizes)
                    cases.add("finite", family.name, variant, nu, size);
        }
    }
}

}  // namespace

Study make_error_study(const StudyOptions& options) {
    Study study;
    study.name = "error";
    study.title = "Run time against error";
    study.columns = {
        "part",        "problem",           "method",       "variant",        "nu",      "size",        "vertices",
        "unknowns",    "constrained",       "precompute_s", "set_change_s",   "ready_s", "once_s",      "frame_s",
        "error",       "error_max",         "condition",    "residual",       "truth",   "truth_error", "warnings",
        "error_force", "truth_force_error", "estimate",     "estimate_force", "check_s"};
    CaseList cases(options.quick);
    add_refinements(cases, options.quick);
    add_reproduced(cases, options.quick);
    add_ratios(cases, options.quick);
    add_choices(cases, options.quick);
    add_organic(cases, options.quick);
    add_finite(cases, options.quick);
    study.cases = cases.take();
    study.conclude = [](const Table& table, Control&) { return conclude_error(table); };
    return study;
}

}  // namespace elastolab
