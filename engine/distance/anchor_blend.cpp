#include "engine/distance/anchor_blend.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/core/parallel_for.h"

#include <unordered_map>

namespace anvil {
namespace {

// A field farther than the nearest by so many widths no longer shows: exp(-20) = 2e-9.
constexpr double widths_that_show = 20;

std::vector<DistanceField> single_fields(const GeodesicSolver& solver, std::span<const SurfacePoint> anchors,
                                         double radius, DistanceMethod method) {
    std::vector<DistanceField> fields(anchors.size());
    parallel_for(anchors.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            fields[i] = solver.solve(anchors.subspan(i, 1), radius, method);
        }
    });
    return fields;
}

bool same_place(const SurfacePoint& a, const SurfacePoint& b) {
    return a.triangle == b.triangle &&
           (a.triangle == no_index ? a.vertex == b.vertex : a.barycentric == b.barycentric);
}

std::vector<SurfacePoint> distinct(std::span<const SurfacePoint> anchors) {
    std::vector<SurfacePoint> kept;
    for (const SurfacePoint& anchor : anchors) {
        if (std::none_of(kept.begin(), kept.end(),
                         [&](const SurfacePoint& k) { return same_place(k, anchor); })) {
            kept.push_back(anchor);
        }
    }
    return kept;
}

} // namespace

double smooth_minimum(std::span<const double> distances, double width) {
    const double least = *std::min_element(distances.begin(), distances.end());
    const double spread = std::log(static_cast<double>(distances.size()));
    if (!(width > 0) || !(least > 0) || !std::isfinite(least) || !(spread > 0)) {
        return least;
    }
    double fourth = 0;
    for (const double d : distances) {
        const double ratio = least / d;
        fourth += ratio * ratio * ratio * ratio;
    }
    const double h = least / std::sqrt(std::sqrt(fourth));
    const double own_width = width * (h / (h + width * spread));
    double sum = 0;
    for (const double d : distances) {
        sum += std::exp((least - d) / own_width);
    }
    return std::max(0.0, least - own_width * std::log(sum));
}

DistanceField anchor_distances(const GeodesicSolver& solver, std::span<const SurfacePoint> anchors,
                               double radius, double width, DistanceMethod method) {
    if (!(width >= 0) || !std::isfinite(width)) {
        throw InputError("anchors: the blend width is " + number_text(width) + "; give a length >= 0");
    }
    const std::vector<SurfacePoint> places = distinct(anchors);
    // The solver says what is wrong with a radius.
    if (!(radius >= 0) || width == 0 || places.size() < 2) {
        return solver.solve(anchors, radius, method);
    }
    const double reach = radius + width * (widths_that_show + std::log(static_cast<double>(places.size())));
    const std::vector<DistanceField> fields = single_fields(solver, places, reach, method);
    DistanceField blended;
    blended.method = DistanceMethod::exact;
    std::unordered_map<uint32_t, size_t> row_of;
    std::vector<double> rows;
    for (size_t i = 0; i < fields.size(); ++i) {
        if (fields[i].method == DistanceMethod::approximate) {
            blended.method = DistanceMethod::approximate;
        }
        for (size_t k = 0; k < fields[i].vertices.size(); ++k) {
            const auto [place, fresh] = row_of.try_emplace(fields[i].vertices[k], row_of.size());
            if (fresh) {
                rows.resize(rows.size() + fields.size(), infinity);
                blended.vertices.push_back(fields[i].vertices[k]);
            }
            rows[place->second * fields.size() + i] = fields[i].distances[k];
        }
    }
    size_t kept = 0;
    for (size_t row = 0; row < row_of.size(); ++row) {
        const double distance = smooth_minimum({rows.data() + row * fields.size(), fields.size()}, width);
        if (distance <= radius) {
            blended.vertices[kept++] = blended.vertices[row];
            blended.distances.push_back(distance);
        }
    }
    blended.vertices.resize(kept);
    return blended;
}

} // namespace anvil
