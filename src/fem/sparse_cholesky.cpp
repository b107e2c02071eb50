#include "fem/sparse_cholesky.hpp"

#include <cholmod.h>

#include <cassert>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/spare.hpp"
#include "fem/inverse_norm.hpp"
#include "fem/supernodal.hpp"

namespace elastolab {

namespace {

/// Columns that are solved for on one thread.
constexpr Eigen::Index kFewColumns = 4;

/// CHOLMOD's settings and workspace. One per call, because it is not safe to share between threads; starting one is
/// cheap. It never prints.
class Common {
public:
    Common() {
        cholmod_start(&common_);
        common_.print = 0;
        common_.error_handler = nullptr;
        common_.supernodal = CHOLMOD_SUPERNODAL;
        common_.final_ll = 1;
    }
    ~Common() { cholmod_finish(&common_); }
    Common(const Common&) = delete;
    Common& operator=(const Common&) = delete;

    cholmod_common* operator->() { return &common_; }
    operator cholmod_common*() { return &common_; }

    /// Turns CHOLMOD's status into our exceptions.
    void check(const std::string& name) const {
        if (common_.status == CHOLMOD_OUT_OF_MEMORY)
            throw SolveError(name + ": not enough memory for its sparse factor. Use a coarser mesh.");
        if (common_.status == CHOLMOD_TOO_LARGE)
            throw SolveError(name + ": its sparse factor exceeds 2^31 entries. Use a coarser mesh.");
        if (common_.status < 0)
            throw SolveError(name + ": sparse factorisation failed (CHOLMOD status " + std::to_string(common_.status) +
                             ").");
    }

private:
    cholmod_common common_{};
};

void free_factor(cholmod_factor* factor) {
    if (factor == nullptr) return;
    Common common;
    cholmod_free_factor(&factor, common);
}

}  // namespace

struct CholmodFactorDeleter {
    void operator()(cholmod_factor* factor) const { free_factor(factor); }
};
using FactorPtr = std::unique_ptr<cholmod_factor, CholmodFactorDeleter>;

namespace {

/// CHOLMOD's view of the lower triangle of a matrix; nothing is copied or written. It takes no null pointers, which
/// arrays of a matrix without entries are: a body all of whose nodes are prescribed.
cholmod_sparse sparse_view(const SparseMatrix& A) {
    static int no_row = 0;
    static double no_value = 0.0;
    assert(A.isCompressed() && A.rows() == A.cols());
    cholmod_sparse view{};
    view.nrow = view.ncol = static_cast<std::size_t>(A.rows());
    view.nzmax = static_cast<std::size_t>(A.nonZeros());
    view.p = const_cast<int*>(A.outerIndexPtr());
    view.i = A.nonZeros() == 0 ? &no_row : const_cast<int*>(A.innerIndexPtr());
    view.x = A.nonZeros() == 0 ? &no_value : const_cast<double*>(A.valuePtr());
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    return view;
}

cholmod_dense dense_view(const Eigen::Ref<const Eigen::MatrixXd>& B) {
    cholmod_dense view{};
    view.nrow = static_cast<std::size_t>(B.rows());
    view.ncol = static_cast<std::size_t>(B.cols());
    view.d = static_cast<std::size_t>(B.outerStride());
    view.nzmax = view.d * view.ncol;
    view.x = const_cast<double*>(B.data());
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    return view;
}

/// The pattern of the groups of `block` rows and columns, as their first rows and columns show it.
SparseMatrix group_pattern(const SparseMatrix& A, int block) {
    SparseMatrix groups(A.rows() / block, A.cols() / block);
    groups.reserve(A.nonZeros() / (block * block) + groups.cols());
    for (int column = 0; column < groups.cols(); ++column) {
        groups.startVec(column);
        for (SparseMatrix::InnerIterator it(A, block * column); it; ++it)
            if (it.row() % block == 0) groups.insertBack(static_cast<int>(it.row()) / block, column) = 1.0;
    }
    groups.finalize();
    return groups;
}

/// Fill-reducing order of the groups, the better of AMD and METIS, spread over their members.
std::vector<int> ordering(const SparseMatrix& pattern, int block) {
    const SparseMatrix groups = group_pattern(pattern, block);
    Common common;
    common->supernodal = CHOLMOD_SIMPLICIAL;
    common->nmethods = 2;
    common->method[0].ordering = CHOLMOD_AMD;
    common->method[1].ordering = CHOLMOD_METIS;
    cholmod_sparse view = sparse_view(groups);
    const FactorPtr factor(cholmod_analyze(&view, common));
    common.check("stiffness matrix");
    std::vector<int> order;
    order.reserve(static_cast<std::size_t>(pattern.rows()) + 1);  // never null, see above
    for (Eigen::Index g = 0; g < groups.rows(); ++g)
        for (int i = 0; i < block; ++i) order.push_back(block * static_cast<int*>(factor->Perm)[g] + i);
    return order;
}

SupernodalView view_of(const cholmod_factor& factor) {
    const auto ints = [](const void* data, std::size_t n) { return std::span(static_cast<const int*>(data), n); };
    SupernodalView view;
    view.permutation = ints(factor.Perm, factor.n);
    view.super = ints(factor.super, factor.nsuper + 1);
    view.first_row = ints(factor.pi, factor.nsuper + 1);
    view.first_value = ints(factor.px, factor.nsuper + 1);
    view.rows = ints(factor.s, factor.ssize);
    return view;
}

}  // namespace

struct CholeskyAnalysis::Impl {
    FactorPtr factor;
    std::shared_ptr<Spare<FactorPtr>> spare;  ///< null: memory is not kept
};

CholeskyAnalysis::CholeskyAnalysis(const SparseMatrix& pattern, int block, bool keeps) {
    assert(pattern.rows() % block == 0);
    std::vector<int> order = ordering(pattern, block);
    Common common;
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
    cholmod_sparse view = sparse_view(pattern);
    FactorPtr factor(cholmod_analyze_p(&view, order.data(), nullptr, 0, common));
    common.check("stiffness matrix");
    impl_ =
        std::make_unique<const Impl>(Impl{std::move(factor), keeps ? std::make_shared<Spare<FactorPtr>>() : nullptr});
}

CholeskyAnalysis::~CholeskyAnalysis() = default;

int CholeskyAnalysis::size() const { return static_cast<int>(impl_->factor->n); }

std::uint64_t CholeskyAnalysis::factor_bytes() const {
    const cholmod_factor& factor = *impl_->factor;
    return 8 * factor.xsize + 4 * (factor.ssize + 3 * factor.nsuper + 2 * factor.n);
}

SupernodalView CholeskyAnalysis::view() const { return view_of(*impl_->factor); }

struct SparseCholesky::Impl {
    Impl(FactorPtr its_factor, std::shared_ptr<Spare<FactorPtr>> its_spare)
        : factor(std::move(its_factor)), spare(std::move(its_spare)) {}
    ~Impl() {
        if (spare) spare->give(std::move(factor));
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    FactorPtr factor;
    std::shared_ptr<Spare<FactorPtr>> spare;
    std::uint64_t bytes = 0;
    double norm = 0.0;
    std::string name;
};

namespace {

/// A supernodal factor with room for its values.
FactorPtr with_values(const cholmod_factor& analysis, const std::string& name) {
    Common common;
    FactorPtr factor(cholmod_copy_factor(const_cast<cholmod_factor*>(&analysis), common));
    common.check(name);
    cholmod_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor.get(), common);
    common.check(name);
    return factor;
}

}  // namespace

SparseCholesky::SparseCholesky(const CholeskyAnalysis& analysis, const SparseMatrix& A, std::string name,
                               Control* control) {
    assert(A.rows() == analysis.size());
    const Eigen::VectorXd sums = A.cwiseAbs().transpose() * Eigen::VectorXd::Ones(A.rows());
    if (!sums.allFinite())  // the largest of them says nothing: a maximum may pass over NaN
        throw SolveError(name + ": has entries that are not finite. Check the mesh for degenerate tetrahedra.");
    const double norm = sums.size() == 0 ? 0.0 : sums.maxCoeff();
    const std::shared_ptr<Spare<FactorPtr>>& spare = analysis.impl_->spare;
    FactorPtr factor = spare ? spare->take() : nullptr;
    if (!factor) factor = with_values(*analysis.impl_->factor, name);
    auto impl = std::make_unique<Impl>(std::move(factor), spare);  // which takes care of the memory, if this fails
    cholmod_factor& L = *impl->factor;
    Control unwatched;
    factorise_supernodes(view_of(L), A, static_cast<double*>(L.x), name, control ? *control : unwatched);
    L.minor = L.n;
    impl->bytes = analysis.factor_bytes();
    impl->norm = norm;
    impl->name = std::move(name);
    impl_ = std::move(impl);
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

int SparseCholesky::size() const { return static_cast<int>(impl_->factor->n); }

std::uint64_t SparseCholesky::memory_bytes() const { return impl_->bytes; }

Eigen::MatrixXd SparseCholesky::solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
    assert(B.rows() == size());
    if (B.size() == 0) return B;
    // A few columns give each supernode too little work for several threads to share: beside busy processes they would
    // wait for each other at every one of them.
    std::optional<SerialBlas> serial;
    if (B.cols() <= kFewColumns) serial.emplace();
    Common common;
    cholmod_dense view = dense_view(B);
    cholmod_dense* solution = cholmod_solve(CHOLMOD_A, impl_->factor.get(), &view, common);
    common.check(impl_->name);
    Eigen::MatrixXd X = Eigen::Map<const Eigen::MatrixXd>(static_cast<double*>(solution->x), B.rows(), B.cols());
    cholmod_free_dense(&solution, common);
    if (!X.allFinite())
        throw SolveError(impl_->name + ": its solution is not finite. Check the mesh for degenerate tetrahedra.");
    return X;
}

double SparseCholesky::reciprocal_condition() const {
    const int n = size();
    if (n == 0) return 1.0;
    const auto solve_one = [this](const Eigen::VectorXd& x) -> Eigen::VectorXd { return solve(x); };
    return 1.0 / (impl_->norm * estimate_inverse_norm(n, solve_one));
}

SupernodalView SparseCholesky::view() const {
    SupernodalView view = view_of(*impl_->factor);
    view.values = static_cast<const double*>(impl_->factor->x);
    return view;
}

}  // namespace elastolab
