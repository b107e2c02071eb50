#include <array>
#include <charconv>

#include "base/error.hpp"
#include "study/report/report.hpp"
#include "study/stability/stability_report.hpp"
#include "study/stability/trial_edits.hpp"
#include "study/stability/trials.hpp"
#include "study/study.hpp"

namespace elastolab {

namespace {

/// As few digits as give the number back: 0.49999999 is not one half.
std::string shortest(double value) {
    std::array<char, 32> buffer{};
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

void add_sweeps(std::vector<Case>& cases, bool quick) {
    for (const TrialGroup& group : trial_groups(quick))
        for (const double level : group.levels)
            for (const TrialVariant& variant : group.finite ? finite_trial_variants() : trial_variants()) {
                const Row id =
                    Row().set("group", group.name).set("level", shortest(level)).set("variant", variant.name);
                cases.push_back({id, 1.0, [=](Control& control) {
                                     Row row = attempt(group.make(level), variant.method, control);
                                     return std::vector<Row>{row.set("parameter", group.parameter)};
                                 }});
            }
}

/// An attempt that ends in an error is a failed row: neither right nor refused with a reason.
Row or_failed(const std::function<Row()>& work, Control& control) {
    try {
        return work();
    } catch (const Error& error) {
        control.checkpoint();
        return Row().set("outcome", std::string("failed")).set("message", std::string(error.what()));
    }
}

/// 20 000 edits of each variant.
void add_edits(std::vector<Case>& cases, const StudyOptions& options) {
    const int n_edits = options.quick ? 100 : 20000, n_checks = options.quick ? 10 : 200;
    const int most = options.quick ? 3 : 8;
    for (const TrialVariant& variant : trial_variants()) {
        const Row id = Row().set("group", std::string("edits")).set("level", n_edits).set("variant", variant.name);
        cases.push_back({id, options.quick ? 2.0 : 100.0, [=](Control& control) {
                             const auto edit = [&] {
                                 return random_edits(variant.method, n_edits, n_checks, options.seed, control);
                             };
                             return std::vector<Row>{or_failed(edit, control).set("parameter", std::string("edits"))};
                         }});
        const Row threads = Row().set("group", std::string("threads")).set("level", most).set("variant", variant.name);
        cases.push_back({threads, 2.0, [=](Control& control) {
                             const auto count = [&] { return thread_counts(variant.method, most, control); };
                             return std::vector<Row>{
                                 or_failed(count, control).set("parameter", std::string("threads, up to"))};
                         }});
    }
}

}  // namespace

Study make_stability_study(const StudyOptions& options) {
    Study study;
    study.name = "stability";
    study.title = "What breaks each method, and what the program says then";
    study.columns = {"group",    "parameter", "level",   "variant",   "vertices",    "constrained",
                     "outcome",  "error",     "allowed", "error_max", "error_force", "condition",
                     "residual", "edits",     "checks",  "message"};
    add_sweeps(study.cases, options.quick);
    add_edits(study.cases, options);
    study.conclude = [](const Table& table, Control&) { return conclude_stability(table); };
    return study;
}

}  // namespace elastolab
