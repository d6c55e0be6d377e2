// Distance to a triangle given in its own plane, alike in C++ (four triangles at once) and GLSL. The includer
// provides real, or a vector of them, with least(), clamped(x, high): between 0 and that, and share(x):
// between 0 and 1.

// Squared distance of a point: that from the triangle's origin, and what the nearest feature is nearer. The
// point is at (x, y) along the triangle's axes; the corners are the origin, (b, 0) and (cx, cy), cy >= 0.
real flat_squared_distance(real from_origin, real x, real y, real b, real cx, real cy, real ac2_inverse,
                           real bc2_inverse) {
    real on_ab = clamped(x, b);
    real by_ab = on_ab * (on_ab - 2 * x);
    real ac = cx * x + cy * y;
    real on_ac = share(ac * ac2_inverse);
    real by_ac = on_ac * (on_ac * (cx * cx + cy * cy) - 2 * ac);
    real ex = cx - b;
    real fx = x - b;
    real bc = ex * fx + cy * y;
    real on_bc = share(bc * bc2_inverse);
    real by_bc = on_bc * (on_bc * (ex * ex + cy * cy) - 2 * bc) + b * (b - 2 * x);
    real by_sides = least(by_ab, least(by_ac, by_bc));
    return from_origin +
           (least(y, least(cy * x - cx * y, ex * y - cy * fx)) > 0 ? -(x * x + y * y) : by_sides);
}
