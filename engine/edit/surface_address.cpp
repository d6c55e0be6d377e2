#include "engine/edit/surface_address.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace anvil {

namespace {

template <class Number>
bool take(std::string_view& text, Number& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) {
        return false;
    }
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    return true;
}

bool take(std::string_view& text, char expected) {
    if (text.empty() || text.front() != expected) {
        return false;
    }
    text.remove_prefix(1);
    return true;
}

bool take_three(std::string_view text, double (&v)[3]) {
    return take(text, v[0]) && take(text, ',') && take(text, v[1]) && take(text, ',') && take(text, v[2]) &&
           text.empty() && is_finite({v[0], v[1], v[2]});
}

std::optional<SurfaceAddress> parse_vertex(std::string_view text) {
    VertexAddress address;
    if (take(text, address.vertex) && text.empty() && address.vertex != no_index) {
        return address;
    }
    return std::nullopt;
}

std::optional<SurfaceAddress> parse_face(std::string_view text) {
    FaceAddress address;
    double weights[3];
    if (!take(text, address.face) || (take(text, '.') && !take(text, address.triangle)) || !take(text, ':') ||
        !take_three(text, weights) || address.face == no_index) {
        return std::nullopt;
    }
    address.barycentric = checked_barycentric({weights[0], weights[1], weights[2]});
    return address;
}

std::optional<SurfaceAddress> parse_form(std::string_view text) {
    if (text.starts_with("v:")) {
        return parse_vertex(text.substr(2));
    }
    if (text.starts_with("f:")) {
        return parse_face(text.substr(2));
    }
    double p[3];
    if (take_three(text, p)) {
        return NearestAddress{{p[0], p[1], p[2]}};
    }
    return std::nullopt;
}

template <class Triple>
std::string listed(const Triple& v) {
    return rounded_text(v[0]) + "," + rounded_text(v[1]) + "," + rounded_text(v[2]);
}

} // namespace

SurfaceAddress parse_address(const std::string& text) {
    try {
        if (const auto address = parse_form(text)) {
            return *address;
        }
    } catch (const InputError& error) {
        throw InputError("point \"" + text + "\": " + error.what());
    }
    throw InputError("point \"" + text +
                     "\" is none of v:INDEX, f:FACE[.TRIANGLE]:b0,b1,b2 and x,y,z (no blanks between)");
}

std::string describe(const SurfaceAddress& address) {
    if (const auto* vertex = std::get_if<VertexAddress>(&address)) {
        return "vertex " + std::to_string(vertex->vertex);
    }
    if (const auto* face = std::get_if<FaceAddress>(&address)) {
        return "face " + std::to_string(face->face) + " triangle " + std::to_string(face->triangle) + " at " +
               listed(face->barycentric);
    }
    return "the surface point nearest to " + listed(std::get<NearestAddress>(address).point);
}

std::array<double, 3> checked_barycentric(const std::array<double, 3>& weights) {
    const double sum = weights[0] + weights[1] + weights[2];
    // Written so that NaN fails too.
    const bool good = std::all_of(weights.begin(), weights.end(), [](double w) { return w >= -1e-9; }) &&
                      std::abs(sum - 1) <= 1e-6;
    if (!good) {
        throw InputError("found " + listed(weights) +
                         "; barycentrics are three numbers, none negative, that sum to 1");
    }
    std::array<double, 3> result{std::max(weights[0], 0.0), std::max(weights[1], 0.0),
                                 std::max(weights[2], 0.0)};
    const double total = result[0] + result[1] + result[2];
    // A sum within rounding of 1 is left alone, so that a written recipe reads back bit for bit.
    if (std::abs(total - 1) > 1e-15) {
        for (double& w : result) {
            w /= total;
        }
    }
    return result;
}

} // namespace anvil
