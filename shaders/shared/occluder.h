// Signed distance (< 0 inside) and outward unit normal of occluders, alike in C++ and GLSL.
// The includer provides the arrays `nodes` and `occluders` and `real4 volume_texel(uint volume, real3 uvw)`:
// filtered (normal, distance) of a sampled field, uvw in [0, 1] between the outermost voxel centres;
// `uint brick_word(ShapeNode node, uint index)`: a word of the node's adaptive field.
// `bool shape_is(uint kind, uint wanted)`: kind == wanted, where the includer may know that no node is of a
// kind.

struct Probe {
    real distance;
    real3 normal;
};

real3 unit_or(real3 v, real3 fallback) {
    real size = length(v);
    return size > 0.0 ? v / size : fallback;
}

real sign_of(real x) {
    return x < 0.0 ? real(-1.0) : real(1.0);
}

Probe sphere_probe(real3 p, real radius) {
    Probe result;
    result.distance = length(p) - radius;
    result.normal = unit_or(p, real3(0.0, 1.0, 0.0));
    return result;
}

// Rounded box: `half_size` includes the rounding.
Probe box_probe(real3 p, real3 half_size, real rounding) {
    real3 side = real3(sign_of(p.x), sign_of(p.y), sign_of(p.z));
    real3 q = abs(p) - (half_size - real3(rounding));
    real3 outside = max(q, real3(0.0));
    real reach = length(outside);
    real deepest = max(q.x, max(q.y, q.z));
    Probe result;
    result.distance = reach + min(deepest, real(0.0)) - rounding;
    if (reach > 0.0) {
        result.normal = side * outside / reach;
    } else if (deepest == q.x) {
        result.normal = real3(side.x, 0.0, 0.0);
    } else if (deepest == q.y) {
        result.normal = real3(0.0, side.y, 0.0);
    } else {
        result.normal = real3(0.0, 0.0, side.z);
    }
    return result;
}

// A solid of revolution about y from its half plane: distance and gradient (radial, axial) there.
Probe revolved(real3 p, real radial, real distance, real gradient_radial, real gradient_axial) {
    Probe result;
    result.distance = distance;
    real3 outward = radial > 0.0 ? real3(p.x / radial, 0.0, p.z / radial) : real3(1.0, 0.0, 0.0);
    result.normal = gradient_radial * outward + real3(0.0, gradient_axial, 0.0);
    return result;
}

Probe cylinder_probe(real3 p, real radius, real half_height) {
    real radial = length(real3(p.x, 0.0, p.z));
    real side = sign_of(p.y);
    real a = radial - radius;
    real b = abs(p.y) - half_height;
    if (a > 0.0 && b > 0.0) {
        real reach = length(real3(a, b, 0.0));
        return revolved(p, radial, reach, a / reach, side * b / reach);
    }
    if (a > b) {
        return revolved(p, radial, a, real(1.0), real(0.0));
    }
    return revolved(p, radial, b, real(0.0), side);
}

// `half_height`: of the segment between the two cap centres.
Probe capsule_probe(real3 p, real radius, real half_height) {
    real3 q = real3(p.x, p.y - clamp(p.y, -half_height, half_height), p.z);
    Probe result;
    result.distance = length(q) - radius;
    result.normal = unit_or(q, real3(1.0, 0.0, 0.0));
    return result;
}

// Base of the given radius at y = -half_height, apex at y = +half_height.
Probe cone_probe(real3 p, real radius, real half_height) {
    real radial = length(real3(p.x, 0.0, p.z));
    real slant = length(real3(radius, real(2.0) * half_height, 0.0));
    real normal_radial = real(2.0) * half_height / slant; // outward normal of the mantle in the half plane
    real normal_axial = radius / slant;
    real along =
        clamp(((radius - radial) * radius + (p.y + half_height) * real(2.0) * half_height) / (slant * slant),
              real(0.0), real(1.0));
    real mantle_radial = radial - radius * (real(1.0) - along);
    real mantle_axial = p.y + half_height * (real(1.0) - real(2.0) * along);
    real base_radial = radial - min(radial, radius);
    real base_axial = p.y + half_height;
    real mantle = length(real3(mantle_radial, mantle_axial, 0.0));
    real base = length(real3(base_radial, base_axial, 0.0));
    real above_mantle = (radial - radius) * normal_radial + (p.y + half_height) * normal_axial;
    bool inside = above_mantle < 0.0 && base_axial > 0.0;
    bool to_mantle = mantle <= base;
    if (inside) {
        return to_mantle ? revolved(p, radial, -mantle, normal_radial, normal_axial)
                         : revolved(p, radial, -base, real(0.0), real(-1.0));
    }
    if (to_mantle) {
        if (along > 0.0 &&
            along < 1.0) { // not from mantle_radial / mantle: at the surface that is rounding alone
            return revolved(p, radial, mantle, normal_radial, normal_axial);
        }
        return mantle > 0.0 ? revolved(p, radial, mantle, mantle_radial / mantle, mantle_axial / mantle)
                            : revolved(p, radial, real(0.0), normal_radial, normal_axial);
    }
    return base > 0.0 ? revolved(p, radial, base, base_radial / base, base_axial / base)
                      : revolved(p, radial, real(0.0), real(0.0), real(-1.0));
}

