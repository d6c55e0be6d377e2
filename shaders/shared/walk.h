// The edit of one vertex: blend of the handles, then advection along its path past the occluders, alike in
// C++ and GLSL. The includer provides, beside what occluder.h and shape_function.h need, `params`, `points`,
// `fields`, `shapes`, `targets`, `poses` (sample by sample, params.occluder_count each) and
// `start_distances`, `Occluder occluder_at(uint k)` (occluders[k] for a k that differs between vertices), and
// for C++ the macro INOUT. After looks.h.

// A vertex under way: each look at the occluders decides what the next one is for. So there is one loop and
// one place that looks: devices that run vertices side by side run both sides of every branch, and compile
// shapes and fields wherever they are looked at.
struct Walk {
    uint look;
    uint corrections; // done so far, of those that a held, raised or lowered vertex takes
    Contact here;     // at the last place that it has come to
    real3 at;         // path value up to which it has come: that of the step it is taking
    real3 offset;     // looked at together with it
    real3 move;       // the step's path increment,
    real3 carried;    // how far the nearest occluder carries the vertex meanwhile,
    real from;        // the tau that it began at
    real r;           // and the length of the relative motion, or what is left of it for pushes outward
    uint met;         // the occluder that the step met
    real clearance;   // and the clearance there
};

Walk walk_from(real3 at, uint look) {
    Walk walk;
    walk.look = look;
    walk.corrections = 0u;
    walk.here.occluder = 0u;
    walk.here.distance = 0.0;
    walk.here.clearance = 0.0;
    walk.here.normal = real3(0.0);
    walk.here.step = 0.0;
    walk.here.skip = 0.0;
    walk.at = at;
    walk.offset = real3(0.0);
    walk.move = real3(0.0);
    walk.carried = real3(0.0);
    walk.from = 0.0;
    walk.r = 0.0;
    walk.met = 0u;
    walk.clearance = 0.0;
    return walk;
}

// Lowers a held vertex from the margin towards its true level.
void begin_lowering(INOUT(Vertex) vertex, INOUT(Walk) walk) {
    walk.look = LOOK_NONE;
    if (!vertex.inside && vertex.lift > 0.0) {
        vertex.offset -= vertex.lift * walk.here.normal;
        walk.look = LOOK_DOWN;
        walk.offset = vertex.offset;
        walk.corrections = 0u;
    }
}

// The next step of a vertex on its segment, or what comes after the last one.
void set_out(INOUT(Vertex) vertex, INOUT(Walk) walk, Path path, uint lowers) {
    bool stopped = vertex.tau < 1.0 && params.steps == STEPS_ADAPTIVE && vertex.steps >= params.step_limit;
    if (stopped) {
        vertex.flags |= VERTEX_LIMIT_REACHED;
    }
    if (stopped || vertex.tau >= 1.0) {
        walk.look = LOOK_NONE;
        if (lowers == LOWERS_ENDED || (stopped && lowers == LOWERS_STOPPED)) {
            begin_lowering(vertex, walk);
        }
    } else {
        real next = next_tau(path, walk.here, vertex);
        real3 to = path_at(path, next);
        real3 last = vertex.start + walk.at + vertex.offset;
        walk.move = to - walk.at;
        walk.at = to;
        walk.from = vertex.tau;
        walk.carried = carry(walk.here.occluder, last, vertex.segment, vertex.tau, next);
        real3 relative = walk.move - walk.carried;
        walk.r = length(relative);
        walk.offset = vertex.offset;
        walk.look = LOOK_INSIDE;
        if (!vertex.inside) {
            real3 u = walk.r > 0.0 ? relative / walk.r : real3(0.0);
            walk.offset += slowing(walk.here, vertex.lift, u, walk.r) * walk.here.normal;
            walk.look = LOOK_STEP;
        }
        walk.corrections = 0u;
        real growth = grown(walk.here.occluder, vertex.segment, next - vertex.tau);
        vertex.way = walk.here.occluder == vertex.nearest ? growth * vertex.way + walk.r : real(1e30);
        vertex.tau = next;
        vertex.steps += 1u;
    }
}

