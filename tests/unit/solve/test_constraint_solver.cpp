#include "engine/core/error.h"
#include "engine/solve/constraint_solver.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

using namespace anvil;
using Catch::Matchers::Contains;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

using Numbers = std::vector<double>;

double length(const Numbers& v, size_t row, size_t c) {
    double sum = 0;
    for (size_t i = 0; i < c; ++i) {
        sum += v[row * c + i] * v[row * c + i];
    }
    return std::sqrt(sum);
}

// |A X - D| of row i, in long double.
double miss(const Numbers& a, const Numbers& x, const Numbers& d, size_t k, size_t c, size_t i) {
    long double sum = 0;
    for (size_t m = 0; m < c; ++m) {
        long double r = -static_cast<long double>(d[i * c + m]);
        for (size_t j = 0; j < k; ++j) {
            r += static_cast<long double>(a[i * k + j]) * x[j * c + m];
        }
        sum += r * r;
    }
    return static_cast<double>(std::sqrt(sum));
}

double landing_bound(const Numbers& a, const Numbers& x, size_t k, size_t c, size_t i) {
    double sum = 0;
    for (size_t j = 0; j < k; ++j) {
        sum += std::abs(a[i * k + j]) * length(x, j, c);
    }
    return 8 * eps * sum;
}

// Gaussian elimination with pivoting, in long double: a truth of its own.
Numbers eliminated(const Numbers& a, const Numbers& d, size_t k, size_t c) {
    std::vector<std::vector<long double>> rows(k);
    for (size_t i = 0; i < k; ++i) {
        rows[i].assign(a.begin() + i * k, a.begin() + (i + 1) * k);
        rows[i].insert(rows[i].end(), d.begin() + i * c, d.begin() + (i + 1) * c);
    }
    for (size_t p = 0; p < k; ++p) {
        size_t best = p;
        for (size_t i = p; i < k; ++i) {
            best = std::abs(rows[i][p]) > std::abs(rows[best][p]) ? i : best;
        }
        std::swap(rows[p], rows[best]);
        for (size_t i = 0; i < k; ++i) {
            const long double factor = i == p ? 0 : rows[i][p] / rows[p][p];
            for (size_t m = p; m < k + c; ++m) {
                rows[i][m] -= factor * rows[p][m];
            }
        }
    }
    Numbers x;
    for (size_t i = 0; i < k; ++i) {
        for (size_t m = 0; m < c; ++m) {
            x.push_back(static_cast<double>(rows[i][k + m] / rows[i][i]));
        }
    }
    return x;
}

std::vector<std::string> names(size_t k) {
    std::vector<std::string> result;
    for (size_t i = 0; i < k; ++i) {
        result.push_back("handle " + std::to_string(i));
    }
    return result;
}

} // namespace

TEST_CASE("one handle moves by its target over its weight") {
    const Solution s = solve_constraints(Numbers{0.5}, Numbers{1, -2, 3}, 3);
    CHECK(s.x == Numbers{2, -4, 6});
    CHECK(s.rank == 1);
    CHECK(s.condition == 1);
    CHECK(s.target_error == Numbers{0});
    CHECK(s.amplification == Approx(1).epsilon(4 * eps));
}

TEST_CASE("a system of two solved by hand") {
    // [1 1/2; 1/4 1] X = [1; 1]: determinant 7/8, X = [4/7, 6/7].
    const Solution s = solve_constraints(Numbers{1, 0.5, 0.25, 1}, Numbers{1, 1}, 1);
    CHECK(std::abs(s.x[0] - 4.0 / 7) <= eps);
    CHECK(std::abs(s.x[1] - 6.0 / 7) <= eps);
    CHECK(s.rank == 2);
    // A^T A = [17/16 3/4; 3/4 5/4]: trace 37/16, determinant 49/64; s^2 = (37 +- sqrt(585)) / 32.
    CHECK(s.condition == Approx(std::sqrt((37 + std::sqrt(585.0)) / (37 - std::sqrt(585.0)))).epsilon(1e-14));
    CHECK(s.amplification == Approx(1).epsilon(1e-14));
}

