// What is known of a vertex's whole path before any look at the occluders, alike in C++ and GLSL: whether it
// keeps clear of their boxes. Needs what path.h does.

// How far from its surface an occluder acts, at most: by contact, with as much again for what fields and
// rounding may err, and by its influence.
real acts_within(Occluder occluder) {
    real contact = real(2.0) * occluder.margin;
    if (occluder.influence == INFLUENCE_SOFT) {
        return max(contact, BOX_SAFETY * SOFT_REACH * occluder.width);
    }
    return occluder.influence == INFLUENCE_CURVE ? max(contact, BOX_SAFETY * occluder.width) : contact;
}

// Whether the line from a to b, both in the occluder's own space, is farther than `reach` from one side of
// its box. Not from the box's edges: the distances of Boolean shapes are bounds, which hold side by side.
bool beyond_box(Occluder occluder, real3 a, real3 b, real reach) {
    real3 gap = abs(real(0.5) * (a + b) - occluder.box_centre) - real(0.5) * abs(b - a) - occluder.box_half;
    return occluder.boxed != 0u && max(gap.x, max(gap.y, gap.z)) > reach;
}

// How far a way of a given length strays from the straight line between its ends, at most: it stays in the
// ellipsoid with these as foci. A little more, since the difference is one of rounded numbers.
real straying(real way, real distance) {
    return real(0.5) * sqrt(max(way * way - distance * distance, real(0.0)) + real(1e-6) * way * way);
}

// Length of a segment of the path as it is seen from a moving occluder, in units of `least` times the
// world's, at most.
real way_past(Path path, Pose pose, real3 from, real3 to, real least) {
    bool arc = params.motion == MOTION_ARC;
    real arm = max(length(from - pose.origin), length(to - (pose.origin + pose.move)));
    real linear = arc ? path.reach + length(pose.move) : length(path.to - path.from - pose.move);
    arm += arc ? path.reach : real(0.0);
    return (linear + (abs(pose.turn) + abs(pose.growth)) * arm) / least;
}

// Whether occluder k cannot act on a vertex on this segment of its path.
bool keeps_clear(uint k, Path path, real3 start, uint segment) {
    Occluder occluder = occluders[k];
    real3 from = start + path_at(path, 0.0);
    real3 to = start + path_at(path, 1.0);
    real stray = 0.0;
    real least = 1.0; // of the ratios of its scale to the one that its box is given for
    if (params.moving != 0u) {
        Pose pose = pose_at(segment, k);
        real last = pose.ratio * growth_by(pose, 1.0);
        least = min(pose.ratio, last);
        real way = way_past(path, pose, from, to, least);
        from = carried_back(k, pose, from, 0.0, pose.ratio);
        to = carried_back(k, pose, to, 1.0, last);
        stray = straying(way, length(to - from));
    } else if (params.motion == MOTION_ARC) {
        stray = straying(path.reach, length(to - from));
    }
    real reach = (stray + acts_within(occluder) / least) / occluder.scale;
    return beyond_box(occluder, in_space_of(occluder, from), in_space_of(occluder, to), reach);
}

// Point i where no occluder can act on it: it goes its way, or has none. False where one may: then the result
// is none.
bool unhindered(uint i, INOUT(VertexResult) result) {
    real3 start = points[i];
    bool clear = params.paper == 0u && params.steps != STEPS_EVERY;
    real way = 0.0;
    result.displacement = real3(0.0);
    if (params.occluder_count == 0u) {
        result.displacement = path_at(path_segment(i, params.sample_count - 1u, start), 1.0);
    } else {
        clear = clear && start_distances[i] >= 0.0;
        for (uint s = 0u; s < params.sample_count; ++s) {
            Path path = path_segment(i, s, start);
            way += path.reach;
            for (uint k = 0u; k < params.occluder_count; ++k) {
                clear = clear && keeps_clear(k, path, start, s);
            }
            result.displacement = path_at(path, 1.0);
        }
    }
    // A path that goes nowhere leaves a vertex alone, unless an occluder may come to it.
    bool rests = params.moving == 0u && way <= params.path_epsilon;
    result.steps = 0u;
    result.samples = 0u;
    result.flags = 0u;
    if (params.occluder_count > 0u) {
        if (rests) {
            result.displacement = real3(0.0);
        } else {
            result.steps = params.sample_count;
        }
        result.flags = start_distances[i] < 0.0 ? VERTEX_STARTED_INSIDE : 0u;
    }
    return params.occluder_count == 0u || rests || clear;
}
