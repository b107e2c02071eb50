#include "study/stability/trial_edits.hpp"

#include <algorithm>
#include <random>

#include "base/blas.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "study/error/problems.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

/// Two ways to the same displacements differ by rounding times the condition of their systems.
constexpr double kAllowed = 1e-8;

/// The constrained set that the edits change, and its values.
class EditedSet {
public:
    EditedSet(int n_vertices, unsigned seed) : n_vertices_(n_vertices), random_(seed) {}

    /// Constrains a free vertex or frees a constrained one, moves one between fixed set and handles, or draws new
    /// values.
    void edit() {
        const unsigned what = random_() % 8;
        const int v = static_cast<int>(random_() % static_cast<unsigned>(n_vertices_));
        if (what < 4) {
            if (!remove(set_.fixed, v) && !remove(set_.handles, v) && size() < 0.4 * n_vertices_)
                (what < 1 ? set_.fixed : set_.handles).push_back(v);
        } else if (what < 5 && !set_.handles.empty()) {
            const int moved = set_.handles[random_() % set_.handles.size()];
            remove(set_.handles, moved);
            set_.fixed.push_back(moved);
        }
        values_.resize(3 * std::ssize(set_.handles));
        for (double& value : values_) value = 2.0 * random_() / static_cast<double>(std::mt19937::max()) - 1.0;
    }
    int size() const { return static_cast<int>(set_.fixed.size() + set_.handles.size()); }
    const ConstrainedSet& set() const { return set_; }
    const Eigen::VectorXd& values() const { return values_; }

private:
    static bool remove(std::vector<int>& from, int v) {
        const auto found = std::find(from.begin(), from.end(), v);
        if (found == from.end()) return false;
        from.erase(found);
        return true;
    }

    int n_vertices_;
    std::mt19937 random_;
    ConstrainedSet set_;
    Eigen::VectorXd values_;
};

/// Restores the thread count at the end.
class RestoredThreads {
public:
    RestoredThreads() = default;
    RestoredThreads(const RestoredThreads&) = delete;
    RestoredThreads& operator=(const RestoredThreads&) = delete;
    ~RestoredThreads() { set_thread_count(before_); }

private:
    const int before_ = thread_count();
};

Eigen::VectorXd solved_afresh(const Body& body, Method method, const EditedSet& edited, Control& control) {
    method.update = Update::direct;
    Deformer deformer(precompute(body, method, control));
    deformer.constrain(edited.set(), control);
    return deformer.displace(edited.values());
}

}  // namespace

Row random_edits(const Method& method, int n_edits, int n_checks, unsigned seed, Control& control) {
    const Body body = study_body(make_box(2, {2, 1, 1}), Material{1.0, 0.3});
    EditedSet edited(body.surface->n_vertices(), seed);
    Deformer deformer(precompute(body, method, control));
    const int every = std::max(1, n_edits / n_checks);
    double worst = 0.0, condition = 0.0;
    int checks = 0, largest = 0;
    for (int i = 1; i <= n_edits; ++i) {
        edited.edit();
        deformer.constrain(edited.set(), control);
        const Eigen::VectorXd u = deformer.displace(edited.values());
        largest = std::max(largest, edited.size());
        if (i % every != 0 || !deformer.quality().held || edited.set().handles.empty()) continue;
        const Eigen::VectorXd afresh = solved_afresh(body, method, edited, control);
        worst = std::max(worst, relative_error(u, afresh));
        condition = std::max(condition, deformer.quality().condition_estimate);
        ++checks;
    }
    return Row()
        .set("vertices", body.surface->n_vertices())
        .set("constrained", largest)
        .set("edits", n_edits)
        .set("checks", checks)
        .set("error", worst)
        .set("allowed", kAllowed)
        .set("condition", condition)
        .set("outcome", std::string(checks == 0         ? "failed"
                                    : worst <= kAllowed ? "right"
                                                        : "silent"));
}

Row thread_counts(const Method& method, int most, Control& control) {
    const Problem problem = problem_family("bending").make(4, 0.3);
    const RestoredThreads restored;
    Eigen::VectorXd alone;
    double worst = 0.0, error = 0.0;
    for (const int n : {1, 2, most}) {
        set_thread_count(n);
        Deformer deformer(precompute(problem.body, method, control));
        deformer.constrain({{}, problem.constrained}, control);
        const Eigen::VectorXd u = deformer.displace(problem.values());
        if (n == 1) alone = u;
        worst = std::max(worst, relative_error(u, alone));
        error = problem.error(u);
    }
    return Row()
        .set("vertices", problem.body.surface->n_vertices())
        .set("constrained", std::ssize(problem.constrained))
        .set("error", worst)
        .set("allowed", kAllowed)
        .set("message", "error against the truth with any of them: " + Row().set("e", error).text("e"))
        .set("outcome", std::string(worst <= kAllowed ? "right" : "silent"));
}

}  // namespace elastolab