// A vertex that its corrections have put on the level that it is held at, or have failed to.
void hold(INOUT(Vertex) vertex, INOUT(Walk) walk, Contact held, bool on_level) {
    real3 carried = walk.carried;
    real r = walk.r;
    if (params.moving != 0u && held.occluder != walk.here.occluder) {
        real3 last = vertex.start + (walk.at - walk.move) + vertex.offset;
        carried = carry(held.occluder, last, vertex.segment, walk.from, vertex.tau);
        r = length(walk.move - carried);
    }
    walk.look = LOOK_AHEAD;
    // Held on one smooth surface a vertex goes no farther than its step; farther is a jump across a corner.
    if (!on_level || length(walk.offset + (walk.move - carried) - vertex.offset) >
                         real(2.0) * r + real(4.0) * NEWTON_TOLERANCE * occluder_at(walk.met).step) {
        vertex.offset += carried - walk.move; // stay at the last position, as the occluder sees it
        if (params.moving != 0u) {
            walk.offset = vertex.offset;
            walk.look = LOOK_REST;
        }
    } else {
        vertex.offset = walk.offset;
        real lowest = min(occluder_at(held.occluder).settle, vertex.settle);
        vertex.lift = min(vertex.lift - walk.clearance + held.clearance, held.distance - lowest);
        walk.here = held;
    }
}

// A vertex after a look inside an occluder: pushed outward by at most its own step, and held from then on
// once that is enough: by how far the last push was cut short it is inside, so that a little more and a
// little less end alike.
void emerge(INOUT(Vertex) vertex, INOUT(Walk) walk, Contact contact) {
    bool at_surface = contact.distance >= -NEWTON_TOLERANCE * occluder_at(contact.occluder).step;
    bool pushed = walk.look == LOOK_PUSHED && at_surface; // fields and rounding may never show 0
    if (contact.distance < 0.0 && walk.r > 0.0 && walk.corrections < NEWTON_LIMIT && !pushed) {
        real push = min(-contact.distance, walk.r);
        walk.r -= push;
        walk.offset += push * contact.normal;
        walk.corrections += 1u;
        walk.look = LOOK_PUSHED;
    } else {
        vertex.offset = walk.offset;
        walk.here = contact;
        walk.look = LOOK_AHEAD;
        if (at_surface && walk.r > 0.0) {
            vertex.inside = false;
            walk.look = contact.clearance < 0.0 ? LOOK_RAISE : LOOK_AHEAD;
            walk.corrections = 0u;
        }
    }
}

// One more correction towards the level where the clearance is 0, up to a corner, where they fail.
void correct(INOUT(Vertex) vertex, INOUT(Walk) walk, Contact contact) {
    real step = occluder_at(contact.occluder).step;
    bool on_level = abs(contact.clearance) <= NEWTON_TOLERANCE * step;
    if (!on_level && walk.corrections < NEWTON_LIMIT) {
        walk.offset -= contact.clearance * contact.normal;
        walk.corrections += 1u;
    } else {
        on_level = contact.clearance >= -CORNER_DEPTH * step;
        if (walk.look == LOOK_HELD) {
            hold(vertex, walk, contact, on_level);
        } else {
            walk.look = LOOK_AHEAD;
            if (on_level) {
                vertex.offset = walk.offset;
                vertex.lift = contact.clearance - walk.here.clearance;
                walk.here = contact;
            }
        }
    }
}

// Never below the level where fields may err.
void lower(INOUT(Vertex) vertex, INOUT(Walk) walk, Contact contact) {
    Occluder occluder = occluder_at(contact.occluder);
    real missing = min(occluder.settle, vertex.settle) - contact.distance;
    bool there = missing <= NEWTON_TOLERANCE * NEWTON_TOLERANCE * occluder.step;
    if (!there) {
        vertex.offset += missing * contact.normal;
        walk.offset = vertex.offset;
        walk.corrections += 1u;
    }
    if (there || walk.corrections == LOWERING_LIMIT) {
        walk.look = LOOK_NONE;
    }
}