Probe torus_probe(real3 p, real major, real minor) {
    real radial = length(real3(p.x, 0.0, p.z));
    real a = radial - major;
    real reach = length(real3(a, p.y, 0.0));
    real inverse = reach > 0.0 ? real(1.0) / reach : real(0.0);
    return revolved(p, radial, reach - minor, reach > 0.0 ? a * inverse : real(1.0), p.y * inverse);
}

// Sampled field at p, of which the `texel` (normal, distance) is that at c, the nearest place in its box.
// Outside the box: a lower bound of the distance for an occluder that lies inside the box.
Probe sampled_probe(real4 texel, real3 p, real3 c) {
    real3 normal = unit_or(real3(texel.x, texel.y, texel.z), real3(0.0, 1.0, 0.0));
    real3 beyond = p - c;
    real reach = length(beyond);
    Probe result;
    result.distance = texel.w;
    result.normal = normal;
    if (reach > 0.0) {
        result.distance = sqrt(reach * reach + texel.w * texel.w);
        result.normal = unit_or(beyond + max(texel.w, real(0.0)) * normal, normal);
    }
    return result;
}

Probe volume_probe(uint volume, real3 p, real3 half_size) {
    real3 c = clamp(p, -half_size, half_size);
    return sampled_probe(volume_texel(volume, real(0.5) * (c / half_size) + real3(0.5)), p, c);
}

// A sample of an adaptive field: its normal and the distance in its brick's unit. The normal's length is
// BRICK_NORMALS to 7 %, by a line for the root: between normals of unequal lengths the longer one would count
// for more.
real4 brick_sample(uint word) {
    real x = real(int(word << 10u) >> 22);
    real y = real(int(word) >> 22);
    real z = BRICK_NORMALS - abs(x) - abs(y);
    real fold = max(-z, real(0.0));
    x -= x < 0.0 ? -fold : fold;
    y -= y < 0.0 ? -fold : fold;
    real unit = real(1.9535) - real(0.9982) / (BRICK_NORMALS * BRICK_NORMALS) * (x * x + y * y + z * z);
    return real4(unit * x, unit * y, unit * z, real(int(word << 20u) >> 20));
}

// Samples at the ends of a cell's edge along x, from word `index` on, interpolated at t.
real4 brick_edge(ShapeNode node, uint index, real t) {
    real4 low = brick_sample(brick_word(node, index));
    return low + t * (brick_sample(brick_word(node, index + 1u)) - low);
}

real4 brick_face(ShapeNode node, uint index, real3 t) {
    real4 low = brick_edge(node, index, t.x);
    return low + t.y * (brick_edge(node, index + BRICK_SIDE, t.x) - low);
}

// Trilinear (normal, distance) of an adaptive field at c in its box, relative to the box's centre.
real4 brick_texel(ShapeNode node, real3 c) {
    real3 place = max((c + node.size) / node.extra, real3(0.0)); // in voxels
    real width = real(BRICK_CELLS);
    real3 grid = floor(real(2.0) * node.size / (width * node.extra) + real(0.5));
    real3 brick = min(floor(place / width), grid - real(1.0));
    uint entry =
        brick_word(node, uint(brick.x) + uint(grid.x) * (uint(brick.y) + uint(grid.y) * uint(brick.z)));
    real scale = real(1u << (entry >> BRICK_LEVEL_SHIFT));
    real3 within = place / scale - width * floor(brick / scale); // in cells of the brick's own level
    real3 cell = clamp(floor(within), real3(0.0), real3(width - 1.0));
    uint low = (entry & ((1u << BRICK_RANGE_SHIFT) - 1u)) + uint(cell.x) +
               BRICK_SIDE * (uint(cell.y) + BRICK_SIDE * uint(cell.z));
    real3 t = within - cell;
    real4 texel = brick_face(node, low, t);
    texel += t.z * (brick_face(node, low + BRICK_SIDE * BRICK_SIDE, t) - texel);
    uint exponent = (entry >> BRICK_RANGE_SHIFT) & ((1u << (BRICK_LEVEL_SHIFT - BRICK_RANGE_SHIFT)) - 1u);
    texel.w *= node.extra * (real(1u << exponent) / BRICK_DISTANCES);
    return texel;
}

