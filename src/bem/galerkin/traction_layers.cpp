#include "bem/galerkin/traction_layers.hpp"

#include <Eigen/Cholesky>
#include <numeric>

#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "bem/galerkin/hierarchical_system.hpp"
#include "deform/conjugate_gradients.hpp"

namespace elastolab {

namespace {

constexpr int kTrianglesOfAPatch = 128;

SolveError not_positive_definite() {
    return SolveError("single-layer matrix: is not positive definite. Check the mesh for slivers.");
}

}  // namespace

/// V as an operator.
class TractionLayers::SingleLayer : public LinearOperator {
public:
    explicit SingleLayer(const TractionLayers& layers) : layers_(layers) {}
    Eigen::Index size() const override { return layers_.size_; }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override { return layers_.single_layer(X); }

private:
    const TractionLayers& layers_;
};

/// Two levels: the blocks of clusters of triangles, each solved for by itself (in single precision), and tractions that
/// are constant on each of them; rigid fields are only scaled.
class TractionLayers::PatchSolves : public LinearOperator {
public:
    explicit PatchSolves(const TractionLayers& layers, Control& control) : layers_(layers) {
        std::vector<Eigen::Triplet<double>> constants;
        for (const std::vector<int>& cluster : layers.layers_->clusters(kTrianglesOfAPatch)) {
            Patch patch;
            for (const int number : cluster)
                if (3 * number < layers.n_single_) {
                    patch.numbers.push_back(number);
                    for (int i = 0; i < 3; ++i) {
                        patch.rows.push_back(3 * number + i);
                        constants.emplace_back(3 * number + i, 3 * static_cast<int>(patches_.size()) + i, 1.0);
                    }
                }
            if (!patch.numbers.empty()) patches_.push_back(std::move(patch));
        }
        factors_.resize(patches_.size());
        {
            const SerialBlas serial;
            parallel_blocks(static_cast<int>(patches_.size()), 1, control, [&](int p, int) {
                auto& factor = factors_[static_cast<std::size_t>(p)];
                const std::vector<int>& own = patches_[static_cast<std::size_t>(p)].numbers;
                factor.compute(layers.layers_->single_layer_block(own).cast<float>());
                if (factor.info() != Eigen::Success) throw not_positive_definite();
            });
        }
        SparseColumns Z(3 * layers.layers_->n_triangles(), 3 * std::ssize(patches_));
        Z.setFromTriplets(constants.begin(), constants.end());
        coarse_factor_.compute(layers.layers_->galerkin_product(Z, control));
        if (coarse_factor_.info() != Eigen::Success) throw not_positive_definite();
        Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(size(), size() - layers.n_single_);
        unit.bottomRows(unit.cols()).setIdentity();
        if (unit.cols() == 0) return;
        const Eigen::VectorXd diagonal = layers.single_layer(unit).bottomRows(unit.cols()).diagonal();
        if (diagonal.minCoeff() <= 0.0) throw not_positive_definite();
        rigid_scale_ = diagonal.cwiseInverse();
    }
    Eigen::Index size() const override { return layers_.size_; }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        Eigen::MatrixXd Y(X.rows(), X.cols()), coarse(3 * std::ssize(patches_), X.cols());
        Control control;
        const SerialBlas serial;
        parallel_blocks(static_cast<int>(patches_.size()), 1, control, [&](int p, int) {
            const Patch& patch = patches_[static_cast<std::size_t>(p)];
            const Eigen::MatrixXd own = X(patch.rows, Eigen::all);
            coarse.middleRows<3>(3 * p) = sums_of_blocks(own);
            Eigen::MatrixXf answer = own.cast<float>();
            factors_[static_cast<std::size_t>(p)].solveInPlace(answer);
            Y(patch.rows, Eigen::all) = answer.cast<double>();
        });
        coarse_factor_.solveInPlace(coarse);
        for (std::size_t p = 0; p < patches_.size(); ++p)
            Y(patches_[p].rows, Eigen::all) +=
                coarse.middleRows<3>(3 * static_cast<Eigen::Index>(p)).replicate(std::ssize(patches_[p].numbers), 1);
        Y.bottomRows(rigid_scale_.size()) = rigid_scale_.asDiagonal() * X.bottomRows(rigid_scale_.size());
        return Y;
    }

private:
    struct Patch {
        std::vector<int> numbers;  ///< of its triangles
        std::vector<Eigen::Index> rows;
    };
    static Eigen::MatrixXd sums_of_blocks(const Eigen::MatrixXd& rows) {
        Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3, rows.cols());
        for (Eigen::Index i = 0; i < rows.rows(); i += 3) sum += rows.middleRows<3>(i);
        return sum;
    }

    const TractionLayers& layers_;
    std::vector<Patch> patches_;
    std::vector<Eigen::LLT<Eigen::MatrixXf>> factors_;
    Eigen::LLT<Eigen::MatrixXd> coarse_factor_;
    Eigen::VectorXd rigid_scale_;
};

