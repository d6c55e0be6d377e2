#include "engine/solve/constraint_solver.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace anvil {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using WideMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double relative_cutoff = 1e-10;
constexpr int refinements = 2;
constexpr double tolerated_miss = 1e-6;
constexpr double wild_amplification = 1000;

void check_sizes(std::span<const double> weights, std::span<const double> targets, size_t components) {
    const size_t handles = components > 0 ? targets.size() / components : 0;
    if (components == 0 || handles * components != targets.size() || handles * handles != weights.size()) {
        throw InputError("the constraint system has " + std::to_string(weights.size()) + " weights and " +
                         std::to_string(targets.size()) + " target numbers of " + std::to_string(components) +
                         " components, which do not fit; give k x k and k x components");
    }
    const auto finite = [](double x) { return std::isfinite(x); };
    if (!std::all_of(weights.begin(), weights.end(), finite) ||
        !std::all_of(targets.begin(), targets.end(), finite)) {
        throw InputError(
            "a weight or target of the constraint system is not finite; check the handles' targets");
    }
}

// Binary exponent of the largest entry. Scaling by powers of two is exact and keeps squares in range.
int exponent_of(std::span<const double> values) {
    double largest = 0;
    for (const double x : values) {
        largest = std::max(largest, std::abs(x));
    }
    return largest > 0 ? std::ilogb(largest) : 0;
}

Matrix scaled(std::span<const double> values, size_t columns, int exponent) {
    Matrix result(columns > 0 ? values.size() / columns : 0, columns);
    std::transform(values.begin(), values.end(), result.data(),
                   [exponent](double x) { return std::ldexp(x, -exponent); });
    return result;
}

double norm(const double* v, size_t count) {
    double largest = 0;
    for (size_t c = 0; c < count; ++c) {
        largest = std::max(largest, std::abs(v[c]));
    }
    if (!(largest > 0) || !std::isfinite(largest)) {
        return largest;
    }
    double sum = 0;
    for (size_t c = 0; c < count; ++c) {
        sum += (v[c] / largest) * (v[c] / largest);
    }
    return largest * std::sqrt(sum);
}

double largest_target(std::span<const double> targets, size_t components) {
    double largest = 0;
    for (size_t i = 0; i + components <= targets.size(); i += components) {
        largest = std::max(largest, norm(targets.data() + i, components));
    }
    return largest;
}

// D - A X with products and sums wider than double: the refinement needs a residual with correct digits.
Matrix residual(const Matrix& a, const Matrix& x, const Matrix& d) {
    return (d.cast<long double>() - a.cast<long double>() * x.cast<long double>()).eval().cast<double>();
}

class PseudoInverse {
  public:
    explicit PseudoInverse(const Matrix& a)
        : svd_(a, Eigen::ComputeFullU | Eigen::ComputeFullV), values_(svd_.singularValues()) {
        while (rank_ < values_.size() && values_[rank_] > relative_cutoff * values_[0]) {
            ++rank_;
        }
    }

    Eigen::Index rank() const { return rank_; }
    double condition() const {
        return rank_ == values_.size() ? values_[0] / values_[rank_ - 1]
                                       : std::numeric_limits<double>::infinity();
    }
    Matrix operator*(const Matrix& d) const {
        const Matrix y = values_.head(rank_).cwiseInverse().asDiagonal() *
                         (svd_.matrixU().leftCols(rank_).transpose() * d);
        return svd_.matrixV().leftCols(rank_) * y;
    }

  private:
    Eigen::JacobiSVD<Matrix> svd_;
    Eigen::VectorXd values_;
    Eigen::Index rank_ = 0;
};

// Errors and amplification, from scaled matrices whose targets carry `exponent`.
void measure(const Matrix& a, const Matrix& x, const Matrix& d, double largest, Solution& solution) {
    const Matrix miss = residual(a, x, d);
    const size_t k = solution.handles;
    const size_t c = solution.components;
    for (size_t i = 0; i < k; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        solution.target_error[i] = norm(miss.data() + i * c, c);
        double total = 0;
        for (size_t j = 0; j < k; ++j) {
            total += std::abs(a(row, static_cast<Eigen::Index>(j))) * norm(x.data() + j * c, c);
        }
        solution.reach[i] = a.row(row).cwiseAbs().sum();
        solution.amplifications[i] = largest > 0 ? total / largest : 0;
        solution.amplification = std::max(solution.amplification, solution.amplifications[i]);
    }
}

std::string miss_message(const Solution& solution, size_t i, double largest, const std::string& name) {
    std::string message = name + " misses its target by " + rounded_text(solution.target_error[i]) +
                          " (the largest target is " + rounded_text(largest) + ")";
    if (solution.reach[i] == 0) {
        return message + ": no weight reaches it; raise the radius, or use a shape that is not 0 there";
    }
    if (solution.rank < solution.handles) {
        message += ": the handles' weights depend on each other (rank " + std::to_string(solution.rank) +
                   " of " + std::to_string(solution.handles) + ")";
    }
    return message + "; move handles apart, give coincident ones the same target, change radius or shape, or "
                     "allow it by \"least_squares\": true";
}

} // namespace

Solution solve_constraints(std::span<const double> weights, std::span<const double> targets,
                           size_t components) {
    check_sizes(weights, targets, components);
    Solution solution;
    solution.components = components;
    solution.handles = targets.size() / components;
    const size_t k = solution.handles;
    if (k == 0) {
        return solution;
    }
    const int weight_exponent = exponent_of(weights);
    const int target_exponent = exponent_of(targets);
    const Matrix a = scaled(weights, k, weight_exponent);
    const Matrix d = scaled(targets, components, target_exponent);
    const PseudoInverse inverse(a);
    Matrix x = inverse * d;
    for (int i = 0; i < refinements; ++i) {
        x += inverse * residual(a, x, d);
    }
    solution.rank = static_cast<size_t>(inverse.rank());
    solution.condition = inverse.condition();
    solution.target_error.resize(k);
    solution.reach.resize(k);
    solution.amplifications.resize(k);
    measure(a, x, d, largest_target({d.data(), targets.size()}, components), solution);
    solution.x.resize(targets.size());
    std::transform(x.data(), x.data() + x.size(), solution.x.begin(),
                   [&](double v) { return std::ldexp(v, target_exponent - weight_exponent); });
    for (size_t i = 0; i < k; ++i) {
        solution.target_error[i] = std::ldexp(solution.target_error[i], target_exponent);
        solution.reach[i] = std::ldexp(solution.reach[i], weight_exponent);
    }
    return solution;
}

void check_targets(const Solution& solution, std::span<const double> targets, bool least_squares,
                   std::span<const std::string> names, Log& log) {
    const double largest = largest_target(targets, solution.components);
    const auto worst = std::max_element(solution.target_error.begin(), solution.target_error.end());
    if (!least_squares && worst != solution.target_error.end() && *worst > tolerated_miss * largest) {
        const auto i = static_cast<size_t>(worst - solution.target_error.begin());
        throw InputError(miss_message(solution, i, largest, names[i]));
    }
    if (solution.amplification <= wild_amplification) {
        return;
    }
    std::string list;
    for (size_t i = 0; i < solution.handles; ++i) {
        if (solution.amplifications[i] > wild_amplification) {
            list += (list.empty() ? "" : ", ") + names[i];
        }
    }
    log.warn("partial displacements are " + rounded_text(solution.amplification) +
             " times larger than the targets at " + list +
             ": the surface between will be wild; move these handles apart or change radius or shape");
}

} // namespace anvil
