// The edit of one vertex: blend of the handles, then advection along its path past the occluders, alike in
// C++ and GLSL. "True-level contact": near an occluder a vertex is held at the level `margin`, which no
// sampled field and no step can miss, and remembers by `lift` how far above its true level that is. Where
// occluders move, lengths and directions of steps are those of the relative motion. The includer provides,
// beside what occluder.h and shape_function.h need, `params`, `points`, `fields`, `shapes`, `targets`,
// `poses` (sample by sample, params.occluder_count each) and `start_distances`, `Occluder occluder_at(uint
// k)` (occluders[k] for a k that differs between vertices), and for C++ the macro INOUT.

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

// Moves p along normals until its clearance is 0. False in a corner, where that fails.
bool put_on_level(INOUT(real3) offset, real3 base, INOUT(Contact) contact, INOUT(Vertex) vertex) {
    for (uint i = 0u; i < NEWTON_LIMIT; ++i) {
        if (abs(contact.clearance) <= NEWTON_TOLERANCE * occluder_at(contact.occluder).step) {
            return true;
        }
        offset -= contact.clearance * contact.normal;
        contact = contact_at(base + offset, vertex);
    }
    return contact.clearance >= -CORNER_DEPTH * occluder_at(contact.occluder).step;
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

// Takes a vertex that starts in the band below the margin up to it; `lift` remembers how far.
Contact lifted(INOUT(Vertex) vertex) {
    Contact contact = contact_at(vertex.start, vertex);
    vertex.settle = min(vertex.settle, contact.distance);
    if (contact.clearance >= 0.0) {
        return contact;
    }
    Contact raised = contact;
    real3 offset = real3(0.0);
    if (put_on_level(offset, vertex.start, raised, vertex)) {
        vertex.offset = offset;
        vertex.lift = raised.clearance - contact.clearance;
        return raised;
    }
    return contact;
}

// A vertex still inside is pushed outward by at most its own step, and starts to be held once that is enough:
// by how far the last push was cut short it is inside, so that a little more and a little less end alike.
Contact emerge(INOUT(Vertex) vertex, real3 base, real3 offset, real r) {
    vertex.offset = offset;
    Contact contact = contact_at(base + offset, vertex);
    real left = r;
    for (uint i = 0u; i < NEWTON_LIMIT && contact.distance < 0.0 && left > 0.0; ++i) {
        real push = min(-contact.distance, left);
        left -= push;
        vertex.offset += push * contact.normal;
        contact = contact_at(base + vertex.offset, vertex);
        if (contact.distance >= -NEWTON_TOLERANCE * occluder_at(contact.occluder).step) {
            break; // fields and rounding may never show 0
        }
    }
    bool short_of = contact.distance < -NEWTON_TOLERANCE * occluder_at(contact.occluder).step;
    if (short_of || left <= 0.0) {
        return contact;
    }
    vertex.inside = false;
    real3 raised = vertex.offset;
    Contact held = contact;
    if (contact.clearance < 0.0 && put_on_level(raised, base, held, vertex)) {
        vertex.offset = raised;
        vertex.lift = held.clearance - contact.clearance;
        return held;
    }
    return contact;
}

// One step of the contact rules from `here`, a path increment `move` to base = start + path(next).
Contact contact_step(INOUT(Vertex) vertex, Contact here, real3 base, real3 move, real next) {
    real3 last = base - move + vertex.offset;
    real from = vertex.tau;
    real3 carried = carry(here.occluder, last, vertex.segment, from, next);
    real3 relative = move - carried;
    real r = length(relative);
    real3 u = r > 0.0 ? relative / r : real3(0.0);
    real3 offset = vertex.offset;
    vertex.tau = next;
    real growth = grown(here.occluder, vertex.segment, next - from);
    vertex.way = here.occluder == vertex.nearest ? growth * vertex.way + r : real(1e30);
    if (vertex.inside) {
        return emerge(vertex, base, offset, r);
    }
    offset += slowing(here, vertex.lift, u, r) * here.normal;
    Contact contact = contact_at(base + offset, vertex);
    if (contact.clearance >= vertex.lift) { // free, or free again
        vertex.offset = offset - vertex.lift * contact.normal;
        vertex.lift = 0.0;
        return contact;
    }
    vertex.flags |= VERTEX_TOUCHED;
    Contact held = contact;
    real3 held_offset = offset;
    bool ok = put_on_level(held_offset, base, held, vertex);
    if (params.moving != 0u && held.occluder != here.occluder) {
        carried = carry(held.occluder, last, vertex.segment, from, next);
        r = length(move - carried);
    }
    // Held on one smooth surface a vertex goes no farther than its step; farther is a jump across a corner.
    if (!ok || length(held_offset + (move - carried) - vertex.offset) >
                   real(2.0) * r + real(4.0) * NEWTON_TOLERANCE * occluder_at(contact.occluder).step) {
        vertex.offset += carried - move; // stay at the last position, as the occluder sees it
        if (params.moving != 0u) {
            return contact_at(base + vertex.offset, vertex);
        }
        return here;
    }
    vertex.offset = held_offset;
    real lowest = min(occluder_at(held.occluder).settle, vertex.settle);
    vertex.lift = min(vertex.lift - contact.clearance + held.clearance, held.distance - lowest);
    return held;
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

// Follows one path segment. Returns the path's value where the vertex ended (before 1 if the limit was
// reached).
real3 follow(INOUT(Vertex) vertex, Path path, INOUT(Contact) here) {
    real3 at = path_at(path, vertex.tau);
    while (vertex.tau < 1.0) {
        if (params.steps == STEPS_ADAPTIVE && vertex.steps >= params.step_limit) {
            vertex.flags |= VERTEX_LIMIT_REACHED;
            return at;
        }
        real next = next_tau(path, here, vertex);
        real3 to = path_at(path, next);
        here = contact_step(vertex, here, vertex.start + to, to - at, next);
        vertex.steps += 1u;
        at = to;
    }
    return at;
}

// Lowers a held vertex from the margin to its true level, and never below the level where fields may err.
void set_down(INOUT(Vertex) vertex, real3 base, Contact here) {
    if (vertex.inside || vertex.lift <= 0.0) {
        return;
    }
    vertex.offset -= vertex.lift * here.normal;
    for (uint i = 0u; i < 4u; ++i) {
        Contact contact = contact_at(base + vertex.offset, vertex);
        real missing = min(occluder_at(contact.occluder).settle, vertex.settle) - contact.distance;
        if (missing <= NEWTON_TOLERANCE * NEWTON_TOLERANCE * occluder_at(contact.occluder).step) {
            return;
        }
        vertex.offset += missing * contact.normal;
    }
}

// The paper's own rule, eq. 11-17 to the letter: N equal steps, no margin, no limit.
real3 follow_paper(INOUT(Vertex) vertex, Path path) {
    for (uint i = 1u; i <= params.step_limit; ++i) {
        vertex.tau = real(i) / real(params.step_limit);
        real3 q = vertex.start + path_at(path, vertex.tau) + vertex.offset;
        Contact contact = contact_at(q, vertex);
        real psi = contact.distance <= 0.0 ? -contact.distance : exp(-contact.distance * contact.distance);
        vertex.offset += psi * contact.normal;
        vertex.steps += 1u;
    }
    return path_at(path, 1.0);
}

// The occluders have no bigger effect than the displacement that they act on (section 3.2 of the paper): a
// vertex that they moved ends no farther from its start than its path is long.
real3 bounded_by(real3 displacement, real path_length) {
    real size = length(displacement);
    return size > path_length ? displacement * (path_length / size) : displacement;
}

real whole_length(uint i, real3 start) {
    real total = 0.0;
    for (uint s = 0u; s < params.sample_count; ++s) {
        total += path_segment(i, s, start).reach;
    }
    return total;
}

// The same where occluders move: in the relative motion of the vertex and the one occluder that has been the
// nearest all along; there is no such motion where several were.
real3 bounded_past_moving(real3 displacement, Contact here, Vertex vertex) {
    if (here.occluder != vertex.nearest) {
        return displacement;
    }
    real3 carried = carry_all(vertex.nearest, vertex.start);
    real size = length(displacement - carried);
    return size > vertex.way ? carried + (displacement - carried) * (vertex.way / size) : displacement;
}

Vertex vertex_at_start(uint i) {
    Vertex vertex;
    vertex.start = points[i];
    vertex.offset = real3(0.0);
    vertex.lift = 0.0;
    vertex.settle = max(start_distances[i], real(0.0));
    vertex.inside = start_distances[i] < 0.0;
    vertex.segment = 0u;
    vertex.tau = 0.0;
    vertex.nearest = 0u;
    vertex.way = 0.0;
    vertex.steps = 0u;
    vertex.samples = 0u;
    vertex.flags = vertex.inside ? VERTEX_STARTED_INSIDE : 0u;
    return vertex;
}

// Point i from its place before the edit to its displacement after it.
VertexResult deformed(uint i) {
    Vertex vertex = vertex_at_start(i);
    real3 at = real3(0.0);
    bool lifts = params.paper == 0u && !vertex.inside;
    bool stands = params.moving == 0u;
    real path_length = params.occluder_count > 0u && stands ? whole_length(i, vertex.start) : real(0.0);
    Contact here;
    here.occluder = 0u;
    if (params.occluder_count == 0u) {
        at = path_at(path_segment(i, params.sample_count - 1u, vertex.start), 1.0);
    } else if (!stands || path_length > params.path_epsilon) {
        here = lifts ? lifted(vertex) : contact_at(vertex.start, vertex);
        vertex.nearest = here.occluder;
        for (uint s = 0u; s < params.sample_count && (vertex.flags & VERTEX_LIMIT_REACHED) == 0u; ++s) {
            Path path = path_segment(i, s, vertex.start);
            vertex.segment = s;
            vertex.tau = 0.0;
            if (params.paper != 0u) {
                at = follow_paper(vertex, path);
            } else if (!stands || path.reach > 0.0) {
                at = follow(vertex, path, here);
            }
        }
        if (params.paper == 0u) {
            set_down(vertex, vertex.start + at, here);
        }
    }
    VertexResult result;
    result.displacement = at + vertex.offset;
    if (lifts && vertex.offset != real3(0.0)) {
        result.displacement = stands ? bounded_by(result.displacement, path_length)
                                     : bounded_past_moving(result.displacement, here, vertex);
    }
    result.steps = vertex.steps;
    result.samples = vertex.samples;
    result.flags = vertex.flags;
    return result;
}