TractionLayers::TractionLayers(const HierarchicalSystem& system, const GalerkinTractions& tractions,
                               std::int64_t most_factorised, Control& control)
    : size_(tractions.size()), n_single_(3 * std::ssize(tractions.triangles)) {
    if (size_ == 0) return;
    std::vector<int> triangles = tractions.triangles;
    for (const int s : tractions.free_surfaces) {
        const std::vector<int>& all = system.surfaces().triangles[static_cast<std::size_t>(s)];
        rigid_.push_back(rigid_tractions(system.boundary(), all));
        triangles.insert(triangles.end(), all.begin(), all.end());
    }
    layers_ = system.layers_of(triangles, control);
    if (size_ <= most_factorised) {
        factor_ = CholeskyFactorization(dense_single_layer(), "single-layer matrix", &control);
    } else {
        operator_ = std::make_unique<const SingleLayer>(*this);
        subdomain_solves_ = std::make_unique<const PatchSolves>(*this, control);
    }
}

TractionLayers::~TractionLayers() = default;

Eigen::MatrixXd TractionLayers::dense_single_layer() const {
    std::vector<int> numbers(static_cast<std::size_t>(n_single_ / 3));
    std::iota(numbers.begin(), numbers.end(), 0);
    Eigen::MatrixXd V(size_, size_);
    V.topLeftCorner(n_single_, n_single_) = layers_->single_layer_block(numbers);
    if (n_single_ == size_) return V;
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(size_, size_ - n_single_);
    unit.bottomRows(unit.cols()).setIdentity();
    V.rightCols(unit.cols()) = single_layer(unit);
    V.bottomRows(unit.cols()) = V.rightCols(unit.cols()).transpose();
    return V;
}

Eigen::MatrixXd TractionLayers::spread(const Eigen::MatrixXd& t) const {
    Eigen::MatrixXd all(3 * layers_->n_triangles(), t.cols());
    all.topRows(n_single_) = t.topRows(n_single_);
    Eigen::Index from = n_single_, to = n_single_;
    for (const Eigen::MatrixXd& fields : rigid_) {
        all.middleRows(to, fields.rows()) = fields * t.middleRows(from, fields.cols());
        to += fields.rows();
        from += fields.cols();
    }
    return all;
}

Eigen::MatrixXd TractionLayers::gather(const Eigen::MatrixXd& on_triangles) const {
    Eigen::MatrixXd t(size_, on_triangles.cols());
    t.topRows(n_single_) = on_triangles.topRows(n_single_);
    Eigen::Index from = n_single_, to = n_single_;
    for (const Eigen::MatrixXd& fields : rigid_) {
        t.middleRows(to, fields.cols()) = fields.transpose() * on_triangles.middleRows(from, fields.rows());
        from += fields.rows();
        to += fields.cols();
    }
    return t;
}

Eigen::MatrixXd TractionLayers::double_layer(const Eigen::MatrixXd& u) const {
    return gather(layers_->double_layer(u));
}

Eigen::MatrixXd TractionLayers::transposed_double_layer(const Eigen::MatrixXd& t) const {
    return layers_->transposed_double_layer(spread(t));
}

Eigen::MatrixXd TractionLayers::single_layer(const Eigen::MatrixXd& t) const {
    return gather(layers_->single_layer(spread(t)));
}

Eigen::MatrixXd TractionLayers::solve_single_layer(const Eigen::MatrixXd& b, double tolerance, Control& control) const {
    if (!operator_) {
        Eigen::MatrixXd t = b;
        factor_.solve_in_place(t);
        return t;
    }
    return conjugate_gradients(*operator_, *subdomain_solves_, b, {.tolerance = tolerance}, "single-layer matrix",
                               control);
}

std::uint64_t TractionLayers::memory_bytes() const {
    if (size_ == 0) return 0;
    return layers_->memory_bytes() + 8 * static_cast<std::uint64_t>(factor_.size() * factor_.size());
}

}  // namespace elastolab