Probe bricks_probe(ShapeNode node, real3 p) {
    real3 c = clamp(p, -node.size, node.size);
    return sampled_probe(brick_texel(node, c), p, c);
}

Probe leaf_probe(ShapeNode node, real3 p) {
    real3 arm = (p - node.origin) / node.scale;
    real3 q = real3(dot(node.axis_x, arm), dot(node.axis_y, arm), dot(node.axis_z, arm));
    Probe result;
    result.distance = 0.0;
    result.normal = real3(0.0);
    if (shape_is(node.kind, SHAPE_SPHERE)) {
        result = sphere_probe(q, node.size.x);
    } else if (shape_is(node.kind, SHAPE_BOX)) {
        result = box_probe(q, node.size, node.extra);
    } else if (shape_is(node.kind, SHAPE_CYLINDER)) {
        result = cylinder_probe(q, node.size.x, node.size.y);
    } else if (shape_is(node.kind, SHAPE_CAPSULE)) {
        result = capsule_probe(q, node.size.x, node.size.y);
    } else if (shape_is(node.kind, SHAPE_CONE)) {
        result = cone_probe(q, node.size.x, node.size.y);
    } else if (shape_is(node.kind, SHAPE_TORUS)) {
        result = torus_probe(q, node.size.x, node.size.y);
    } else if (shape_is(node.kind, SHAPE_PLANE)) {
        result.distance = dot(node.size, q) - node.extra;
        result.normal = node.size;
    } else if (shape_is(node.kind, SHAPE_VOLUME)) {
        result = volume_probe(node.volume, q, node.size);
    } else if (shape_is(node.kind, SHAPE_BRICKS)) {
        result = bricks_probe(node, q);
    }
    result.distance = result.distance * node.scale;
    result.normal =
        node.axis_x * result.normal.x + node.axis_y * result.normal.y + node.axis_z * result.normal.z;
    return result;
}

// Boolean operators of solids on distances: exact zero set and sign, elsewhere a bound.
Probe combined(uint operation, Probe a, Probe b) {
    if (operation == SHAPE_UNION) {
        return a.distance <= b.distance ? a : b;
    }
    if (operation == SHAPE_SUBTRACTION) {
        b.distance = -b.distance;
        b.normal = -b.normal;
    }
    return a.distance >= b.distance ? a : b;
}

// The shape of `count` nodes from `first` at p, both in the occluder's space. One call of leaf_probe, and the
// top of the stack apart from it: a device compiles the leaf once a call and keeps a single leaf out of
// memory.
Probe shape_probe(uint first, uint count, real3 p) {
    Probe below[MAX_SHAPE_STACK];
    Probe top;
    top.distance = 0.0;
    top.normal = real3(0.0);
    uint depth = 0u;
    for (uint i = 0u; i < count; ++i) {
        ShapeNode node = nodes[first + i];
        if (node.kind >= SHAPE_UNION) {
            --depth;
            top = combined(node.kind, below[depth], top);
        } else {
            if (i > 0u) {
                below[depth] = top;
                ++depth;
            }
            top = leaf_probe(node, p);
        }
    }
    return top;
}

// p, relative to the mesh's origin, in the occluder's own space.
real3 in_space_of(Occluder occluder, real3 p) {
    real3 arm = (p - occluder.origin) / occluder.scale;
    return real3(dot(occluder.axis_x, arm), dot(occluder.axis_y, arm), dot(occluder.axis_z, arm));
}

// Occluder `index` at p, both relative to the mesh's origin.
Probe occluder_probe(uint index, real3 p) {
    Occluder occluder = occluders[index];
    Probe result = shape_probe(occluder.first_node, occluder.node_count, in_space_of(occluder, p));
    result.distance = result.distance * occluder.scale;
    result.normal = occluder.axis_x * result.normal.x + occluder.axis_y * result.normal.y +
                    occluder.axis_z * result.normal.z;
    return result;
}
