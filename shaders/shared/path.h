// The undeflected path of a point and the poses of occluders along it, alike in C++ and GLSL. The includer
// provides, beside what occluder.h and shape_function.h need, `params`, `real field_at(uint j, uint i)`
// (distance of point i from handle j), `real handle_weight(uint j, real t)`, `real3 target_at(uint s, uint
// j)`, `poses` (sample by sample, params.occluder_count each) and `Occluder occluder_at(uint k)`
// (occluders[k] for a k that differs between vertices), and for C++ the macros INOUT and PRECISE.

struct Path {
    real3 from; // displacement (straight, chord) or angle in x (arc) at the segment's ends
    real3 to;
    real3 across; // arc: the arm's part across the axis, and its cross product with the axis
    real3 turned;
    real reach; // length of the segment
};

void sine_cosine(real angle, INOUT(real) sine, INOUT(real) cosine) {
#ifdef __cplusplus
    sine = std::sin(angle);
    cosine = std::cos(angle);
#else
    // Vulkan promises little of sin and cos; pi / 2 in three parts keeps the reduction exact for hundreds of
    // turns.
    float quarter = round(angle * 0.636619772);
    precise float r =
        ((angle - quarter * 1.5703125) - quarter * 4.837512969970703e-4) - quarter * 7.54978994e-8;
    float s = r * r;
    float sine_part = r * (1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0))));
    float cosine_part =
        1.0 - s / 2.0 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * (1.0 - s / 90.0))));
    int phase = int(quarter) & 3;
    sine = (phase & 1) == 0 ? sine_part : cosine_part;
    cosine = (phase & 1) == 0 ? cosine_part : sine_part;
    sine = (phase & 2) == 0 ? sine : -sine;
    cosine = phase == 1 || phase == 2 ? -cosine : cosine;
#endif
}

// R(angle) v - v for a vector v with the parts `across` and `turned`, without the cancellation of cos - 1.
real3 arc_offset(real angle, real3 across, real3 turned) {
    real sine = 0.0;
    real cosine = 0.0;
    sine_cosine(real(0.5) * angle, sine, cosine);
    return real(2.0) * sine * (cosine * turned - sine * across);
}

// Path value of path sample `s` (1-based; sample 0 is the start) at vertex i: sum_j alpha_j X_j, eq. 3 and 6,
// with compensated summation, since large partial displacements cancel.
real3 blended(uint i, uint s) {
    PRECISE real3 sum = real3(0.0);
    PRECISE real3 lost = real3(0.0);
    if (s == 0u) {
        return sum;
    }
    for (uint j = 0u; j < params.handle_count; ++j) {
        real weight = handle_weight(j, field_at(j, i));
        PRECISE real3 term = weight * target_at(s, j) - lost;
        PRECISE real3 next = sum + term;
        lost = (next - sum) - term;
        sum = next;
    }
    return sum;
}

Pose pose_at(uint segment, uint k) {
    return poses[segment * params.occluder_count + k];
}

Path path_segment(uint i, uint s, real3 start) {
    Path path;
    path.from = blended(i, s);
    path.to = blended(i, s + 1u);
    path.across = real3(0.0);
    path.turned = real3(0.0);
    if (params.motion == MOTION_STRAIGHT) {
        path.reach = length(path.to - path.from);
        return path;
    }
    real3 arm = start - params.axis_origin;
    path.across = arm - params.axis_direction * dot(params.axis_direction, arm);
    path.turned = cross(params.axis_direction, arm);
    path.reach = abs(path.to.x - path.from.x) * length(path.across);
    if (params.motion == MOTION_CHORD) {
        real3 chord = arc_offset(blended(i, params.sample_count).x, path.across, path.turned);
        real count = real(params.sample_count);
        path.from = (params.moving != 0u ? pose_at(s, 0u).at : real(s) / count) * chord;
        path.to = (params.moving != 0u ? pose_at(s + 1u, 0u).at : real(s + 1u) / count) * chord;
        path.reach = length(path.to - path.from);
    }
    return path;
}

// Displacement of the undeflected path at tau in [0, 1] of the segment.
real3 path_at(Path path, real tau) {
    real3 value = tau >= 1.0 ? path.to : path.from + tau * (path.to - path.from);
    if (params.motion == MOTION_ARC) {
        return arc_offset(value.x, path.across, path.turned);
    }
    return value;
}

// R v - v for a turn about a pose's axis.
real3 turn_offset(Pose pose, real angle, real3 v) {
    real3 across = v - pose.turn_axis * dot(pose.turn_axis, v);
    return arc_offset(angle, across, cross(pose.turn_axis, v));
}

real growth_by(Pose pose, real tau) {
    return pose.growth == 0.0 ? real(1.0) : exp(tau * pose.growth);
}

// What occluder k grows by over a share of a segment.
real grown(uint k, uint segment, real share) {
    return params.moving == 0u ? real(1.0) : growth_by(pose_at(segment, k), share);
}

// p as a point of space that goes along with occluder `k`, from where that is at tau of the segment that the
// pose begins to where it is in `occluders`; `ratio`: of its scale there to that.
real3 carried_back(uint k, Pose pose, real3 p, real tau, real ratio) {
    real3 arm = p - (pose.origin + tau * pose.move);
    arm += turn_offset(pose, -tau * pose.turn, arm);
    real3 q = real3(dot(pose.axis_x, arm), dot(pose.axis_y, arm), dot(pose.axis_z, arm));
    return occluders[k].origin + q / ratio;
}

// Occluder `k` at p, where it is at tau of a segment of the path.
Probe posed_probe(uint k, real3 p, uint segment, real tau) {
    if (params.moving == 0u) {
        return occluder_probe(k, p);
    }
    Pose pose = pose_at(segment, k);
    real ratio = pose.ratio * growth_by(pose, tau);
    Probe probe = occluder_probe(k, carried_back(k, pose, p, tau, ratio));
    real3 n = pose.axis_x * probe.normal.x + pose.axis_y * probe.normal.y + pose.axis_z * probe.normal.z;
    probe.distance = probe.distance * ratio;
    probe.normal = n + turn_offset(pose, tau * pose.turn, n);
    return probe;
}

// How far occluder k carries a point fastened to it, from one share of a segment to another.
real3 carry(uint k, real3 p, uint segment, real from, real to) {
    if (params.moving == 0u) {
        return real3(0.0);
    }
    Pose pose = pose_at(segment, k);
    real3 arm = p - (pose.origin + from * pose.move);
    real3 turned = turn_offset(pose, (to - from) * pose.turn, arm);
    return (to - from) * pose.move + turned + (growth_by(pose, to - from) - real(1.0)) * (arm + turned);
}

// The same from the first sample to the last.
real3 carry_all(uint k, real3 p) {
    Pose pose = pose_at(params.sample_count, k);
    real3 arm = p - occluder_at(k).origin;
    return pose.origin + pose.ratio * (pose.axis_x * arm.x + pose.axis_y * arm.y + pose.axis_z * arm.z) - p;
}
