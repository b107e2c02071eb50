#include "bem/hierarchical/kept_answers.hpp"

#include "base/lapack.hpp"

namespace elastolab {

namespace {

/// Columns that are kept, and what a combination of them may miss.
constexpr Eigen::Index kMostKept = 16;
constexpr double kCombined = 1e-12;

/// The columns of two matrices side by side; the first may be empty.
Eigen::MatrixXd beside(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
    if (left.cols() == 0) return right;
    Eigen::MatrixXd both(left.rows(), left.cols() + right.cols());
    both << left, right;
    return both;
}

}  // namespace

Eigen::MatrixXd KeptAnswers::get(const Eigen::MatrixXd& questions, Eigen::Index n_rows,
                                 const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& compute) {
    Eigen::MatrixXd answers(n_rows, questions.cols());
    const std::vector<Eigen::Index> others = combine(questions, answers);
    if (others.empty()) return answers;
    const Eigen::MatrixXd new_questions = questions(Eigen::all, others), computed = compute(new_questions);
    answers(Eigen::all, others) = computed;
    keep(new_questions, computed);
    return answers;
}

std::vector<Eigen::Index> KeptAnswers::combine(const Eigen::MatrixXd& questions, Eigen::MatrixXd& answers) {
    const std::scoped_lock lock(mutex_);
    std::vector<Eigen::Index> others;
    Eigen::MatrixXd shares(questions_.cols(), questions.cols()), missed = -questions;
    if (shares.rows() > 0) {
        shares = solve_minimum_norm(questions_, questions, kCombined).X;
        missed.noalias() += questions_ * shares;
    }
    for (Eigen::Index c = 0; c < questions.cols(); ++c)
        if (!(missed.col(c).stableNorm() <= kCombined * questions.col(c).stableNorm()))  // nor if it is not finite
            others.push_back(c);
        else if (shares.rows() > 0)
            answers.col(c) = answers_ * shares.col(c);
        else
            answers.col(c).setZero();
    return others;
}

void KeptAnswers::keep(const Eigen::MatrixXd& questions, const Eigen::MatrixXd& answers) {
    if (!questions.allFinite() || !answers.allFinite()) return;
    const std::scoped_lock lock(mutex_);
    if (questions_.cols() + answers.cols() <= kMostKept) {
        questions_ = beside(questions_, questions);
        answers_ = beside(answers_, answers);
    } else if (answers.cols() <= kMostKept) {
        questions_ = questions;
        answers_ = answers;
    }
}

}  // namespace elastolab
