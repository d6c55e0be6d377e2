// Shape functions and influence curves: piecewise cubics, evaluated alike in C++ and GLSL.
// The includer provides the array `segments`.

// The cubic at t, where it holds.
real segment_value(ShapeSegment segment, real t) {
    real s = max(t - segment.begin, real(0.0));
    return segment.c0 + s * (segment.c1 + s * (segment.c2 + s * segment.c3));
}

// phi(t) for t >= 0; 0 beyond 1. Knots fall on segment ends, so kinks stay exact.
real curve_value(CurveRange curve, real t) {
    if (!(t <= 1.0) || curve.count == 0u) {
        return 0.0;
    }
    uint low = 0u;
    uint high = curve.count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (segments[curve.first + middle].begin <= t) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return segment_value(segments[curve.first + low], t);
}