// What a look at the occluders has shown.
void learn(INOUT(Vertex) vertex, INOUT(Walk) walk, Contact contact) {
    if (walk.look == LOOK_START) {
        walk.here = contact;
        walk.look = LOOK_AHEAD;
        if (!vertex.inside) {
            vertex.settle = min(vertex.settle, contact.distance);
            walk.look = contact.clearance < 0.0 ? LOOK_RAISE : LOOK_AHEAD;
        }
    } else if (walk.look == LOOK_REST) {
        walk.here = contact;
        walk.look = LOOK_AHEAD;
    } else if (walk.look == LOOK_INSIDE || walk.look == LOOK_PUSHED) {
        emerge(vertex, walk, contact);
    } else if (walk.look == LOOK_STEP) {
        if (contact.clearance >= vertex.lift) { // free, or free again
            vertex.offset = walk.offset - vertex.lift * contact.normal;
            vertex.lift = 0.0;
            walk.here = contact;
            walk.look = LOOK_AHEAD;
        } else {
            vertex.flags |= VERTEX_TOUCHED;
            walk.met = contact.occluder;
            walk.clearance = contact.clearance;
            walk.look = LOOK_HELD;
            walk.corrections = 0u;
        }
    }
    if (walk.look == LOOK_HELD || walk.look == LOOK_RAISE) {
        correct(vertex, walk, contact);
    } else if (walk.look == LOOK_DOWN) {
        lower(vertex, walk, contact);
    }
}

void look(INOUT(Vertex) vertex, INOUT(Walk) walk) {
    learn(vertex, walk, contact_at(vertex.start + walk.at + walk.offset, vertex));
}

// Takes a walk to the end of a segment, or to where the step limit stops it.
void proceed(INOUT(Vertex) vertex, INOUT(Walk) walk, Path path, uint lowers) {
    if (walk.look == LOOK_AHEAD) {
        set_out(vertex, walk, path, lowers);
    }
    if (walk.look != LOOK_NONE) {
        do {
            look(vertex, walk);
            if (walk.look == LOOK_AHEAD) {
                if (vertex.steps == 0u) {
                    vertex.nearest = walk.here.occluder;
                }
                set_out(vertex, walk, path, lowers);
            }
        } while (walk.look != LOOK_NONE);
    }
}

// The whole path of a vertex, segment by segment.
Walk followed(uint i, INOUT(Vertex) vertex) {
    Walk walk = walk_from(real3(0.0), LOOK_START);
    for (uint s = 0u; s < params.sample_count && (vertex.flags & VERTEX_LIMIT_REACHED) == 0u; ++s) {
        Path path = path_segment(i, s, vertex.start);
        vertex.segment = s;
        // A path that goes nowhere leaves a vertex alone, unless an occluder may come to it.
        vertex.tau = params.moving != 0u || path.reach > 0.0 ? real(0.0) : real(1.0);
        walk.look = s == 0u ? LOOK_START : LOOK_AHEAD;
        proceed(vertex, walk, path, s + 1u < params.sample_count ? LOWERS_STOPPED : LOWERS_ENDED);
    }
    return walk;
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

// Point i from its place before the edit to its displacement after it, past occluders that may act on it.
VertexResult hindered(uint i) {
    Vertex vertex = vertex_at_start(i);
    bool lifts = params.paper == 0u && !vertex.inside;
    bool stands = params.moving == 0u;
    Walk walk = walk_from(real3(0.0), LOOK_NONE);
    if (params.paper != 0u) {
        for (uint s = 0u; s < params.sample_count; ++s) {
            vertex.segment = s;
            walk.at = follow_paper(vertex, path_segment(i, s, vertex.start));
        }
    } else {
        walk = followed(i, vertex);
    }
    VertexResult result;
    result.displacement = walk.at + vertex.offset;
    if (lifts && vertex.offset != real3(0.0)) {
        result.displacement = stands ? bounded_by(result.displacement, whole_length(i, vertex.start))
                                     : bounded_past_moving(result.displacement, walk.here, vertex);
    }
    result.steps = vertex.steps;
    result.samples = vertex.samples;
    result.flags = vertex.flags;
    return result;
}

// Any point.
VertexResult deformed(uint i) {
    VertexResult result;
    if (!unhindered(i, result)) {
        result = hindered(i);
    }
    return result;
}