TEST_CASE("handles land within eight roundings of the terms of their sum") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> number(-1, 1);
    for (const size_t k : {size_t{1}, size_t{2}, size_t{4}, size_t{16}, size_t{33}}) {
        for (const size_t c : {size_t{1}, size_t{3}}) {
            for (int round = 0; round < 20; ++round) {
                Numbers a(k * k);
                Numbers d(k * c);
                std::generate(a.begin(), a.end(), [&] { return number(random); });
                std::generate(d.begin(), d.end(), [&] { return number(random); });
                // Rows and targets of very different size.
                for (size_t j = 0; j < k; ++j) {
                    a[j] *= round % 3 == 1 ? 1e-6 : 1;
                }
                const Solution s = solve_constraints(a, d, c);
                REQUIRE(s.rank == k);
                const Numbers truth = eliminated(a, d, k, c);
                for (size_t i = 0; i < k; ++i) {
                    CHECK(miss(a, s.x, d, k, c, i) <= landing_bound(a, s.x, k, c, i));
                    CHECK(s.target_error[i] <= landing_bound(a, s.x, k, c, i));
                    for (size_t m = 0; m < c; ++m) {
                        // Both solve to rounding; what remains is the system's own condition.
                        CHECK(std::abs(s.x[i * c + m] - truth[i * c + m]) <=
                              1e-14 * s.condition * (1 + length(truth, i, c)));
                    }
                }
            }
        }
    }
}

TEST_CASE("nearly equal handles land as well, at a condition of 1e9") {
    const double close = 1 - 2e-9;
    const Numbers a{1, close, close, 1};
    const Numbers d{1, 0, 0, 0, 1, 0};
    const Solution s = solve_constraints(a, d, 3);
    CHECK(s.rank == 2);
    CHECK(s.condition == Approx(1e9).epsilon(1e-6));
    for (size_t i = 0; i < 2; ++i) {
        CHECK(miss(a, s.x, d, 2, 3, i) <= landing_bound(a, s.x, 2, 3, i));
    }
    // Each |X_j| is about sqrt(2) / (1 - close^2), two of them, over targets of 1.
    CHECK(s.amplification == Approx(2 * std::sqrt(2.0) / 4e-9).epsilon(1e-3));
}

TEST_CASE("coincident handles with one target share it evenly, as the least norm asks") {
    const Solution s = solve_constraints(Numbers{1, 1, 1, 1}, Numbers{2, 4, 6, 2, 4, 6}, 3);
    CHECK(s.rank == 1);
    CHECK(std::isinf(s.condition));
    for (size_t i = 0; i < 2; ++i) {
        for (size_t m = 0; m < 3; ++m) {
            CHECK(s.x[3 * i + m] == Approx(1.0 * (m + 1)).epsilon(4 * eps));
        }
        CHECK(s.target_error[i] <= 8 * eps * 8);
    }
    Log log;
    CHECK_NOTHROW(check_targets(s, Numbers{2, 4, 6, 2, 4, 6}, false, names(2), log));
}

TEST_CASE("coincident handles with different targets meet in the middle") {
    const Numbers d{1, 0, 0, 0, 0, 0};
    const Solution s = solve_constraints(Numbers{1, 1, 1, 1}, d, 3);
    CHECK(s.rank == 1);
    CHECK(s.target_error[0] == Approx(0.5).epsilon(1e-14));
    CHECK(s.target_error[1] == Approx(0.5).epsilon(1e-14));
    Log log;
    CHECK_THROWS_AS(check_targets(s, d, false, names(2), log), InputError);
    CHECK_THROWS_WITH(check_targets(s, d, false, names(2), log), Contains("handle 0") && Contains("0.5") &&
                                                                     Contains("least_squares") &&
                                                                     Contains("rank 1 of 2"));
    CHECK_NOTHROW(check_targets(s, d, true, names(2), log));
}

TEST_CASE("missed targets satisfy the normal equations") {
    // Rank 2 of 3: the third row is the sum of the others.
    const Numbers a{1, 0.25, 0.5, 0.5, 1, 0.25, 1.5, 1.25, 0.75};
    const Numbers d{1, 2, 0, -1, 0, 1, 5, 5, 5};
    const Solution s = solve_constraints(a, d, 3);
    CHECK(s.rank == 2);
    for (size_t j = 0; j < 3; ++j) {
        for (size_t m = 0; m < 3; ++m) {
            long double gradient = 0;
            for (size_t i = 0; i < 3; ++i) {
                long double r = -d[3 * i + m];
                for (size_t l = 0; l < 3; ++l) {
                    r += static_cast<long double>(a[3 * i + l]) * s.x[3 * l + m];
                }
                gradient += a[3 * i + j] * r;
            }
            // Terms of at most 10, singular values within a factor of 10.
            CHECK(std::abs(static_cast<double>(gradient)) <= 1000 * eps);
        }
    }
}

