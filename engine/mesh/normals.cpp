#include "engine/mesh/normals.h"

#include <limits>
#include <numeric>

namespace anvil {

namespace {

/// Applies the shortest rotation from unit vector `from` to unit vector `to`; a zero vector means none.
Vec3 turned(const Vec3& v, const Vec3& from, const Vec3& to) {
    const Vec3 axis = glm::cross(from, to);
    const double cosine = glm::dot(from, to);
    if (from == Vec3{0} || to == Vec3{0}) {
        return v;
    }
    if (cosine < -1 + 1e-12) {
        // Half a turn: any axis across will do.
        const Vec3 side = std::abs(from.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 across = glm::normalize(glm::cross(from, side));
        return 2 * glm::dot(v, across) * across - v;
    }
    // Rodrigues' formula without an angle: axis has length sin, and (1 - cos) / sin^2 = 1 / (1 + cos).
    return cosine * v + glm::cross(axis, v) + glm::dot(axis, v) / (1 + cosine) * axis;
}

std::vector<bool> touched_vertices(const Mesh& mesh, const std::vector<bool>& moved) {
    std::vector<bool> touched = moved;
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        const std::span<const uint32_t> polygon = mesh.polygon(f);
        if (std::any_of(polygon.begin(), polygon.end(), [&moved](uint32_t v) { return moved[v]; })) {
            for (const uint32_t v : polygon) {
                touched[v] = true;
            }
        }
    }
    return touched;
}

class NormalTurner {
  public:
    NormalTurner(Mesh& mesh, std::span<const Vec3> new_positions, const std::vector<bool>& moved)
        : mesh_(mesh), touched_(touched_vertices(mesh, moved)), before_(vertex_normals(mesh, mesh.positions)),
          after_(vertex_normals(mesh, new_positions)) {}

    void turn_columns(Column& x, Column& y, Column& z) {
        for (size_t v = 0; v < mesh_.vertex_count(); ++v) {
            if (changes(v)) {
                const Vec3 n = turned({x.values[v], y.values[v], z.values[v]}, before_[v], after_[v]);
                x.values[v] = n.x;
                y.values[v] = n.y;
                z.values[v] = n.z;
            }
        }
    }

    void turn_corners();

  private:
    bool changes(size_t v) const { return touched_[v] && before_[v] != after_[v]; }
    uint32_t own_entry(uint32_t entry, size_t corners_here);

    Mesh& mesh_;
    std::vector<bool> touched_;
    std::vector<Vec3> before_;
    std::vector<Vec3> after_;
    std::vector<uint32_t> uses_; ///< corners that still use each entry of the original pool
};

/// An entry that only these corners will use: a copy where others use it too.
uint32_t NormalTurner::own_entry(uint32_t entry, size_t corners_here) {
    std::vector<double>& values = mesh_.corner_normals.values;
    if (uses_[entry] == corners_here) {
        return entry;
    }
    uses_[entry] -= static_cast<uint32_t>(corners_here);
    const std::array<double, 3> copy = {values[3 * entry], values[3 * entry + 1], values[3 * entry + 2]};
    values.insert(values.end(), copy.begin(), copy.end());
    return static_cast<uint32_t>(values.size() / 3 - 1);
}

void NormalTurner::turn_corners() {
    CornerLayer& layer = mesh_.corner_normals;
    uses_.assign(layer.values.size() / 3, 0);
    std::vector<uint32_t> corners;
    for (uint32_t c = 0; c < layer.index.size(); ++c) {
        if (layer.index[c] == no_index) {
            continue;
        }
        ++uses_[layer.index[c]];
        if (changes(mesh_.corners[c])) {
            corners.push_back(c);
        }
    }
    const auto key = [&](uint32_t c) { return std::pair(layer.index[c], mesh_.corners[c]); };
    std::sort(corners.begin(), corners.end(),
              [&](uint32_t a, uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    for (size_t i = 0; i < corners.size();) {
        size_t end = i;
        const auto here = key(corners[i]);
        while (end < corners.size() && key(corners[end]) == here) {
            ++end;
        }
        const uint32_t entry = own_entry(here.first, end - i);
        double* value = layer.values.data() + 3 * size_t{entry};
        const Vec3 n = turned({value[0], value[1], value[2]}, before_[here.second], after_[here.second]);
        std::copy(&n.x, &n.x + 3, value);
        for (; i < end; ++i) {
            layer.index[corners[i]] = entry;
        }
    }
}

constexpr size_t absent = std::numeric_limits<size_t>::max();

size_t find_column(const Mesh& mesh, const char* name) {
    const auto found = std::find_if(mesh.vertex_columns.begin(), mesh.vertex_columns.end(),
                                    [name](const Column& column) { return column.name == name; });
    return found == mesh.vertex_columns.end() ? absent
                                              : static_cast<size_t>(found - mesh.vertex_columns.begin());
}

/// Of nx, ny, nz; all three are there, or `absent` is the first.
std::array<size_t, 3> normal_columns(const Mesh& mesh) {
    const std::array<size_t, 3> found = {find_column(mesh, "nx"), find_column(mesh, "ny"),
                                         find_column(mesh, "nz")};
    const bool all = std::find(found.begin(), found.end(), absent) == found.end();
    return all ? found : std::array<size_t, 3>{absent, absent, absent};
}

} // namespace

bool has_normals(const Mesh& mesh) {
    return normal_columns(mesh)[0] != absent || !mesh.corner_normals.empty();
}

void update_normals(Mesh& mesh, std::span<const Vec3> new_positions, const std::vector<bool>& moved) {
    if (!has_normals(mesh)) {
        return;
    }
    NormalTurner turner(mesh, new_positions, moved);
    if (const auto [x, y, z] = normal_columns(mesh); x != absent) {
        turner.turn_columns(mesh.vertex_columns[x], mesh.vertex_columns[y], mesh.vertex_columns[z]);
    }
    if (!mesh.corner_normals.empty()) {
        turner.turn_corners();
    }
}

} // namespace anvil
