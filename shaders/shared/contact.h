// Contact of one vertex with the occluders, alike in C++ and GLSL. "True-level contact": near an occluder a
// vertex is held at the level `margin`, which no sampled field and no step can miss, and remembers by `lift`
// how far above its true level that is. Where occluders move, lengths and directions of steps are those of
// the relative motion. Needs what path.h does.

// The occluder that matters at a point: the one with the least clearance = distance - margin; for a vertex
// still inside the one of least distance, which it has to leave first.
struct Contact {
    uint occluder;
    real distance;
    real clearance;
    real3 normal;
    real step; // how far a vertex may go without missing any occluder, or an influence's change
    real skip; // how far it goes without meeting any occluder or influence at all
};

struct Vertex {
    real3 start;
    real3 offset; // what the occluders did, o of eq. 13: only this is accumulated
    real lift;    // margin - true level while held, 0 while free
    real settle;  // the level below which the vertex is never set down
    bool inside;  // has not been outside yet
    uint segment; // where on the path it is: the segment from this sample,
    real tau;     // and the share of it
    uint nearest; // past moving occluders: the nearest one at the start,
    real way;     // and the relative motion of the two so far, grown with it; 1e30 once another was nearer
    uint steps;
    uint samples;
    uint flags;
};

// The fastest that the vertex and any occluder's surface near it may approach, per share of the segment,
// for a step this long.
real pace(Path path, Contact here, Vertex vertex) {
    if (params.moving == 0u) {
        return path.reach;
    }
    real fastest = 0.0;
    real3 p = vertex.start + path_at(path, vertex.tau) + vertex.offset;
    for (uint k = 0u; k < params.occluder_count; ++k) {
        Pose pose = pose_at(vertex.segment, k);
        real linear = params.motion == MOTION_ARC ? path.reach + length(pose.move)
                                                  : length(path.to - path.from - pose.move);
        real arm = length(p - (pose.origin + vertex.tau * pose.move)) + here.step;
        // Twice the growth: exp(x) - 1 <= 2 x for the x <= 1/2 that such a step leaves.
        real grown = real(2.0) * abs(pose.growth) * (arm + max(here.distance, real(0.0)));
        fastest = max(fastest, linear + abs(pose.turn) * arm + grown);
    }
    return fastest;
}

Contact contact_at(real3 p, INOUT(Vertex) vertex) {
    Contact contact;
    contact.occluder = 0u;
    contact.distance = 0.0;
    contact.clearance = 1e30;
    real least = 1e30;
    contact.normal = real3(0.0);
    contact.step = 1e30;
    contact.skip = 1e30;
    for (uint k = 0u; k < params.occluder_count; ++k) {
        Probe probe = posed_probe(k, p, vertex.segment, vertex.tau);
        real clearance = probe.distance - occluders[k].margin;
        real skip = real(0.9) * clearance;
        real step = max(occluders[k].step, skip);
        real width = occluders[k].width;
        if (occluders[k].influence == INFLUENCE_SOFT) {
            real beyond = max(probe.distance - SOFT_REACH * width, real(0.0));
            skip = min(skip, beyond);
            step = min(step, beyond + width / SOFT_FINENESS);
        } else if (occluders[k].influence == INFLUENCE_CURVE) {
            real beyond = max(probe.distance - width, real(0.0));
            skip = min(skip, beyond);
            step = min(step, beyond + width / CURVE_FINENESS);
        }
        contact.skip = min(contact.skip, skip);
        contact.step = min(contact.step, step);
        real level = vertex.inside ? probe.distance : clearance;
        if (level < least) {
            least = level;
            contact.occluder = k;
            contact.distance = probe.distance;
            contact.clearance = clearance;
            contact.normal = probe.normal;
        }
    }
    vertex.samples += params.occluder_count;
    return contact;
}

// How much an influence slows a vertex that approaches: eq. 17 as a share of the step r along direction u.
real slowing(Contact contact, real lift, real3 u, real r) {
    Occluder occluder = occluder_at(contact.occluder);
    real level = max(contact.distance - lift, real(0.0));
    real approach = max(real(0.0), -dot(u, contact.normal)) * r;
    if (occluder.influence == INFLUENCE_SOFT) {
        real x = level / occluder.width;
        return occluder.strength * approach * exp(-x * x);
    }
    if (occluder.influence == INFLUENCE_CURVE) {
        return occluder.strength * approach * curve_value(occluder.curve, level / occluder.width);
    }
    return 0.0;
}

// The next tau: adaptive by the contact's step, or whole steps of the fixed grid.
real next_tau(Path path, Contact here, Vertex vertex) {
    real speed = pace(path, here, vertex);
    if (!(speed > 0.0)) {
        return 1.0;
    }
    if (params.steps != STEPS_ADAPTIVE) {
        real count = real(params.step_limit);
        real whole =
            params.steps == STEPS_EVERY ? real(1.0) : max(floor(here.skip * count / speed), real(1.0));
        real done = floor(vertex.tau * count + real(0.5));
        return min(done + whole, count) / count;
    }
    real next = vertex.tau + here.step / speed;
    return next > real(1.0 - 1e-6) ? real(1.0) : next;
}
