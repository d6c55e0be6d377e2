// Normals of a surface whose vertices have moved, alike in C++ and GLSL. The includer provides `ends`
// (places, vertices with a normal first), `fan_begin` (runs of `fan_corners`) and `fan_corners`.

// Area-weighted normal of vertex `place`, whose run is the one from fan_begin[i]: of unit length, or zero
// where no triangle has area.
real3 fan_normal(uint i, uint place) {
    real3 centre = ends[place];
    real3 sum = real3(0.0);
    for (uint f = fan_begin[i]; f < fan_begin[i + 1u]; ++f) {
        sum += cross(ends[fan_corners[f].b] - centre, ends[fan_corners[f].c] - centre);
    }
    // Two steps: the squared area of a tiny triangle may underflow.
    real largest = max(abs(sum.x), max(abs(sum.y), abs(sum.z)));
    return largest > 0.0 ? normalize(sum / largest) : real3(0.0);
}