TEST_CASE("weights and targets scaled by powers of two scale the result bit for bit") {
    const Numbers a{1, 0.3, 0.1, 0.2, 0.9, 0.4, 0.05, 0.6, 1};
    const Numbers d{1, 2, 3, -1, 0.5, 0, 0.1, 0.7, -2};
    const Solution s = solve_constraints(a, d, 3);
    for (const int weight : {-300, -7, 0, 100}) {
        for (const int target : {-500, -3, 400}) {
            Numbers scaled_a = a;
            Numbers scaled_d = d;
            for (double& v : scaled_a) {
                v = std::ldexp(v, weight);
            }
            for (double& v : scaled_d) {
                v = std::ldexp(v, target);
            }
            const Solution t = solve_constraints(scaled_a, scaled_d, 3);
            CHECK(t.rank == s.rank);
            CHECK(t.condition == s.condition);
            CHECK(t.amplification == s.amplification);
            for (size_t i = 0; i < s.x.size(); ++i) {
                CHECK(t.x[i] == std::ldexp(s.x[i], target - weight));
            }
        }
    }
}

TEST_CASE("no handles and zero targets are ordinary") {
    const Solution none = solve_constraints(Numbers{}, Numbers{}, 3);
    CHECK(none.handles == 0);
    CHECK(none.rank == 0);
    CHECK(none.amplification == 0);
    Log log;
    CHECK_NOTHROW(check_targets(none, Numbers{}, false, {}, log));
    const Numbers zero(6, 0.0);
    const Solution still = solve_constraints(Numbers{1, 0.5, 0.5, 1}, zero, 3);
    CHECK(still.x == zero);
    CHECK(still.rank == 2);
    CHECK(still.amplification == 0);
    CHECK_NOTHROW(check_targets(still, zero, false, names(2), log));
    CHECK(log.warnings.empty());
}

TEST_CASE("a handle that no weight reaches is told so") {
    const Numbers d{1, 0, 0, 0, 1, 0};
    const Solution s = solve_constraints(Numbers{1, 0, 0, 0}, d, 3);
    CHECK(s.rank == 1);
    CHECK(s.reach[1] == 0);
    CHECK(s.target_error[1] == 1);
    Log log;
    CHECK_THROWS_WITH(check_targets(s, d, false, names(2), log),
                      Contains("handle 1") && Contains("no weight reaches it") && Contains("radius"));
    const Solution nothing = solve_constraints(Numbers{0, 0, 0, 0}, d, 3);
    CHECK(nothing.rank == 0);
    CHECK(nothing.x == Numbers(6, 0.0));
    CHECK(std::isinf(nothing.condition));
    CHECK_THROWS_WITH(check_targets(nothing, d, false, names(2), log), Contains("no weight reaches it"));
}

TEST_CASE("singular values below 1e-10 of the largest are dropped") {
    CHECK(solve_constraints(Numbers{1, 0, 0, 2e-10}, Numbers{1, 0}, 1).rank == 2);
    const Solution s = solve_constraints(Numbers{1, 0, 0, 0.5e-10}, Numbers{1, 0}, 1);
    CHECK(s.rank == 1);
    CHECK(std::isinf(s.condition));
    CHECK(s.x[0] == 1);
}

TEST_CASE("a large amplification warns and names the handles") {
    const double close = 1 - 1e-4;
    const Numbers d{1, 0, 0, 0, 0, 0, 0, 0, 1};
    const Solution s = solve_constraints(Numbers{1, close, 0, close, 1, 0, 0, 0, 1}, d, 3);
    CHECK(s.amplification > 1000);
    Log log;
    check_targets(s, d, false, names(3), log);
    REQUIRE(log.warnings.size() == 1);
    CHECK_THAT(log.warnings[0], Contains("handle 0, handle 1") && !Contains("handle 2") && Contains("wild"));
}

TEST_CASE("sizes that disagree and numbers that are not finite are refused") {
    CHECK_THROWS_AS(solve_constraints(Numbers{1, 2, 3}, Numbers{1, 2, 3}, 3), InputError);
    CHECK_THROWS_AS(solve_constraints(Numbers{1}, Numbers{1, 2}, 3), InputError);
    CHECK_THROWS_AS(solve_constraints(Numbers{1}, Numbers{1}, 0), InputError);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(solve_constraints(Numbers{nan}, Numbers{1}, 1), Contains("not finite"));
    CHECK_THROWS_WITH(solve_constraints(Numbers{1}, Numbers{INFINITY}, 1), Contains("not finite"));
}
