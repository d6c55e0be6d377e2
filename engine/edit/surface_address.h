// How a recipe remembers a place on the surface: by the file's own indices, or by the nearest point.
#pragma once

#include "engine/core/types.h"

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace anvil {

/// A vertex of the file, 0-based, isolated vertices counted.
struct VertexAddress {
    uint32_t vertex = 0;

    bool operator==(const VertexAddress&) const = default;
};

/// A point inside a polygon of the file: `triangle` counts the triangles of its fixed triangulation, the
/// barycentrics (each >= 0, sum 1) belong to that triangle's corners in order.
struct FaceAddress {
    uint32_t face = 0;
    uint32_t triangle = 0;
    std::array<double, 3> barycentric{};

    bool operator==(const FaceAddress&) const = default;
};

/// The surface point nearest to a point in space, on the mesh as it is when the edit begins.
struct NearestAddress {
    Vec3 point{0.0};

    bool operator==(const NearestAddress&) const = default;
};

using SurfaceAddress = std::variant<VertexAddress, FaceAddress, NearestAddress>;

/// A line along the surface through two points or more; a shortest line joins two that follow each other and
/// lie in no common triangle.
struct PolylineAddress {
    std::vector<SurfaceAddress> points;

    bool operator==(const PolylineAddress&) const = default;
};

/// A whole polygon of the file.
struct WholeFaceAddress {
    uint32_t face = 0;

    bool operator==(const WholeFaceAddress&) const = default;
};

/// What distances can be measured from.
using AnchorAddress = std::variant<SurfaceAddress, PolylineAddress, WholeFaceAddress>;

/// Reads the program's form of an address: `v:INDEX`, `f:FACE[.TRIANGLE]:b0,b1,b2` or `x,y,z`.
/// @throws InputError that shows the text and the three forms.
SurfaceAddress parse_address(const std::string& text);

/// For messages: "vertex 12", "face 3 triangle 0 at 0.2,0.3,0.5", "the surface point nearest to 1,2,3".
std::string describe(const SurfaceAddress& address);

/// Barycentrics must be at least -1e-9 and sum to 1 within 1e-6. Returns them clamped and normalized, or
/// unchanged where they already are. @throws InputError, one sentence that begins with what was found.
std::array<double, 3> checked_barycentric(const std::array<double, 3>& weights);

} // namespace anvil
