#include "engine/distance/anchor_blend.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/core/parallel_for.h"

#include <unordered_map>

namespace anvil {
namespace {

// A field farther than the nearest by so many widths no longer shows: exp(-20) = 2e-9.
constexpr double widths_that_show = 20;

DistanceSources all_of(std::span<const DistanceSources> anchors) {
    DistanceSources all;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    for (const DistanceSources& anchor : anchors) {
        append(all.points, anchor.points);
        append(all.polylines, anchor.polylines);
        append(all.triangles, anchor.triangles);
    }
    return all;
}

/// One row per vertex that any field reaches, one column per field.
struct FieldTable {
    std::vector<uint32_t> vertices;
    std::vector<double> distances;
};

FieldTable table_of(std::span<const DistanceField> fields) {
    FieldTable table;
    std::unordered_map<uint32_t, size_t> row_of;
    for (size_t i = 0; i < fields.size(); ++i) {
        for (size_t k = 0; k < fields[i].vertices.size(); ++k) {
            const auto [place, fresh] = row_of.try_emplace(fields[i].vertices[k], row_of.size());
            if (fresh) {
                table.distances.resize(table.distances.size() + fields.size(), infinity);
                table.vertices.push_back(fields[i].vertices[k]);
            }
            table.distances[place->second * fields.size() + i] = fields[i].distances[k];
        }
    }
    return table;
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

double blend_reach(double radius, double width, size_t anchors) {
    const double spread = anchors > 1 ? widths_that_show + std::log(static_cast<double>(anchors)) : 0;
    return radius + (width > 0 ? width * spread : 0);
}

AnchorFields fields_of_anchors(std::span<const DistanceSources> anchors, double radius, double width) {
    if (!(width >= 0) || !std::isfinite(width)) {
        throw InputError("anchors: the blend width is " + number_text(width) + "; give a length >= 0");
    }
    // The finder says what is wrong with a radius.
    if (!(radius >= 0) || width == 0 || anchors.size() < 2) {
        return {{all_of(anchors)}, radius};
    }
    return {{anchors.begin(), anchors.end()}, blend_reach(radius, width, anchors.size())};
}

DistanceField blended(std::vector<DistanceField> fields, double radius, double width) {
    if (fields.size() == 1) {
        return std::move(fields[0]);
    }
    const FieldTable table = table_of(fields);
    DistanceField blend;
    const bool exact = std::all_of(fields.begin(), fields.end(), [](const DistanceField& field) {
        return field.method == DistanceMethod::exact;
    });
    blend.method = exact ? DistanceMethod::exact : DistanceMethod::approximate;
    for (size_t row = 0; row < table.vertices.size(); ++row) {
        const double distance =
            smooth_minimum({table.distances.data() + row * fields.size(), fields.size()}, width);
        if (distance <= radius) {
            blend.vertices.push_back(table.vertices[row]);
            blend.distances.push_back(distance);
        }
    }
    return blend;
}

DistanceField anchor_distances(std::span<const DistanceSources> anchors, double radius, double width,
                               const FieldFinder& find) {
    const AnchorFields single = fields_of_anchors(anchors, radius, width);
    std::vector<DistanceField> fields(single.sources.size());
    parallel_for(fields.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            fields[i] = find(single.sources[i], single.reach);
        }
    });
    return blended(std::move(fields), radius, width);
}

} // namespace anvil
